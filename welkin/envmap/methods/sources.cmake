# The filters of the literature under their names; paths are relative to welkin/envmap.
set(WELKIN_METHOD_SOURCES
  methods/bordered.cpp
  methods/box.cpp
  methods/brute.cpp
  methods/cube_texels.cpp
  methods/filter_method.cpp
  methods/frequency.cpp
  methods/kernel_quantiles.cpp
  methods/paraboloid.cpp
  methods/planar_filter.cpp
  methods/quick.cpp
  methods/quick_taps.cpp
  methods/spline_mips.cpp
  methods/working_cube.cpp)

# The filters of the literature under their names; paths are relative to welkin/envmap.
set(WELKIN_METHOD_SOURCES
  methods/brute.cpp
  methods/cube_texels.cpp
  methods/filter_method.cpp
  methods/frequency.cpp
  methods/kernel_quantiles.cpp)

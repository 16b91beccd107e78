# The built-in environments; paths are relative to welkin/envmap.
set(WELKIN_SKY_SOURCES
  sky/daylight.cpp
  sky/disc_coverage.cpp
  sky/sky.cpp
  sky/sky_coefficients.cpp
  sky/sky_spec.cpp
  sky/studio.cpp)

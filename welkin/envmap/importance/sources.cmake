# Sampling environments; paths are relative to welkin/envmap.
set(WELKIN_IMPORTANCE_SOURCES
  importance/alias_table.cpp
  importance/direction_lanes.cpp
  importance/environment_sampler.cpp
  importance/inverse_table.cpp
  importance/quad_table.cpp
  importance/sampling_table.cpp)

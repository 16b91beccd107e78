# Sampling environments; paths are relative to welkin/envmap.
set(WELKIN_IMPORTANCE_SOURCES
  importance/environment_sampler.cpp
  importance/inverse_table.cpp)

# Light reflected by surfaces, as the viewer sees it; paths are relative to welkin/envmap.
set(WELKIN_REFLECTION_SOURCES
  reflection/lafortune_stack.cpp
  reflection/lafortune_truth.cpp
  reflection/lobe_stack.cpp
  reflection/stack_files.cpp
  reflection/fresnel_blend.cpp
  reflection/simplex_search.cpp
  reflection/split_sum.cpp
  reflection/stretched_taps.cpp
  reflection/stretched_taps_fit.cpp
  reflection/tap_fit.cpp
  reflection/brdf_spectrum.cpp
  reflection/low_frequency.cpp
  reflection/shrm.cpp
  reflection/shrm_orders.cpp
  reflection/truth.cpp)

# Light reflected by surfaces, as the viewer sees it; paths are relative to welkin/envmap.
set(WELKIN_REFLECTION_SOURCES
  reflection/truth.cpp)

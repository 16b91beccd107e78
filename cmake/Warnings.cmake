# One interface target that carries language level, warnings and sanitizers to every target of ours.
add_library(welkin_flags INTERFACE)
target_compile_features(welkin_flags INTERFACE cxx_std_20)
target_compile_options(welkin_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wno-psabi
  $<$<BOOL:${EMSCRIPTEN}>:-Wno-shorten-64-to-32>
  $<$<BOOL:${WELKIN_WARNINGS_AS_ERRORS}>:-Werror>)
# (A size_t has 32 bits on WebAssembly: sizes that files give are checked as 64 bits before they become one.)
# For sources that handle text, where a short compilation is worth more than a fast loop. g++ 12 at -O1 takes empty
# optionals for uninitialised values.
set(WELKIN_QUICK_COMPILE $<$<CONFIG:Release>:-O1> -Wno-maybe-uninitialized)
if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(WELKIN_QUICK_COMPILE "")
endif()

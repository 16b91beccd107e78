# One interface target that carries language level, warnings and sanitizers to every target of ours.
add_library(welkin_flags INTERFACE)
target_compile_features(welkin_flags INTERFACE cxx_std_20)
target_compile_options(welkin_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wno-psabi
  $<$<BOOL:${WELKIN_WARNINGS_AS_ERRORS}>:-Werror>)

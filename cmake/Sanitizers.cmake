if(WELKIN_SANITIZE)
  target_compile_options(welkin_flags INTERFACE -fsanitize=${WELKIN_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(welkin_flags INTERFACE -fsanitize=${WELKIN_SANITIZE})
  # g++ 12 sees uninitialised values that are not there once its own checks are woven in (in <regex>, for one).
  target_compile_options(welkin_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  # Function multi-versioning resolves through ifuncs, which run before the sanitizer runtime is ready.
  target_compile_definitions(welkin_flags INTERFACE WELKIN_NO_TARGET_CLONES)
  if(WELKIN_SANITIZE MATCHES "fuzzer")
    # The customary name; readers lower their size limits (welkin/image/codecs/size_limit.h).
    target_compile_definitions(welkin_flags INTERFACE FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION)
  endif()
endif()

if(WELKIN_SANITIZE)
  target_compile_options(welkin_flags INTERFACE -fsanitize=${WELKIN_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(welkin_flags INTERFACE -fsanitize=${WELKIN_SANITIZE})
  # Function multi-versioning resolves through ifuncs, which run before the sanitizer runtime is ready.
  target_compile_definitions(welkin_flags INTERFACE WELKIN_NO_TARGET_CLONES)
endif()

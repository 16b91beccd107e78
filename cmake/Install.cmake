# Headers, static libraries and a package, so that find_package(welkin) works from outside.
include(CMakePackageConfigHelpers)
get_property(modules GLOBAL PROPERTY WELKIN_MODULES)
install(TARGETS ${modules} EXPORT welkinTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY welkin DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(EXPORT welkinTargets NAMESPACE welkin:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/welkin)
configure_package_config_file(cmake/welkinConfig.cmake.in welkinConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/welkin)
write_basic_package_version_file(welkinConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/welkinConfig.cmake" "${PROJECT_BINARY_DIR}/welkinConfigVersion.cmake"
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/welkin)

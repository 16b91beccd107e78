# Headers, static libraries, the command and a package, so that find_package(welkin) works from outside
# (tests/install builds such a consumer). welkin::welkin stands for all modules together.
include(CMakePackageConfigHelpers)
get_property(modules GLOBAL PROPERTY WELKIN_MODULES)
add_library(welkin_all INTERFACE)
add_library(welkin::welkin ALIAS welkin_all)
set_target_properties(welkin_all PROPERTIES EXPORT_NAME welkin)
target_link_libraries(welkin_all INTERFACE ${modules})

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/welkin)
install(TARGETS ${modules} welkin_all EXPORT welkinTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY welkin DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
foreach(program welkin welkin-view)  # beside each other: `welkin view` starts welkin-view
  if(TARGET ${program})
    install(TARGETS ${program} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  endif()
endforeach()
install(EXPORT welkinTargets NAMESPACE welkin:: DESTINATION ${package_folder})
configure_package_config_file(cmake/welkinConfig.cmake.in "${PROJECT_BINARY_DIR}/welkinConfig.cmake"
  INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file("${PROJECT_BINARY_DIR}/welkinConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/welkinConfig.cmake" "${PROJECT_BINARY_DIR}/welkinConfigVersion.cmake"
  DESTINATION ${package_folder})

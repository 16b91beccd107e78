# welkin_module(name SOURCES a.cpp ... DEPENDS welkin::image ... LINK lib ...)
# One folder, one static library welkin_<name>, one alias welkin::<name>. DEPENDS are public, LINK is private.
set_property(GLOBAL PROPERTY WELKIN_MODULES "")
set(WELKIN_PIC ON)
if(EMSCRIPTEN)
  include(WebSources)
  set(WELKIN_PIC OFF)
endif()
function(welkin_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;LINK" ${ARGN})
  list(REMOVE_ITEM ARG_SOURCES ${WELKIN_NOT_IN_${name}})
  add_library(welkin_${name} STATIC ${ARG_SOURCES})
  add_library(welkin::${name} ALIAS welkin_${name})
  set_target_properties(welkin_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ${WELKIN_PIC})
  target_compile_features(welkin_${name} PUBLIC cxx_std_20)
  target_include_directories(welkin_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(welkin_${name}
    PUBLIC ${ARG_DEPENDS}
    PRIVATE $<BUILD_INTERFACE:welkin_flags> ${ARG_LINK})
  set_property(GLOBAL APPEND PROPERTY WELKIN_MODULES welkin_${name})
  if(EMSCRIPTEN)
    target_precompile_headers(welkin_${name} REUSE_FROM welkin_web_headers)
  endif()
endfunction()

# welkin_test(name SOURCES a_test.cpp ... DEPENDS welkin::image ...): a GoogleTest program, its cases known to ctest.
function(welkin_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE welkin_flags ${ARG_DEPENDS} GTest::gtest_main)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST PROPERTIES TIMEOUT 600)
endfunction()

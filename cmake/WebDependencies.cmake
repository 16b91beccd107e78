# What the web build takes from Debian's native packages: libraries of headers alone. Each is linked into a folder of
# its own, so that no other header of /usr/include is seen. oneTBB, OpenEXR, libpng, TurboJPEG, zstd, astcenc and Embree
# have no WebAssembly library: the sources that use them have a variant without (..._absent.cpp, ..._serial.cpp).
set(web_headers "${CMAKE_BINARY_DIR}/headers")
file(MAKE_DIRECTORY "${web_headers}")
function(welkin_web_headers target folder)
  find_path(WELKIN_WEB_${folder} ${folder} PATHS /usr/include /usr/local/include REQUIRED NO_DEFAULT_PATH
    NO_CMAKE_FIND_ROOT_PATH)
  file(CREATE_LINK "${WELKIN_WEB_${folder}}/${folder}" "${web_headers}/${folder}" SYMBOLIC)
  if(NOT TARGET ${target})
    add_library(${target} INTERFACE IMPORTED)
    target_include_directories(${target} SYSTEM INTERFACE "${web_headers}")
  endif()
endfunction()
welkin_web_headers(hwy::hwy hwy)
welkin_web_headers(nlohmann_json::nlohmann_json nlohmann)
welkin_web_headers(kissfft kissfft)
set(KISSFFT_INCLUDE_DIR "${web_headers}")

# Highway 1.0.3 has no doubles on WebAssembly. Its portable vectors become 128-bit instructions all the same.
add_compile_definitions(HWY_DISABLED_TARGETS=HWY_WASM)
add_compile_options("SHELL:-include ${CMAKE_CURRENT_SOURCE_DIR}/cmake/web/std_gaps.h")
# Errors are C++ exceptions, by WebAssembly's own (every browser since 2022); 128-bit vectors (likewise).
add_compile_options(-fwasm-exceptions -msimd128)
add_link_options(-fwasm-exceptions)
# The linker runs scripts that want Debian's node modules.
set(CMAKE_CXX_LINKER_LAUNCHER ${CMAKE_COMMAND} -E env NODE_PATH=/usr/share/nodejs)

# fmt compiled once: header-only, each of our sources would take four seconds more.
welkin_web_headers(fmt_headers fmt)
add_library(welkin_web_fmt STATIC cmake/web/fmt.cpp)
target_link_libraries(welkin_web_fmt PUBLIC fmt_headers)
target_compile_features(welkin_web_fmt PUBLIC cxx_std_20)
add_library(fmt::fmt ALIAS welkin_web_fmt)

# Parsing the standard library takes longer than compiling most of our sources: that is done once.
add_library(welkin_web_headers OBJECT cmake/web/headers.cpp)
target_compile_features(welkin_web_headers PUBLIC cxx_std_20)
target_link_libraries(welkin_web_headers PRIVATE fmt_headers)
# The same bytes whenever it is made, for compiler caches.
target_compile_options(welkin_web_headers PRIVATE "SHELL:-Xclang -fno-pch-timestamp")
target_precompile_headers(welkin_web_headers PRIVATE <algorithm> <array> <cassert> <cmath> <complex> <cstdint> <cstring>
  <filesystem> <functional> <map> <memory> <numbers> <optional> <span> <string> <string_view> <utility> <vector>
  <fmt/format.h>)

# Everything welkin links, all from Debian 12 packages (scripts/install-deps says why each is there).
if(EMSCRIPTEN)
  include(WebDependencies)
  return()
endif()
find_package(fmt REQUIRED)
find_package(TBB REQUIRED)
find_package(OpenEXR REQUIRED)
find_package(PNG REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(EGL REQUIRED IMPORTED_TARGET egl)
pkg_check_modules(GLES REQUIRED IMPORTED_TARGET glesv2)
pkg_check_modules(ZSTD REQUIRED IMPORTED_TARGET libzstd)
pkg_check_modules(TURBOJPEG REQUIRED IMPORTED_TARGET libturbojpeg)
find_package(hwy REQUIRED)
find_package(embree 3 REQUIRED)
find_path(ASTCENC_INCLUDE_DIR astcenc.h REQUIRED)
find_library(ASTCENC_LIBRARY astcenc REQUIRED)
# The Debian package has no CMake files. Its header declares what a shared library exports only with this definition.
if(NOT TARGET astcenc::astcenc)
  add_library(astcenc::astcenc UNKNOWN IMPORTED)
  set_target_properties(astcenc::astcenc PROPERTIES
    IMPORTED_LOCATION "${ASTCENC_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${ASTCENC_INCLUDE_DIR}"
    INTERFACE_COMPILE_DEFINITIONS ASTCENC_DYNAMIC_LIBRARY)
endif()
find_path(KISSFFT_INCLUDE_DIR kissfft/kissfft.hh REQUIRED)

# Everything welkin links, all from Debian 12 packages (scripts/install-deps says why each is there).
find_package(fmt REQUIRED)
find_package(TBB REQUIRED)
find_package(OpenEXR REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(ZSTD REQUIRED IMPORTED_TARGET libzstd)
pkg_check_modules(STB REQUIRED IMPORTED_TARGET stb)
find_path(KISSFFT_INCLUDE_DIR kissfft/kissfft.hh REQUIRED)

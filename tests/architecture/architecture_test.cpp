#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

// Reads the #include lines of the source tree and holds them against the table of what may use what. The
// shared include root lets any file include any other, so only this test keeps the direction of dependencies.

namespace {

namespace fs = std::filesystem;
const fs::path root = WELKIN_SOURCE_DIR;

// Module -> the modules that it may use directly; it may also use what those may use.
const std::map<std::string, std::set<std::string>> may_use = {
    {"parallel", {}},
    {"geometry", {}},
    {"image", {"parallel"}},
    {"sampling", {"parallel", "geometry"}},
    {"sphere", {"image", "sampling"}},
    {"sh", {"sphere"}},
    {"brdf", {"image", "sampling"}},
    {"envmap", {"sh", "brdf", "sphere"}},
    {"scene", {"image", "geometry"}},
    {"raytrace", {"scene"}},
    {"pathtrace", {"raytrace", "envmap"}},
    {"bake", {"pathtrace", "raytrace", "sh", "envmap"}},
    {"prt", {"pathtrace", "raytrace", "sh", "envmap"}},
    {"probes", {"pathtrace", "raytrace", "sh", "envmap"}},
    {"realtime", {"scene", "envmap"}},
    {"comparison", {"pathtrace", "realtime"}},
};

// Third-party headers (a pattern of what stands between the brackets) and the only files of welkin/ and apps/
// that may include them. None may reach a header, but for OpenGL ES, which the browser has.
struct Confined {
  const char* name;
  std::regex header;
  std::regex allowed_in;
};
const std::vector<Confined> confined = {
    {"oneTBB", std::regex("(oneapi/)?tbb/.*"), std::regex("welkin/parallel/[^/]*\\.cpp")},
    {"OpenEXR", std::regex("(OpenEXR/|Imath/)?(Imf|Imath|Iex|IlmThread|half|openexr).*\\.h"),
     std::regex("welkin/image/codecs/exr[^/]*\\.cpp")},
    {"zstd", std::regex("(zstd|zdict).*\\.h"), std::regex("welkin/image/codecs/ktx2[^/]*\\.cpp")},
    {"libpng", std::regex("(libpng[0-9]*/)?png.*\\.h"), std::regex("welkin/image/codecs/png[^/]*\\.cpp")},
    {"TurboJPEG", std::regex("(turbojpeg|jpeglib|jerror)\\.h"),
     std::regex("welkin/image/codecs/jpeg[^/]*\\.cpp")},
    {"nlohmann-json", std::regex("nlohmann/.*"),
     std::regex("welkin/sh/forms/json_form\\.cpp|welkin/scene/gltf[^/]*\\.cpp|welkin/realtime/ibl_folder\\.cpp|apps/.*")},
    {"Embree", std::regex("embree.*"), std::regex("welkin/raytrace/[^/]*\\.cpp")},
    {"tinygltf", std::regex("tiny_gltf\\.h"), std::regex("welkin/scene/gltf[^/]*\\.cpp")},
    {"OpenGL ES", std::regex("GLES[0-9]?/.*"), std::regex("welkin/realtime/gl/gl_api\\.h|apps/viewer/.*")},
    {"EGL", std::regex("EGL/.*"), std::regex("welkin/realtime/gl/headless_context\\.cpp")},
    {"GLFW", std::regex("GLFW/.*"), std::regex("apps/viewer/.*")},
    {"Dear ImGui", std::regex("imgui.*"), std::regex("apps/viewer/.*")},
    {"astcenc", std::regex("astcenc\\.h"), std::regex("welkin/image/codecs/astc[^/]*\\.cpp")},
    {"Highway", std::regex("hwy/.*"), std::regex("welkin/.*\\.cpp")},
    {"Eigen", std::regex("Eigen/.*"), std::regex("welkin/.*\\.cpp")},
    {"kissfft", std::regex("(kissfft/)?kiss_?fft.*"), std::regex("welkin/sh/[^/]*\\.cpp")},
};

struct Include {
  std::string file;    // of the including file, relative to the root, with /
  int line = 0;        // from 1
  std::string target;  // what stands between the brackets or quotes
  bool quoted = false;
};

std::vector<Include> includes_in(std::istream& text, const std::string& file) {
  static const std::regex pattern(R"re(^\s*#\s*include\s*([<"])([^>"]+)[>"].*)re");
  std::vector<Include> includes;
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    std::smatch match;
    if (std::regex_match(line, match, pattern))
      includes.push_back({file, number, match[2], match[1] == "\""});
  }
  return includes;
}

bool is_source(const fs::path& path) {
  const std::string extension = path.extension().string();
  return extension == ".h" || extension == ".cpp" || extension == ".hpp" || extension == ".cc" ||
         extension == ".inl";
}

// All includes under root/folder, in the order of the file names.
std::vector<Include> includes_under(const std::string& folder) {
  std::vector<Include> includes;
  if (!fs::exists(root / folder)) return includes;
  std::set<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
    if (entry.is_regular_file() && is_source(entry.path())) files.insert(entry.path());
  }
  for (const fs::path& file : files) {
    std::ifstream text(file);
    const auto found = includes_in(text, fs::relative(file, root).generic_string());
    includes.insert(includes.end(), found.begin(), found.end());
  }
  return includes;
}

// "b" of "a/b/c"; empty when there are fewer than three parts.
std::string module_of(const std::string& path) {
  const auto first = path.find('/');
  const auto second = first == std::string::npos ? first : path.find('/', first + 1);
  return second == std::string::npos ? "" : path.substr(first + 1, second - first - 1);
}

bool starts_with(const std::string& text, const std::string& prefix) { return text.rfind(prefix, 0) == 0; }

// Whether `user` may include `used`, by the transitive closure of the table.
bool may_include(const std::string& user, const std::string& used) {
  if (user == used) return true;
  const auto direct = may_use.find(user);
  if (direct == may_use.end()) return false;
  return std::any_of(direct->second.begin(), direct->second.end(),
                     [&](const std::string& next) { return may_include(next, used); });
}

// What is wrong with one include of a file of welkin/ or apps/; empty when nothing is.
std::string objection(const Include& include) {
  for (const Confined& library : confined) {
    if (std::regex_match(include.target, library.header) &&
        !std::regex_match(include.file, library.allowed_in)) {
      return std::string(library.name) + " may not be included here";
    }
  }
  if (!starts_with(include.file, "welkin/")) return "";
  if (starts_with(include.target, "apps/")) return "the library may not use the programs";
  if (include.quoted && fs::exists((root / include.file).parent_path() / include.target)) {
    return "our headers are included as <welkin/module/file.h>";
  }
  if (!starts_with(include.target, "welkin/") || include.target == "welkin/error.h") return "";
  const std::string user = module_of(include.file), used = module_of(include.target);
  if (may_use.count(used) == 0) return "unknown module \"" + used + "\"";
  return may_include(user, used) ? "" : "module " + user + " may not use module " + used;
}

std::string place(const Include& include) {
  return include.file + ":" + std::to_string(include.line) + ": <" + include.target + ">";
}

// Self-check: were the parser to find nothing, everything below would pass. These two includes are certain.
TEST(Architecture, ParserFindsIncludesThatAreKnownToBeThere) {
  const auto includes = includes_under("welkin");
  const auto has = [&](const std::string& file, const std::string& target) {
    return std::any_of(includes.begin(), includes.end(),
                       [&](const Include& i) { return i.file == file && i.target == target; });
  };
  EXPECT_TRUE(has("welkin/parallel/parallel_for.cpp", "tbb/parallel_for.h"));
  EXPECT_TRUE(has("welkin/image/output_file.cpp", "welkin/error.h"));
  EXPECT_TRUE(has("welkin/sphere/cube.h", "welkin/sphere/vec3.h"));
}

TEST(Architecture, ParserReadsEverySpelling) {
  std::istringstream text(
      "#include <a/b.h>\n  #  include \"c.h\"  // why\n// #include <no.h>\nint x;\n#include<d>\n");
  const auto includes = includes_in(text, "f.cpp");
  ASSERT_EQ(includes.size(), 3u);
  EXPECT_EQ(includes[0].target, "a/b.h");
  EXPECT_FALSE(includes[0].quoted);
  EXPECT_EQ(includes[1].target, "c.h");
  EXPECT_TRUE(includes[1].quoted);
  EXPECT_EQ(includes[1].line, 2);
  EXPECT_EQ(includes[2].target, "d");
}

// Self-check of the rules: each of these must be refused, each of those allowed.
TEST(Architecture, RulesRefuseAndAllowWhatTheyShould) {
  const auto refused = [](const std::string& file, const std::string& target) {
    return !objection({file, 1, target, false}).empty();
  };
  EXPECT_TRUE(refused("welkin/image/a.cpp", "welkin/sphere/cube.h"));     // upwards
  EXPECT_TRUE(refused("welkin/parallel/a.h", "welkin/image/image.h"));    // upwards
  EXPECT_TRUE(refused("welkin/brdf/a.cpp", "welkin/sh/basis.h"));         // sideways
  EXPECT_TRUE(refused("welkin/sh/a.cpp", "welkin/utils/a.h"));            // no such module
  EXPECT_TRUE(refused("welkin/newcomer/a.cpp", "welkin/image/image.h"));  // not in the table
  EXPECT_TRUE(refused("welkin/envmap/a.cpp", "apps/welkin/a.h"));         // a program
  EXPECT_TRUE(refused("welkin/envmap/a.cpp", "tbb/parallel_for.h"));      // third party, elsewhere
  EXPECT_TRUE(refused("welkin/parallel/a.h", "tbb/task_arena.h"));        // third party, in a header
  EXPECT_TRUE(refused("welkin/image/codecs/hdr.cpp", "ImfInputFile.h"));
  EXPECT_TRUE(refused("welkin/image/codecs/exr.h", "OpenEXR/ImfHeader.h"));
  EXPECT_TRUE(refused("welkin/image/codecs/dds.cpp", "zstd.h"));
  EXPECT_TRUE(refused("welkin/image/codecs/ldr.cpp", "png.h"));
  EXPECT_TRUE(refused("welkin/image/codecs/ldr.cpp", "turbojpeg.h"));
  EXPECT_TRUE(refused("apps/welkin/main.cpp", "Imath/ImathVec.h"));
  EXPECT_TRUE(refused("welkin/image/codecs/ktx2_read.cpp", "astcenc.h"));
  EXPECT_TRUE(refused("welkin/sh/transform.h", "hwy/highway.h"));
  EXPECT_TRUE(refused("apps/welkin/main.cpp", "Eigen/Dense"));
  EXPECT_TRUE(refused("welkin/raytrace/ray_scene.h", "embree3/rtcore.h"));
  EXPECT_TRUE(refused("welkin/pathtrace/path.cpp", "embree3/rtcore.h"));
  EXPECT_TRUE(refused("welkin/scene/obj.cpp", "nlohmann/json.hpp"));
  EXPECT_TRUE(refused("welkin/geometry/affine.h", "welkin/sphere/vec3.h"));
  EXPECT_TRUE(refused("welkin/sh/forms/json_form.h", "nlohmann/json.hpp"));
  EXPECT_TRUE(refused("welkin/sh/forms/read_form.cpp", "nlohmann/json.hpp"));

  EXPECT_FALSE(refused("welkin/envmap/a.cpp", "welkin/parallel/parallel_for.h"));  // through sphere and image
  EXPECT_FALSE(refused("welkin/sh/a.h", "welkin/sh/basis.h"));
  EXPECT_FALSE(refused("welkin/parallel/a.cpp", "welkin/error.h"));
  EXPECT_FALSE(refused("welkin/parallel/parallel_for.cpp", "tbb/info.h"));
  EXPECT_FALSE(refused("welkin/image/codecs/exr_write.cpp", "ImfOutputFile.h"));
  EXPECT_FALSE(refused("welkin/image/codecs/ktx2.cpp", "zstd.h"));
  EXPECT_FALSE(refused("welkin/image/codecs/png_read.cpp", "png.h"));
  EXPECT_FALSE(refused("welkin/image/codecs/jpeg_read.cpp", "turbojpeg.h"));
  EXPECT_FALSE(refused("welkin/image/codecs/astc_decode.cpp", "astcenc.h"));
  EXPECT_FALSE(refused("welkin/sh/transform.cpp", "hwy/highway.h"));
  EXPECT_FALSE(refused("welkin/brdf/fit.cpp", "Eigen/Dense"));
  EXPECT_FALSE(refused("welkin/sh/transform.cpp", "kissfft/kissfft.hh"));
  EXPECT_FALSE(refused("apps/welkin/ibl.cpp", "welkin/envmap/filter.h"));
  EXPECT_FALSE(refused("welkin/raytrace/ray_scene.cpp", "embree3/rtcore.h"));
  EXPECT_FALSE(refused("welkin/scene/gltf_read.cpp", "nlohmann/json.hpp"));
  EXPECT_FALSE(refused("welkin/brdf/a.h", "welkin/geometry/frame.h"));  // through sampling
}

TEST(Architecture, EveryIncludeFollowsTheTable) {
  for (const char* folder : {"welkin", "apps"}) {
    for (const Include& include : includes_under(folder)) {
      const std::string problem = objection(include);
      EXPECT_TRUE(problem.empty()) << place(include) << ": " << problem;
    }
  }
}

TEST(Architecture, EveryFolderOfTheLibraryIsAModuleOfTheTable) {
  int modules = 0;
  for (const auto& entry : fs::directory_iterator(root / "welkin")) {
    if (!entry.is_directory()) continue;
    ++modules;
    EXPECT_EQ(may_use.count(entry.path().filename().string()), 1u) << entry.path();
  }
  EXPECT_GE(modules, 3);  // parallel, image and sphere were there from the first day
}

// A helper that is used twice gets a topic and a name.
TEST(Architecture, NoFolderWithoutATopic) {
  const std::set<std::string> refused = {"utils", "util", "utilities", "common", "misc", "core", "helpers"};
  int folders = 0;
  for (const char* top : {"welkin", "apps", "tests", "bench"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      if (!entry.is_directory()) continue;
      ++folders;
      EXPECT_EQ(refused.count(entry.path().filename().string()), 0u) << entry.path();
    }
  }
  EXPECT_GT(folders, 5);  // the walk really walked
}

}  // namespace

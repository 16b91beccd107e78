#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "command_test.h"

#include <welkin/envmap/importance/sampling_table.h>
#include <welkin/image/codecs/exr.h>

#include "tests/apps/sampling_files.h"
#include "tests/envmap/importance_cases.h"
#include "tests/oracles/chi_square.h"

// The shader code that `welkin sampling` writes, compiled as C++ (glsl_shim.h) and run on the tables that it writes,
// against EnvironmentSampler and against the map.

namespace welkin {
namespace {

struct Shader {
  std::string form, density;
};
const std::vector<Shader> shaders = {{"rows", "luminance-solid-angle"},  {"rows", "luminance"},
                                     {"cdf", "luminance-solid-angle"},   {"cdf", "luminance"},
                                     {"alias", "luminance-solid-angle"}, {"alias", "luminance"}};

EnvironmentSamplerOptions options_of(const Shader& shader) {
  EnvironmentSamplerOptions options;
  if (shader.density == "luminance") options.density = EnvironmentDensity::luminance;
  if (shader.form == "alias") options.table = EnvironmentTable::alias;
  return options;
}

// GLSL's numbers are single floats: C++ wants an f behind them.
std::string with_float_suffixes(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const auto is = [&](std::size_t at, const char* set) {
      return at < text.size() && std::string(set).find(text[at]) != std::string::npos;
    };
    const bool starts = is(i, "0123456789") && (i == 0 || (!std::isalnum(text[i - 1]) && text[i - 1] != '_'));
    std::size_t end = i + 1;
    if (starts)
      while (is(end, "0123456789.e") || (is(end, "+-") && text[end - 1] == 'e')) ++end;
    const std::string token = text.substr(i, end - i);
    result += token;
    if (starts && token.find_first_of(".e") != std::string::npos) result += 'f';
    i = end;
  }
  return result;
}

struct ShaderSample {
  Vec3f direction;
  float pdf = 0;
  int x = 0, y = 0;
};

void write_texture(const std::filesystem::path& file, int width, int height, int channels,
                   const std::vector<float>& numbers) {
  std::ofstream out(file, std::ios::binary);
  const int shape[3] = {width, height, channels};
  out.write(reinterpret_cast<const char*>(shape), sizeof shape);
  out.write(reinterpret_cast<const char*>(numbers.data()),
            static_cast<std::streamsize>(numbers.size() * sizeof(float)));
}

std::vector<float> read_floats(const std::filesystem::path& file) {
  const std::string bytes = read_text(file);
  std::vector<float> numbers(bytes.size() / sizeof(float));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(float));
  return numbers;
}

// Single floats of 24 bits, the least and the largest first.
std::vector<Vec2f> numbers_for(const Shader& shader) {
  const float last = std::nextafter(1.0f, 0.0f);
  std::vector<Vec2f> numbers = {{0, 0}, {0, last}, {last, 0}, {last, last}, {0.5f, 0.5f}, {1e-30f, 1e-30f}};
  UnitNumbers random(77);
  const int count = shader.form == "rows" ? 10'000 : 80'000;  // rows add up thousands of texels
  while (static_cast<int>(numbers.size()) < count) numbers.push_back(random.two());
  return numbers;
}
constexpr std::size_t extremes = 6;

class SamplingShaderTest : public CommandTest {
 protected:
  // Every shader in a namespace of its own, in one program that runs the jobs it is given.
  void compile() const {
    std::string main = "#include \"" + std::string(WELKIN_TESTS) + "/apps/glsl_shim.h\"\nnamespace glsl {\n";
    std::string choices;
    for (std::size_t k = 0; k < shaders.size(); ++k) {
      const std::string name = "shader" + std::to_string(k);
      run_well({"sampling", "sky:labelled,size=8x4", "--form", shaders[k].form, "--density",
                shaders[k].density, "--glsl", name});
      const std::string text = read_text(at(name));
      EXPECT_EQ(text, sampling_table_glsl(form_from_name(shaders[k].form), options_of(shaders[k])));
      write_text(at(name + ".inc"), with_float_suffixes(text));
      main += "namespace " + name + " {\n#include \"" + name + ".inc\"\n}\n";
      choices += "  if (job[0] == '" + std::to_string(k) + "') glsl::run(job, glsl::" + name +
                 "::welkin_sample, glsl::" + name + "::welkin_pdf);\n";
    }
    main +=
        "}\nint main(int, char** arguments) {\n  const std::string job = arguments[1];\n" + choices + "}\n";
    write_text(at("main.cpp"), main);
    execute(WELKIN_COMPILER " -std=c++17 -O1 -ffp-contract=off main.cpp -o shaders");
  }
  void execute(const std::string& command) const {
    const std::string line = "cd '" + at("").string() + "' && " + command + " > log.txt 2>&1";
    ASSERT_EQ(std::system(line.c_str()), 0) << command << "\n" << read_text(at("log.txt"));
  }

  struct Result {
    std::vector<ShaderSample> samples;
    std::vector<float> pdfs;  // at the middle of each texel
  };
  // What shader k makes of a map; its table goes through a file.
  Result run_shader(std::size_t k, const Image& map, const std::vector<Vec2f>& numbers) const {
    const std::string job = std::to_string(k), file = job + (k % 2 == 0 ? ".exr" : ".ktx2");
    write_map(at("map.exr"), map);
    run_well({"sampling", "map.exr", "--mapping", "equirect", "--form", shaders[k].form, "--density",
              shaders[k].density, "-o", file});
    const Image table = read_table(at(file));
    write_texture(at(job + ".map"), map.width, map.height, 3, map.pixels);
    write_texture(at(job + ".table"), table.width, table.height, table.channels, table.pixels);
    std::vector<float> pairs, directions;
    for (Vec2f u : numbers) pairs.insert(pairs.end(), {u.x, u.y});
    for (int y = 0; y < map.height; ++y)
      for (int x = 0; x < map.width; ++x) {
        const Vec3f d = float_direction((x + 0.5) / map.width, (y + 0.5) / map.height);
        directions.insert(directions.end(), {d.x, d.y, d.z});
      }
    write_texture(at(job + ".numbers"), 2, static_cast<int>(numbers.size()), 1, pairs);
    write_texture(at(job + ".directions"), 3, map.width * map.height, 1, directions);
    execute("./shaders " + job);
    const std::vector<float> found = read_floats(at(job + ".samples"));
    Result result;
    for (std::size_t i = 0; i + 5 < found.size(); i += 6)
      result.samples.push_back({{found[i], found[i + 1], found[i + 2]},
                                found[i + 3],
                                static_cast<int>(found[i + 4]),
                                static_cast<int>(found[i + 5])});
    result.pdfs = read_floats(at(job + ".pdfs"));
    return result;
  }
};

// Wide enough that a number of 24 bits has 12 left within a column, and a third of the texels are a thousandth.
Image wide_map() {
  Image map = noise_map(4096, 2, 31);
  for (int k = 0; k < 4096 * 2; k += 3)
    for (int c = 0; c < 3; ++c) map.pixels[static_cast<std::size_t>(3 * k + c)] *= 1e-3f;
  return map;
}

std::vector<Image> maps() {
  return {sun_map(32, 16, 1e3f), holey_map(12, 6, 3),       one_texel_map(16, 8, 0, 0),
          noise_map(1, 1, 4),    constant_map(2, 2, 1e-3f), wide_map()};
}

// The factor from the density per steradian to the probability of the texel.
double steradians(const Image& map, const Shader& shader, int y, double sine) {
  return shader.density == "luminance" ? two_pi_squared * std::max(sine, 1e-6) / (map.width * map.height)
                                       : equirect_texel_solid_angle(map.width, map.height, y);
}

// Probabilities of the quantised CDFs are off by two steps of 2^-24; rows and single floats by rounding.
constexpr double steps = 0x1p-23, rounding = 1e-5;

void expect_pdfs(const Image& map, const Shader& shader, const EnvironmentSampler& sampler,
                 const std::vector<float>& pdfs) {
  ASSERT_EQ(pdfs.size(), map.pixels.size() / 3);
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const double t = (y + 0.5) / map.height, sine = std::sin(std::numbers::pi * t);
      const double truth = sampler.pdf(float_direction((x + 0.5) / map.width, t));
      ASSERT_NEAR(pdfs[static_cast<std::size_t>(y) * map.width + x], truth,
                  rounding * truth + steps / steradians(map, shader, y, sine))
          << x << " " << y;
    }
}

void expect_samples(const Image& map, const Shader& shader, const EnvironmentSampler& sampler,
                    const std::vector<ShaderSample>& samples) {
  for (const ShaderSample& sample : samples) {
    const Vec3f d = sample.direction;
    ASSERT_NEAR(length(d), 1, 1e-6);
    ASSERT_GT(max_channel(sampler.radiance(sampler.direction_in({sample.x, sample.y}, {0.5f, 0.5f}))), 0);
    const double t = (sample.y + 0.5) / map.height, middle = std::sin(std::numbers::pi * t);
    const double truth = sampler.pdf(float_direction((sample.x + 0.5) / map.width, t)) *
                         steradians(map, shader, sample.y, middle);
    const double found = sample.pdf * steradians(map, shader, sample.y, std::hypot(d.x, d.z));
    ASSERT_NEAR(found, truth, rounding * truth + steps);
    // The direction is in the texel, but for the rounding of the map position; a pole is in every column.
    const Uv uv = uv_of(d);
    const double across = uv.u * map.width - (sample.x + 0.5), down = uv.v * map.height - (sample.y + 0.5);
    const double around = std::abs(std::remainder(across, map.width));
    ASSERT_LT(std::abs(down), 0.5 + 1e-6 * map.height);
    ASSERT_LT(around, 0.5 + 2e-6 * map.width + (std::hypot(d.x, d.z) < 1e-6 ? map.width : 0));
  }
}

// The same numbers lead to the same texel and the same place in it. The library's samples keep off a texel's edges by
// 2^-12 of it, evenly in cos theta: so heights and azimuths are compared.
void expect_places(const Shader& shader, const EnvironmentSampler& sampler, const std::vector<Vec2f>& numbers,
                   const std::vector<ShaderSample>& samples) {
  const Image& map = sampler.map();
  // `rows` has sums of rounded texels in place of a CDF: off by 1e-6 or so, and 4096 texels share a row. Who stands that
  // close to an edge may be in the next texel.
  const bool sums = shader.form == "rows";
  const double part = sums ? 0.1 : 1e-3;  // of a texel
  const int allowed = sums ? static_cast<int>(numbers.size()) / 200 : 0;
  int elsewhere = 0, off = 0;
  for (std::size_t i = extremes; i < numbers.size(); ++i) {
    const Vec3f d = samples[i].direction, e = sampler.sample(numbers[i]).direction;
    const EnvironmentSampler::Texel texel = sampler.texel_of(e);
    elsewhere += texel.x != samples[i].x || texel.y != samples[i].y;
    const double height = std::abs(d.y - e.y), around = std::abs(double{d.x} * e.z - double{d.z} * e.x);
    off += height > part * std::numbers::pi / map.height + 1e-6 ||
           around > part * 2 * std::numbers::pi / map.width + 1e-6;
  }
  EXPECT_LE(elsewhere, allowed);
  EXPECT_LE(off, allowed);
}

// Whatever the sampler does: the counts follow the map.
void expect_counts(const Image& map, const Shader& shader, const std::vector<ShaderSample>& samples) {
  std::vector<double> seen(map.pixels.size() / 3), expected(seen.size());
  for (std::size_t i = extremes; i < samples.size(); ++i)
    seen[static_cast<std::size_t>(samples[i].y) * map.width + samples[i].x] += 1;
  double sum = 0;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const int y = static_cast<int>(k) / map.width;
    const float* p = map.pixels.data() + 3 * k;
    const double factor =
        shader.density == "luminance" ? 1 : std::sin(std::numbers::pi * (y + 0.5) / map.height);
    sum += expected[k] = factor * luminance(Rgb{p[0], p[1], p[2]});
  }
  for (double& e : expected) e *= static_cast<double>(samples.size() - extremes) / sum;
  EXPECT_GT(oracle::chi_square(seen, expected).p, oracle::sidak_threshold(0.01, 36));
}

TEST_F(SamplingShaderTest, SamplesAsTheSamplerDoes) {
  compile();
  ASSERT_FALSE(HasFatalFailure());
  int number = 0;
  for (const Image& map : maps()) {
    for (std::size_t k = 0; k < shaders.size(); ++k) {
      const Shader& shader = shaders[k];
      SCOPED_TRACE("map " + std::to_string(number) + ", " + shader.form + ", " + shader.density);
      const std::vector<Vec2f> numbers = numbers_for(shader);
      const Result result = run_shader(k, map, numbers);
      ASSERT_EQ(result.samples.size(), numbers.size());
      const EnvironmentSampler sampler(map, options_of(shader));
      expect_pdfs(map, shader, sampler, result.pdfs);
      expect_samples(map, shader, sampler, result.samples);
      expect_places(shader, sampler, numbers, result.samples);
      expect_counts(map, shader, result.samples);
    }
    ++number;
  }
}

}  // namespace
}  // namespace welkin

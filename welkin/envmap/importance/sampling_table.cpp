#include <welkin/envmap/importance/sampling_table.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <vector>

#include <welkin/envmap/importance/alias_table.h>
#include <welkin/error.h>
#include <welkin/sphere/equirect.h>

namespace welkin {
namespace {

TexelWeights weights_of(const Image& map, const EnvironmentSamplerOptions& options) {
  TexelWeights weights{map, options.luminance_weights, std::vector<double>(map.height, 1.0)};
  if (options.density == EnvironmentDensity::luminance_solid_angle)
    for (int y = 0; y < map.height; ++y)
      weights.row_factor[y] = std::sin(std::numbers::pi * (y + 0.5) / map.height);
  return weights;
}

Image rows_table(const TexelWeights& weights) {
  Image table(1, weights.map.height, 1);
  for (int y = 0; y < weights.map.height; ++y) {
    double sum = 0;
    for (int x = 0; x < weights.map.width; ++x) sum += weights(x, y);
    *table.at(0, y) = static_cast<float>(sum / weights.map.width);
  }
  return table;
}

Image cdf_table(const TexelWeights& weights) {
  const int width = weights.map.width, height = weights.map.height;
  const InverseTable inverse(weights);
  Image table(width + 2, height + 1, 1);
  for (int y = 0; y <= height; ++y) {
    *table.at(width + 1, y) = inverse.row_cdf()[y];
    for (int x = 0; x <= width && y < height; ++x)
      *table.at(x, y) = inverse.column_cdfs()[static_cast<std::size_t>(y) * (width + 1) + x];
  }
  return table;
}

Image alias_image(const TexelWeights& weights) {
  const int width = weights.map.width, height = weights.map.height;
  const AliasTable alias(weights);
  Image table(width, height, 4);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const AliasTable::Entry& entry = alias.entries()[static_cast<std::size_t>(y) * width + x];
      float* p = table.at(x, y);
      p[0] = entry.keep;
      p[1] = static_cast<float>(entry.other % static_cast<std::uint32_t>(width));
      p[2] = static_cast<float>(entry.other / static_cast<std::uint32_t>(width));
      p[3] = alias.probability(x, y);
    }
  return table;
}

constexpr const char* common =
    R"(// Samples an equirectangular environment by importance; row 0 of the textures is the top (+Y), the middle column looks
// along +X. Written by welkin. `environment` holds linear radiance. Use highp.
struct WelkinSample {
  vec3 direction;  // towards the light
  float pdf;       // per steradian; 0: no sample
  ivec2 texel;     // whose radiance it is: texelFetch(environment, texel, 0)
};
const float WELKIN_PI = 3.14159265358979;

ivec2 welkin_texel(vec3 d, ivec2 size) {
  vec2 uv = vec2(atan(d.z, d.x) / (2.0 * WELKIN_PI) + 0.5, atan(length(d.xz), d.y) / WELKIN_PI);
  return clamp(ivec2(uv * vec2(size)), ivec2(0), size - 1);
}
)";

// Steradians: a texel is even in cos theta, or in theta with the Jacobian 2 pi^2 sin theta.
constexpr const char* by_solid_angle =
    R"(float welkin_density(ivec2 texel, vec3 direction, float probability, ivec2 size) {
  float angle = WELKIN_PI / float(size.y);
  float solid_angle = 4.0 * WELKIN_PI / float(size.x) * sin((float(texel.y) + 0.5) * angle) * sin(0.5 * angle);
  return probability / solid_angle;
}
WelkinSample welkin_place(ivec2 texel, vec2 within, float probability, ivec2 size) {
  float phi = 2.0 * WELKIN_PI * ((float(texel.x) + within.x) / float(size.x) - 0.5);
  // sin^2(theta / 2), of the angle to the nearer pole, is as linear as cos theta and keeps its digits there.
  float pole = 2 * texel.y < size.y ? 1.0 : -1.0, angle = 0.5 * WELKIN_PI / float(size.y);
  float edge = float(pole > 0.0 ? texel.y : size.y - texel.y);
  float a = sin(edge * angle), b = sin((edge + pole) * angle), h = mix(a * a, b * b, within.y);
  float s = 2.0 * sqrt(max(0.0, h * (1.0 - h)));
  vec3 direction = vec3(s * cos(phi), pole * (1.0 - 2.0 * h), s * sin(phi));
  return WelkinSample(direction, welkin_density(texel, direction, probability, size), texel);
}
)";
constexpr const char* by_map =
    R"(float welkin_density(ivec2 texel, vec3 direction, float probability, ivec2 size) {
  float sine = max(length(direction.xz), 1e-6);
  return probability * float(size.x) * float(size.y) / (2.0 * WELKIN_PI * WELKIN_PI * sine);
}
WelkinSample welkin_place(ivec2 texel, vec2 within, float probability, ivec2 size) {
  vec2 uv = (vec2(texel) + within) / vec2(size);
  float phi = 2.0 * WELKIN_PI * (uv.x - 0.5), theta = WELKIN_PI * uv.y;
  vec3 direction = vec3(sin(theta) * cos(phi), cos(theta), sin(theta) * sin(phi));
  return WelkinSample(direction, welkin_density(texel, direction, probability, size), texel);
}
)";

constexpr const char* rows_code = R"(
// Sums of the rows, then of the row's texels, until the number is reached: simple, and slow for large maps.
float welkin_total(sampler2D table) {
  float sum = 0.0;
  for (int y = 0; y < textureSize(table, 0).y; ++y) sum += texelFetch(table, ivec2(0, y), 0).r;
  return sum;
}
WelkinSample welkin_sample(sampler2D environment, sampler2D table, vec2 u) {
  ivec2 size = textureSize(environment, 0);
  float total = welkin_total(table), goal = u.y * total, before = 0.0, row = 0.0;
  ivec2 texel = ivec2(0);
  for (int y = 0; y < size.y; ++y) {
    float next = texelFetch(table, ivec2(0, y), 0).r;
    if (next <= 0.0) continue;
    if (row > 0.0) before += row;
    row = next;
    texel.y = y;
    if (before + row > goal) break;
  }
  if (row <= 0.0) return WelkinSample(vec3(0.0, 1.0, 0.0), 0.0, texel);
  vec2 within = vec2(0.0, clamp((goal - before) / row, 0.0, 1.0));
  float row_sum = row * float(size.x), along = u.x * row_sum, left = 0.0, weight = 0.0;
  for (int x = 0; x < size.x; ++x) {
    float next = welkin_weight(environment, ivec2(x, texel.y), size);
    if (next <= 0.0) continue;
    left += weight;
    weight = next;
    texel.x = x;
    if (left + weight > along) break;
  }
  within.x = clamp((along - left) / max(weight, 1e-30), 0.0, 1.0);
  return welkin_place(texel, within, weight / (total * float(size.x)), size);
}
float welkin_pdf(sampler2D environment, sampler2D table, vec3 direction) {
  ivec2 size = textureSize(environment, 0), texel = welkin_texel(direction, size);
  float probability = welkin_weight(environment, texel, size) / (welkin_total(table) * float(size.x));
  return welkin_density(texel, direction, probability, size);
}
)";

constexpr const char* cdf_code = R"(
// The last entry of a CDF that is not above u, by bisection.
int welkin_column(sampler2D table, int row, int count, float u) {
  int low = 0;
  for (int high = count; high - low > 1;) {
    int middle = (low + high) / 2;
    if (texelFetch(table, ivec2(middle, row), 0).r <= u) low = middle; else high = middle;
  }
  return low;
}
int welkin_row(sampler2D table, int column, int count, float u) {
  int low = 0;
  for (int high = count; high - low > 1;) {
    int middle = (low + high) / 2;
    if (texelFetch(table, ivec2(column, middle), 0).r <= u) low = middle; else high = middle;
  }
  return low;
}
float welkin_probability(sampler2D table, ivec2 texel, ivec2 size) {
  float row = texelFetch(table, ivec2(size.x + 1, texel.y + 1), 0).r - texelFetch(table, ivec2(size.x + 1, texel.y), 0).r;
  return row * (texelFetch(table, texel + ivec2(1, 0), 0).r - texelFetch(table, texel, 0).r);
}
WelkinSample welkin_sample(sampler2D environment, sampler2D table, vec2 u) {
  ivec2 size = textureSize(table, 0) - ivec2(2, 1);
  ivec2 texel;
  texel.y = welkin_row(table, size.x + 1, size.y, u.y);
  texel.x = welkin_column(table, texel.y, size.x, u.x);
  float top = texelFetch(table, ivec2(size.x + 1, texel.y), 0).r;
  float bottom = texelFetch(table, ivec2(size.x + 1, texel.y + 1), 0).r;
  float left = texelFetch(table, texel, 0).r, right = texelFetch(table, texel + ivec2(1, 0), 0).r;
  vec2 within = vec2((u.x - left) / (right - left), (u.y - top) / (bottom - top));
  return welkin_place(texel, within, (bottom - top) * (right - left), size);
}
float welkin_pdf(sampler2D environment, sampler2D table, vec3 direction) {
  ivec2 size = textureSize(table, 0) - ivec2(2, 1), texel = welkin_texel(direction, size);
  return welkin_density(texel, direction, welkin_probability(table, texel, size), size);
}
)";

constexpr const char* alias_code = R"(
// One look-up: the texel that the numbers point at, or the other one that shares its place.
WelkinSample welkin_sample(sampler2D environment, sampler2D table, vec2 u) {
  ivec2 size = textureSize(table, 0);
  vec2 scaled = u * vec2(size);
  ivec2 texel = min(ivec2(scaled), size - 1);
  vec2 within = min(scaled - vec2(texel), vec2(0.999999));
  vec4 entry = texelFetch(table, texel, 0);
  // The remainder of u.x has few digits left in a wide map; those of u.y lengthen it.
  float t = min(within.x + float(size.x) / 16777216.0 * within.y, 0.9999999);
  if (t < entry.r) {
    within.x = t / entry.r;
  } else {
    within.x = (t - entry.r) / (1.0 - entry.r);
    texel = ivec2(entry.gb + 0.5);
  }
  return welkin_place(texel, within, texelFetch(table, texel, 0).a, size);
}
float welkin_pdf(sampler2D environment, sampler2D table, vec3 direction) {
  ivec2 size = textureSize(table, 0), texel = welkin_texel(direction, size);
  return welkin_density(texel, direction, texelFetch(table, texel, 0).a, size);
}
)";

std::string weight_code(const EnvironmentSamplerOptions& options) {
  const auto& w = options.luminance_weights;
  const bool solid = options.density == EnvironmentDensity::luminance_solid_angle;
  return fmt::format(
      "float welkin_weight(sampler2D environment, ivec2 texel, ivec2 size) {{\n"
      "  float luminance = dot(vec3({:#.9g}, {:#.9g}, {:#.9g}), texelFetch(environment, texel, 0).rgb);\n"
      "  return {};\n}}\n",
      w[0], w[1], w[2],
      solid ? "luminance * sin(WELKIN_PI * (float(texel.y) + 0.5) / float(size.y))" : "luminance");
}

}  // namespace

Image make_sampling_table(const Image& radiance, SamplingTableForm form,
                          const EnvironmentSamplerOptions& options) {
  check_sampled_map(radiance, options);
  const TexelWeights weights = weights_of(radiance, options);
  bool black = true;
  for (float value : radiance.pixels) black = black && !(value > 0);
  if (black) throw Error("a black map has no table to sample it by");
  switch (form) {
    case SamplingTableForm::rows: return rows_table(weights);
    case SamplingTableForm::cdf: return cdf_table(weights);
    default: return alias_image(weights);
  }
}

std::string sampling_table_glsl(SamplingTableForm form, const EnvironmentSamplerOptions& options) {
  const bool solid = options.density == EnvironmentDensity::luminance_solid_angle;
  std::string code = common;
  code += solid ? by_solid_angle : by_map;
  switch (form) {
    case SamplingTableForm::rows: return code + weight_code(options) + rows_code;
    case SamplingTableForm::cdf: return code + cdf_code;
    default: return code + alias_code;
  }
}

}  // namespace welkin

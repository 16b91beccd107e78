#pragma once
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

// As much of GLSL ES 3.00 as the shader code of `welkin sampling` needs, so that a C++ compiler runs its very text. Not
// part of any test program: sampling_shader_test.cpp has it compiled together with what the command wrote. Swizzles are
// views into the vector's memory (anonymous structs in unions: an extension that g++ and clang++ share).

namespace glsl {

template <class To, int... index>
struct Swizzle {
  float all[sizeof...(index) + 2];
  operator To() const { return To(all[index]...); }
};

struct ivec2;
struct vec2 {
  float x, y;
  vec2() : x(0), y(0) {}
  vec2(float first, float second) : x(first), y(second) {}
  explicit vec2(float both) : x(both), y(both) {}
  explicit vec2(ivec2 whole);
};

struct vec3 {
  union {
    struct {
      float x, y, z;
    };
    Swizzle<vec2, 0, 2> xz;
  };
  vec3() : vec3(0, 0, 0) {}
  vec3(float a, float b, float c) { x = a, y = b, z = c; }
};

struct vec4 {
  union {
    struct {
      float r, g, b, a;
    };
    Swizzle<vec2, 1, 2> gb;
    Swizzle<vec3, 0, 1, 2> rgb;
  };
  vec4(float red, float green, float blue, float alpha) { r = red, g = green, b = blue, a = alpha; }
};

struct ivec2 {
  int x, y;
  ivec2() : x(0), y(0) {}
  ivec2(int first, int second) : x(first), y(second) {}
  explicit ivec2(int both) : x(both), y(both) {}
  explicit ivec2(vec2 v) : x(static_cast<int>(v.x)), y(static_cast<int>(v.y)) {}
};
inline vec2::vec2(ivec2 whole) : x(static_cast<float>(whole.x)), y(static_cast<float>(whole.y)) {}

inline vec2 operator+(vec2 a, vec2 b) { return {a.x + b.x, a.y + b.y}; }
inline vec2 operator-(vec2 a, vec2 b) { return {a.x - b.x, a.y - b.y}; }
inline vec2 operator*(vec2 a, vec2 b) { return {a.x * b.x, a.y * b.y}; }
inline vec2 operator/(vec2 a, vec2 b) { return {a.x / b.x, a.y / b.y}; }
inline vec2 operator+(vec2 a, float b) { return {a.x + b, a.y + b}; }
inline ivec2 operator+(ivec2 a, ivec2 b) { return {a.x + b.x, a.y + b.y}; }
inline ivec2 operator-(ivec2 a, ivec2 b) { return {a.x - b.x, a.y - b.y}; }
inline ivec2 operator-(ivec2 a, int b) { return {a.x - b, a.y - b}; }

inline float min(float a, float b) { return b < a ? b : a; }
inline float max(float a, float b) { return a < b ? b : a; }
inline vec2 min(vec2 a, vec2 b) { return {min(a.x, b.x), min(a.y, b.y)}; }
inline ivec2 min(ivec2 a, ivec2 b) { return {std::min(a.x, b.x), std::min(a.y, b.y)}; }
inline float clamp(float v, float low, float high) { return min(max(v, low), high); }
inline ivec2 clamp(ivec2 v, ivec2 low, ivec2 high) {
  return {std::clamp(v.x, low.x, high.x), std::clamp(v.y, low.y, high.y)};
}
inline float mix(float a, float b, float t) { return a * (1 - t) + b * t; }
inline float length(vec2 v) { return std::sqrt(v.x * v.x + v.y * v.y); }
inline float dot(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline float atan(float y, float x) { return std::atan2(y, x); }
inline float sin(float x) { return std::sin(x); }
inline float cos(float x) { return std::cos(x); }
inline float sqrt(float x) { return std::sqrt(x); }

struct Texture {
  int width = 0, height = 0, channels = 0;
  std::vector<float> pixels;
};
using sampler2D = const Texture*;

inline ivec2 textureSize(sampler2D texture, int) { return {texture->width, texture->height}; }
// Undefined in GLSL outside the texture: here the end.
inline vec4 texelFetch(sampler2D texture, ivec2 at, int) {
  if (at.x < 0 || at.y < 0 || at.x >= texture->width || at.y >= texture->height) {
    std::printf("texelFetch outside the texture: %d %d\n", at.x, at.y);
    std::exit(1);
  }
  const float* p = texture->pixels.data() + (at.y * texture->width + at.x) * texture->channels;
  if (texture->channels == 1) return {p[0], 0, 0, 1};
  return {p[0], p[1], p[2], texture->channels == 4 ? p[3] : 1.0f};
}

// Three whole numbers, width, height and channels, then floats.
inline Texture read_texture(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  int shape[3] = {};
  in.read(reinterpret_cast<char*>(shape), sizeof shape);
  Texture texture{shape[0], shape[1], shape[2], {}};
  texture.pixels.resize(static_cast<std::size_t>(shape[0]) * shape[1] * shape[2]);
  in.read(reinterpret_cast<char*>(texture.pixels.data()),
          static_cast<std::streamsize>(texture.pixels.size() * sizeof(float)));
  if (!in) std::exit(2);
  return texture;
}

// JOB.samples: direction, pdf and texel for each pair of JOB.numbers; JOB.pdfs: that of each triple of JOB.directions.
template <class Sample, class Pdf>
void run(const std::string& job, Sample sample, Pdf pdf) {
  const Texture map = read_texture(job + ".map"), table = read_texture(job + ".table");
  const Texture numbers = read_texture(job + ".numbers"), directions = read_texture(job + ".directions");
  std::ofstream samples(job + ".samples", std::ios::binary), pdfs(job + ".pdfs", std::ios::binary);
  for (std::size_t i = 0; i < numbers.pixels.size(); i += 2) {
    const auto s = sample(&map, &table, vec2(numbers.pixels[i], numbers.pixels[i + 1]));
    const float found[6] = {s.direction.x,
                            s.direction.y,
                            s.direction.z,
                            s.pdf,
                            static_cast<float>(s.texel.x),
                            static_cast<float>(s.texel.y)};
    samples.write(reinterpret_cast<const char*>(found), sizeof found);
  }
  for (std::size_t i = 0; i < directions.pixels.size(); i += 3) {
    const float* d = directions.pixels.data() + i;
    const float found = pdf(&map, &table, vec3(d[0], d[1], d[2]));
    pdfs.write(reinterpret_cast<const char*>(&found), sizeof found);
  }
}

}  // namespace glsl

// A constructor call in GLSL.
#define WelkinSample(...) \
  WelkinSample { __VA_ARGS__ }

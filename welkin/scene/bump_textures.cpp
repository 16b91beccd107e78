#include <welkin/scene/bump_textures.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace welkin {
namespace {

constexpr int size = 512;
constexpr double turn = 2 * std::numbers::pi;

// How steeply the height rises along +u and along +v.
struct Rise {
  double u = 0, v = 0;
};
using Field = std::vector<Rise>;

template <class Function>
Field field_of(Function&& rise) {
  Field field(std::size_t{size} * size);
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column)
      field[static_cast<std::size_t>(row) * size + column] = rise((column + 0.5) / size, (row + 0.5) / size);
  return field;
}

Field bumps_field(int bumps, double slope) {
  return field_of([=](double u, double v) {
    const double x = turn * bumps * u, y = turn * bumps * v;
    return Rise{-slope * std::cos(x) * std::sin(y), -slope * std::sin(x) * std::cos(y)};
  });
}

Field waves_field(int bumps, double slope) {
  const double along = 2 / std::sqrt(5.0), across = 1 / std::sqrt(5.0);
  return field_of([=](double u, double v) {
    const double rise = slope * std::cos(turn * bumps * (2 * u + v));
    return Rise{along * rise, across * rise};
  });
}

// splitmix64 (Steele et al. 2014): the same numbers on every machine.
class Random {
 public:
  double next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }
  int whole(int low, int high) { return low + static_cast<int>(next() * (high - low + 1)); }

 private:
  std::uint64_t state_ = 6;
};

struct Wave {
  int u = 0, v = 0;  // periods to a side
  int phase = 0;     // of `size`
};

// Waves with whole numbers of periods meet texel centres only at multiples of a period's `size`-th part: one table serves all. All
// have the same slope, so that those of short ones count as much.
Field waves_together(const std::vector<Wave>& waves, double rms_u, double rms_v) {
  std::vector<double> cosine(size);
  for (int i = 0; i < size; ++i) cosine[i] = std::cos(turn * i / size);
  Field field(std::size_t{size} * size);
  for (const Wave& wave : waves) {
    const double length = std::hypot(wave.u, wave.v), across = wave.u / length, down = wave.v / length;
    for (int row = 0; row < size; ++row) {
      for (int column = 0; column < size; ++column) {
        const double c =
            cosine[static_cast<std::size_t>(wave.u * column + wave.v * row + wave.phase) & (size - 1)];
        Rise& rise = field[static_cast<std::size_t>(row) * size + column];
        rise.u += across * c, rise.v += down * c;
      }
    }
  }
  Rise squares;
  for (const Rise& rise : field) squares.u += rise.u * rise.u, squares.v += rise.v * rise.v;
  const double count = static_cast<double>(field.size());
  const double u = rms_u / std::sqrt(std::max(squares.u / count, 1e-12)),
               v = rms_v / std::sqrt(std::max(squares.v / count, 1e-12));
  for (Rise& rise : field) rise.u *= u, rise.v *= v;
  return field;
}

// Wave vectors all around, one to two times `bumps` long (at least, so that there are several lengths, one to three).
Field noise_field(int bumps, double slope) {
  Random random;
  std::vector<Wave> waves;
  const double longest = std::max(2 * bumps, 3);
  while (waves.size() < 64) {
    const int reach = static_cast<int>(longest);
    const Wave wave{random.whole(-reach, reach), random.whole(-reach, reach), random.whole(0, size - 1)};
    const double length = std::hypot(wave.u, wave.v);
    if (length >= bumps && length <= longest) waves.push_back(wave);
  }
  return waves_together(waves, slope / 2, slope / 2);
}

// Lengths along v from a half to four times `bumps` periods a side (at most a wave in eight texels), nearly none along u.
Field brushed_field(int bumps, double slope) {
  Random random;
  std::vector<Wave> waves;
  for (int i = 0; i < 64; ++i)
    waves.push_back({random.whole(-2, 2), random.whole(std::max(bumps / 2, 1), std::min(4 * bumps, 64)),
                     random.whole(0, size - 1)});
  return waves_together(waves, slope / 30, slope / 2);
}

// Courses half as high as bricks are long; every other one is shifted by half a brick. The joint's depth has the slope
// slope sin^2 over a twelfth of a course from the brick's edge inwards.
Field bricks_field(int bumps, double slope) {
  return field_of([=](double u, double v) {
    const double course = std::floor(2 * bumps * v), y = 2 * bumps * v - course;
    const double shifted = bumps * u + 0.5 * std::fmod(course, 2), x = 2 * (shifted - std::floor(shifted));
    // Distances from the four sides in units of a course; where u and v rise, height rises from the low sides.
    const double left = x, right = 2 - x, low = y, high = 1 - y;
    const double nearest = std::min({left, right, low, high});
    constexpr double bevel = 1.0 / 6;
    if (nearest >= bevel) return Rise{};
    const double sine = std::sin(std::numbers::pi * nearest / bevel), rise = slope * sine * sine;
    if (nearest == left) return Rise{rise, 0};
    if (nearest == right) return Rise{-rise, 0};
    return nearest == low ? Rise{0, rise} : Rise{0, -rise};
  });
}

constexpr std::array<std::string_view, 5> names{"bumps", "noise", "brushed", "waves", "bricks"};

Field make_field(BumpPattern pattern, int bumps, double slope) {
  switch (pattern) {
    case BumpPattern::bumps: return bumps_field(bumps, slope);
    case BumpPattern::noise: return noise_field(bumps, slope);
    case BumpPattern::brushed: return brushed_field(bumps, slope);
    case BumpPattern::waves: return waves_field(bumps, slope);
    case BumpPattern::bricks: break;
  }
  return bricks_field(bumps, slope);
}

}  // namespace

std::span<const std::string_view> bump_pattern_names() { return names; }

Texture make_bump_texture(BumpPattern pattern, int bumps, float slope) {
  const Field field = make_field(pattern, bumps, slope);
  Texture texture{std::string(names[static_cast<std::size_t>(pattern)]), Image(size, size, 3)};
  for (std::size_t i = 0; i < field.size(); ++i) {
    const double x = -field[i].u, y = field[i].v;  // the normal's y is against v
    const double scale = 0.5 / std::sqrt(x * x + y * y + 1);
    float* pixel = &texture.image.pixels[3 * i];
    pixel[0] = static_cast<float>(0.5 + x * scale);
    pixel[1] = static_cast<float>(0.5 + y * scale);
    pixel[2] = static_cast<float>(0.5 + scale);
  }
  return texture;
}

}  // namespace welkin

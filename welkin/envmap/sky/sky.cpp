#include <welkin/envmap/sky/sky.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <welkin/envmap/sky/daylight.h>
#include <welkin/envmap/sky/disc_coverage.h>
#include <welkin/envmap/sky/studio.h>
#include <welkin/envmap/sky/texel_average.h>
#include <welkin/error.h>
#include <welkin/sh/basis.h>
#include <welkin/sphere/labelled_map.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

// Irradiance, and what filters and coefficients make of a map, must not leave float (3.4e38).
constexpr double largest_value = 1e30;

void require(bool valid, const char* what) {
  if (!valid) throw Error(std::string("sky: ") + what);
}

void check(const SkyOptions& o) {
  require(o.width >= 1 && o.width <= 65536 && o.height >= 1 && o.height <= 65536,
          "size must be 1x1 to 65536x65536");
  require(static_cast<long long>(o.width) * o.height <= 1LL << 30, "size must be at most 2^30 texels");
  require(o.elevation >= -90 && o.elevation <= 90, "elevation must be -90 to 90 degrees");
  require(std::isfinite(o.azimuth), "azimuth must be finite");
  require(o.turbidity >= 1.7 && o.turbidity <= 10, "turbidity must be 1.7 to 10");
  require(o.albedo >= 0 && o.albedo <= 1, "albedo must be 0 to 1");
  double largest = 0;
  for (double v : o.value) {
    require(std::abs(v) <= largest_value, "value must be at most 1e30");
    largest = std::max(largest, std::abs(v));
  }
  require(std::abs(o.offset) <= largest_value && std::abs(o.slope) <= largest_value,
          "offset and slope must be at most 1e30");
  require(o.scale > 0 && o.scale <= largest_value, "scale must be above 0 and at most 1e30");
  require(largest * o.scale <= largest_value, "value times scale must be at most 1e30");
  const bool moved = o.kind == SkyKind::ramp || o.kind == SkyKind::sh;
  require(!moved || largest * o.scale * std::max(std::abs(o.offset), std::abs(o.slope)) <= largest_value,
          "offset and slope times value and scale must be at most 1e30");
  require(o.kind != SkyKind::texel || (o.x < o.width && o.x >= -1), "x must be -1 (middle) to width - 1");
  require(o.kind != SkyKind::texel || (o.y < o.height && o.y >= -1), "y must be -1 (middle) to height - 1");
  require(o.degree >= 0 && o.degree <= 100, "degree must be 0 to 100");
  require(o.kind != SkyKind::sh || std::abs(o.order) <= o.degree, "order must be -degree to degree");
}

void add_sun(const SkyOptions& options, const DaylightOptions& daylight, Image& image) {
  const Rgb radiance = options.scale * sun_radiance(daylight);
  const double radius = sun_diameter_degrees / 2 * pi / 180;
  for (const Coverage& texel : disc_coverage(options.width, options.height, sun_direction(daylight), radius))
    for (int c = 0; c < 3; ++c)
      image.at(texel.x, texel.y)[c] += static_cast<float>(texel.fraction * radiance[c]);
}

// The ground's radiance is albedo E / pi, with E what sky and sun send onto the horizontal plane.
void fill_day(const SkyOptions& options, Image& image) {
  const DaylightOptions daylight{options.elevation, options.azimuth, options.turbidity};
  const PreethamSky sky(daylight);
  const double sun_cosine = std::max(0.0, sun_direction(daylight).y);
  const Rgb irradiance = sky.horizontal_irradiance() + sun_cosine * sun_irradiance(daylight);
  const Rgb ground = (options.scale * options.albedo / pi) * irradiance;
  average_over_texels(image, {}, [&](double y) {
    const Rgb gradation = sky.gradation(y);
    return [&sky, &ground, gradation, y, scale = options.scale](Vec3 direction) {
      return y > 0 ? scale * sky.radiance(direction, gradation) : ground;
    };
  });
  if (options.sun) add_sun(options, daylight, image);
}

// Moon & Spencer 1942: L = L_zenith (1 + 2 sin elevation) / 3, hence E = 7 pi / 9 L_zenith; and E = 300 + 21000 sin
// (elevation of the sun) lx (Krochmann & Seidl 1974). By night the first term falls as the twilight does: cut to zero.
void fill_overcast(const SkyOptions& options, Image& image) {
  const double sine = std::sin(options.elevation * pi / 180);
  const double irradiance = std::max(1e-3, 300 + 21000 * sine) / luminous_efficacy;
  const double zenith = options.scale * irradiance / (7 * pi / 9);
  const double ground = options.scale * options.albedo * irradiance / pi;
  average_over_texels(image, {}, [=](double y) {
    const double radiance = y > 0 ? zenith * (1 + 2 * y) / 3 : ground;
    return [radiance](Vec3) { return Rgb{radiance, radiance, radiance}; };
  });
}

void fill_texel(const SkyOptions& options, Image& image) {
  const int x = options.x < 0 ? options.width / 2 : options.x;
  const int y = options.y < 0 ? options.height / 2 : options.y;
  for (int c = 0; c < 3; ++c) image.at(x, y)[c] = static_cast<float>(options.scale * options.value[c]);
}

void fill_sh(const SkyOptions& options, Image& image) {
  // A texel sees at most degree / height of a half wave: two nodes more than that is exact to rounding. Around, the 512
  // nodes of a turn are as many for narrower ones.
  const int nodes = 3 + 2 * options.degree / options.height;
  average_over_texels(image, {256, std::min(nodes, 64)}, [&options](double) {
    return [&options, basis = std::vector<double>(sh_count(options.degree))](Vec3 direction) mutable {
      evaluate_sh_basis(direction, options.degree, basis);
      return options.scale * (options.offset + basis[sh_index(options.degree, options.order)]) *
             options.value;
    };
  });
}

}  // namespace

Image make_sky(const SkyOptions& options) {
  check(options);
  Image image(options.width, options.height, 3);
  switch (options.kind) {
    case SkyKind::day: fill_day(options, image); break;
    case SkyKind::studio:
      average_over_texels(image, {}, [&](double) {
        return [&](Vec3 direction) { return options.scale * studio_radiance(direction); };
      });
      break;
    case SkyKind::overcast: fill_overcast(options, image); break;
    case SkyKind::constant:
      average_over_texels(image, {1, 1},
                          [&](double) { return [&](Vec3) { return options.scale * options.value; }; });
      break;
    case SkyKind::texel: fill_texel(options, image); break;
    case SkyKind::ramp:
      average_over_texels(image, {1, 1}, [&](double y) {
        const Rgb row = options.scale * (options.offset + options.slope * y) * options.value;
        return [row](Vec3) { return row; };
      });
      break;
    case SkyKind::sh: fill_sh(options, image); break;
    case SkyKind::labelled:
      image = labelled_map({Mapping::equirectangular, options.width, options.height}).image;
      for (float& value : image.pixels) value *= static_cast<float>(options.scale);
      break;
  }
  return image;
}

}  // namespace welkin

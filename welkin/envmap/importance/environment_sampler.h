#pragma once
#include <array>
#include <memory>
#include <span>

#include <welkin/geometry/vec3f.h>
#include <welkin/image/image.h>
#include <welkin/image/rgb.h>

namespace welkin {

/// What the density of samples is proportional to.
enum class EnvironmentDensity {
  luminance_solid_angle,  ///< luminance x the texel's solid angle: the sphere's own density, the default
  luminance,  ///< luminance alone: samples the image as if it were flat; right, and noisier (poles)
};

/// How a texel is found.
enum class EnvironmentTable {
  inverse,       ///< CDF of rows, then of the row's columns, by cutpoints and bisection: monotone, keeps stratification
  alias,         ///< one look-up (Walker 1977, Vose 1991); scatters neighbouring numbers
  hierarchical,  ///< a quadtree of quantised splits: monotone, a quarter of the memory of `inverse`
};

/// What the radiance between texel centres is.
enum class EnvironmentInterpolation { box, bilinear };

struct EnvironmentSamplerOptions {
  EnvironmentDensity density = EnvironmentDensity::luminance_solid_angle;
  EnvironmentTable table = EnvironmentTable::inverse;
  EnvironmentInterpolation interpolation = EnvironmentInterpolation::box;
  /// What luminance is made of, each > 0: Rec. 709; {0.2989, 0.5866, 0.1145} are the older weights of many demonstrations.
  std::array<float, 3> luminance_weights{0.2126f, 0.7152f, 0.0722f};
};

struct EnvironmentSample {
  Vec3f direction;  ///< world, unit
  Rgb radiance;     ///< of the environment there
  float pdf = 0;    ///< per steradian, > 0; 0: the environment is black and there is no sample
};

/// Where a direction lies in a map.
struct EnvironmentPlace {
  float s = 0, t = 0;  ///< of the map's width, from the left, and height, from the top
  float sine = 0;      ///< of the angle to the poles
};

/// Throws Error for a map or options that cannot be sampled, as EnvironmentSampler says.
void check_sampled_map(const Image& radiance, const EnvironmentSamplerOptions& options);

/// Directions towards an environment with a density that follows its radiance: the 2-D inverse transform over a
/// piecewise constant density (Pharr, Jakob & Humphreys 2016, section 13.6.7), in three kinds of tables.
/// sample, pdf and inverse belong together: pdf is exactly the density of sample (per steradian; integrates to 1), above 0
/// wherever radiance is, and inverse(sample(u).direction) is u but for rounding (not for alias). Immutable, thread-safe.
class EnvironmentSampler {
 public:
  /// radiance: equirectangular, 3 channels, at most 65,536 each way, finite and >= 0. Throws Error otherwise. What is
  /// below 1e-25 counts as black.
  explicit EnvironmentSampler(Image radiance, const EnvironmentSamplerOptions& options = {});
  ~EnvironmentSampler();
  EnvironmentSampler(EnvironmentSampler&&) noexcept;
  EnvironmentSampler& operator=(EnvironmentSampler&&) noexcept;

  EnvironmentSample sample(Vec2f u) const;  ///< u in [0, 1)^2
  /// sample of each into `samples`, of the same size: faster, because waits for memory overlap.
  void sample(std::span<const Vec2f> u, std::span<EnvironmentSample> samples) const;
  float pdf(Vec3f direction) const;  ///< per steradian
  /// The u that gives this direction. Throws Error for alias and for bilinear, where several give it.
  Vec2f inverse(Vec3f direction) const;
  Rgb radiance(Vec3f direction) const;          ///< as options.interpolation says
  EnvironmentSample at(Vec3f direction) const;  ///< radiance and pdf at once, cheaper
  /// The same in two steps: places() finds the places, of the same number, and asks for the memory that at() reads.
  void places(std::span<const Vec3f> directions, std::span<EnvironmentPlace> found) const;
  EnvironmentSample at(Vec3f direction, const EnvironmentPlace& place) const;
  double mean_luminance() const;    ///< over the sphere
  std::size_t table_bytes() const;  ///< of the tables, without the map itself

  /// The texels themselves, for tables that others build on this map.
  struct Texel {
    int x = 0, y = 0;
  };
  const Image& map() const;
  const EnvironmentSamplerOptions& options() const;
  Texel texel_of(Vec3f direction) const;
  /// Uniform per steradian in the texel for `within` in [0, 1)^2; texel_of gives the texel back.
  Vec3f direction_in(Texel texel, Vec2f within) const;
  float texels_per_steradian(int y) const;  ///< 1 / solid angle of a texel of this row

 private:
  struct Tables;
  std::unique_ptr<Tables> tables_;
};

}  // namespace welkin

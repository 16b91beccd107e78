#pragma once
#include <cstddef>
#include <memory>

#include <welkin/brdf/scatter/scatter.h>
#include <welkin/envmap/importance/environment_sampler.h>
#include <welkin/geometry/frame.h>

namespace welkin {

struct ProductOptions {
  int candidates = 2;  ///< of the tables for each sample, 1 to 16
};

struct ProductSample {
  Vec3f direction;  ///< world, unit
  Rgb light;        ///< what comes from there to the viewer, over its chance; black: nothing to trace
};

/// Directions by BRDF times environment. For a ladder of lobes (GGX widths, and the cosine) and a grid of directions about
/// which they lie, the light of each of some hundred tiles of the map times the lobe there is tabulated ahead of time
/// (Clarberg et al. 2005 take the same product as it is needed, in wavelets). At a surface the lobe of its reflection
/// direction picks a tile, the tile's own table a texel, with a density known exactly. A few such candidates are
/// compared with the true BRDF and one is kept (Talbot, Cline & Egbert 2005); a sample of the BRDF joins by multiple
/// importance sampling (Veach & Guibas 1995). Two rays, as that of BRDF and environment has. Immutable, thread-safe.
class ProductSampler {
 public:
  /// Keeps a reference to the environment. Takes about 0.1 s, and as much memory as the map's CDF and 30 MB. Throws
  /// Error for options out of their range.
  explicit ProductSampler(const EnvironmentSampler& environment, const ProductOptions& options = {});
  ~ProductSampler();
  ProductSampler(ProductSampler&&) noexcept;
  ProductSampler& operator=(ProductSampler&&) noexcept;

  /// The best of some candidates, for u in [0, 1)^2 and `keep` in [0, 1). view: local, z > 0. `along` is the direction
  /// (world, unit) of one sample of the BRDF; density_along becomes the density of all candidates together there, per steradian:
  /// n p, which integrates to n or is 0 all over. With that sample's density p_brdf and weight f cos / p_brdf,
  ///   sample.light V(sample.direction) + weight L(along) V(along) p_brdf / (p_brdf + density_along)
  /// is an unbiased estimate of the light of the environment that the surface reflects, V = 1 where nothing is in the way.
  /// Of delta lobes nothing is sampled, and density_along is 0: the mirrored ray finds all.
  ProductSample sample(const Scatter& scatter, const LocalFrame& frame, Vec3f view, Vec2f u, float keep,
                       Vec3f along, float& density_along) const;
  std::size_t table_bytes() const;

 private:
  struct Tables;
  std::unique_ptr<Tables> tables_;
};

}  // namespace welkin

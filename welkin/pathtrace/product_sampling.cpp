#include <welkin/pathtrace/product_sampling.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <welkin/brdf/scatter/layers.h>
#include <welkin/error.h>
#include <welkin/pathtrace/product_tables.h>
#include <welkin/sampling/warp.h>

// One sample x_0 of the BRDF and n candidates x_1 ... x_n of the tables' density
//   p_table(w) = sum over lobes of share P(bin | lobe, cell) P(tile | bin) P(texel | tile) / solid angle of the texel.
// With the balance heuristic every one of them adds, whatever its kind,
//   c(x) = f(x) cos L(x) / (p_brdf(x) + n p_table(x)),
// and the expectation of the sum of all c V, V = 1 where nothing is in the way, is the integral of f cos L V: p_brdf > 0
// wherever f cos is. Of the candidates one x is kept, with probability y(c(x)) / Y, Y the sum of the luminances y, and
// its c divided by that. Where V is 1 the luminance of what remains is that of the sum: nothing is lost but colour noise.
// The sample of the BRDF has a ray of its own: it sees the sky where what is bright is hidden.
//
// The numbers of the candidates are one point shifted by multiples of (1 / n, the golden ratio) modulo 1, a lattice:
// stratified among themselves, and across samples as the point that was handed in is. The shares of the lobes are what
// they are estimated to reflect: the light under the cell's lobe times the BRDF's share of that lobe.

namespace welkin {
namespace {

using scatter_detail::Layers;

constexpr int glossy_lobes = 9;      // GGX widths 0.05 x sqrt(2)^k, up to 0.8
constexpr float narrowest = 0.035f;  // below it the BRDF's samples are as good

bool is_layered(ScatterModel model) {
  return model == ScatterModel::ggx || model == ScatterModel::ggx_conductor ||
         model == ScatterModel::coated_diffuse || model == ScatterModel::metallic_roughness;
}

// A BRDF seen from one direction, ready for several light directions.
struct Prepared {
  Prepared(const Scatter& s, Vec3f v) : scatter(s), view(v), layered(is_layered(s.model)) {
    if (layered) layers = scatter_detail::make_layers(s, v);
  }
  ScatterValue value(Vec3f light) const {
    return layered ? scatter_detail::layers_value(layers, light) : evaluate_with_pdf(scatter, light, view);
  }
  ScatterSample sampled(Vec2f u, float lobe) const {
    return layered ? scatter_detail::sample_layers(layers, u, lobe) : sample(scatter, view, u, lobe);
  }

  const Scatter& scatter;
  Vec3f view;
  bool layered;
  Layers layers;
};

float wrapped(float v) { return v < 1 ? v : v - 1; }

// Multiples of (1 / count, the golden ratio) from `start` on, modulo 1.
Vec2f lattice_point(Vec2f start, int i, int count) {
  const float golden = static_cast<float>(i) * 0.618033989f;
  const Vec2f point{wrapped(start.x + static_cast<float>(i) / static_cast<float>(count)),
                    wrapped(start.y + (golden - std::floor(golden)))};
  return {std::min(point.x, largest_below_1), std::min(point.y, largest_below_1)};
}

// Keeps one of what it is shown with a chance in proportion to its strength, and reuses one number for all decisions.
class Keeper {
 public:
  explicit Keeper(float choice) : choice_(choice) {}

  void show(const ProductSample& candidate) {
    const float strength = luminance(candidate.light);
    if (!(strength > 0)) return;
    sum_ += strength;
    const float chance = strength / sum_;
    if (choice_ < chance) {
      kept_ = candidate;
      kept_strength_ = strength;
      choice_ /= chance;
    } else {
      choice_ = (choice_ - chance) / (1 - chance);
    }
  }
  ProductSample result() const {
    if (!(sum_ > 0)) return {};
    return {kept_.direction, (sum_ / kept_strength_) * kept_.light};
  }

 private:
  float choice_, sum_ = 0, kept_strength_ = 1;
  ProductSample kept_;
};

// Which lobes stand for a BRDF: their shares of what it reflects, and the width of the glossy one.
struct Profile {
  float glossy = 0, diffuse = 0, alpha = 1;
};

Profile profile_of(const Prepared& p) {
  const Scatter& s = p.scatter;
  if (p.layered)
    return {p.layers.p_facets, p.layers.p_multiple + p.layers.p_diffuse, std::sqrt(s.alpha_x * s.alpha_y)};
  if (s.model == ScatterModel::phong || s.model == ScatterModel::blinn_phong)
    return {1, 0, std::sqrt(2 / (s.exponent + 2))};
  return {0, 1, 1};
}

}  // namespace

struct ProductSampler::Tables {
  Tables(const EnvironmentSampler& sky, const ProductOptions& chosen)
      : environment(sky),
        options(chosen),
        map(sky.map()),
        bins{TileBins(map, 0), TileBins(map, 1), TileBins(map, 2)} {
    lobes.emplace_back(bins[2], 0.0f);
    float alpha = 0.05f;
    for (int k = 0; k < glossy_lobes; ++k, alpha *= 1.41421356f)
      lobes.emplace_back(bins[alpha < 0.13f ? 0 : alpha < 0.26f ? 1 : 2], alpha);
  }

  struct Lobe {
    const LobeTable* table = nullptr;
    const LobeTable::Cell* cell = nullptr;
    float share = 0;  // of the candidates; together as many as there are
  };
  struct Mixture {
    Lobe glossy, diffuse;
  };
  Mixture mixture(const Prepared& prepared, const LocalFrame& frame) const;
  float tile_chance(const Lobe& lobe, int tile_column, int tile_row) const;
  float lobe_pdf(const Mixture& mixture, EnvironmentSampler::Texel texel) const;
  struct Found {
    EnvironmentSampler::Texel texel;
    Vec2f within;
    float pdf = 0;  // of both lobes together, per steradian
  };
  Found choose(const Lobe& own, const Lobe& other, Vec2f u) const;
  ProductSample weighted(Vec3f direction, EnvironmentSampler::Texel texel, Rgb value, float brdf_pdf,
                         float table_pdf) const;

  const EnvironmentSampler& environment;
  ProductOptions options;
  TiledMap map;
  std::array<TileBins, 3> bins;
  std::vector<LobeTable> lobes;  // the cosine, then the glossy ones
};

ProductSampler::Tables::Mixture ProductSampler::Tables::mixture(const Prepared& prepared,
                                                                const LocalFrame& frame) const {
  const Profile profile = profile_of(prepared);
  Mixture m;
  if (profile.diffuse > 0) {
    m.diffuse.table = &lobes[0];
    m.diffuse.cell = &lobes[0].cell_of(frame.normal);
    m.diffuse.share = profile.diffuse * m.diffuse.cell->mass;
  }
  if (profile.glossy > 0 && profile.alpha > narrowest) {
    const float step = 2 * std::log2(profile.alpha * 20);
    const int k = std::clamp(static_cast<int>(std::lround(step)), 0, glossy_lobes - 1);
    m.glossy.table = &lobes[1 + k];
    const Vec3f v = prepared.view;
    m.glossy.cell = &m.glossy.table->cell_of(frame.to_world({-v.x, -v.y, v.z}));
    m.glossy.share = profile.glossy * m.glossy.cell->mass;
  }
  const float sum = m.diffuse.share + m.glossy.share;
  if (!(sum > 0)) return m;
  const float count = static_cast<float>(options.candidates);
  m.diffuse.share *= count / sum;
  m.glossy.share *= count / sum;
  return m;
}

float ProductSampler::Tables::tile_chance(const Lobe& lobe, int i, int j) const {
  const TileBins& b = lobe.table->bins();
  return lobe.share * lobe.table->probability(*lobe.cell, i >> b.shift(), j >> b.shift()) *
         b.probability(i, j);
}

float ProductSampler::Tables::lobe_pdf(const Mixture& mixture, EnvironmentSampler::Texel texel) const {
  const int i = map.tile_column(texel.x), j = map.tile_row(texel.y);
  float chance = 0;
  if (mixture.glossy.share > 0) chance += tile_chance(mixture.glossy, i, j);
  if (mixture.diffuse.share > 0) chance += tile_chance(mixture.diffuse, i, j);
  return chance > 0 ? chance * map.probability(texel.x, texel.y) * environment.texels_per_steradian(texel.y)
                    : 0;
}

// The first number picks the bin, the second the tile and the texel; what is left of both is the place in it.
ProductSampler::Tables::Found ProductSampler::Tables::choose(const Lobe& own, const Lobe& other,
                                                             Vec2f u) const {
  float of_bin = 0, of_tile = 0;
  const TileBins& b = own.table->bins();
  const int bin = own.table->choose(*own.cell, u.x, of_bin);
  const int tile = b.choose(bin, u.y, of_tile);
  const TiledMap::Texel found = map.choose(tile, {u.y, u.x});
  float chance = own.share * of_bin * of_tile;
  if (other.share > 0) chance += tile_chance(other, map.tile_column(found.x), map.tile_row(found.y));
  return {{found.x, found.y},
          found.within,
          chance * found.probability * environment.texels_per_steradian(found.y)};
}

// What one candidate adds to the sum over all; both densities are those of all samples of their kind together.
ProductSample ProductSampler::Tables::weighted(Vec3f direction, EnvironmentSampler::Texel texel, Rgb value,
                                               float brdf_pdf, float table_pdf) const {
  const float pdf = brdf_pdf + table_pdf;
  if (!(pdf > 0)) return {};
  const bool box = environment.options().interpolation == EnvironmentInterpolation::box;
  const float* p = environment.map().at(texel.x, texel.y);
  const Rgb radiance = box ? Rgb{p[0], p[1], p[2]} : environment.radiance(direction);
  return {direction, (1 / pdf) * (value * radiance)};
}

ProductSampler::ProductSampler(const EnvironmentSampler& environment, const ProductOptions& options) {
  if (options.candidates < 1 || options.candidates > 16)
    throw Error("product sampling compares 1 to 16 candidates");
  tables_ = std::make_unique<Tables>(environment, options);
}
ProductSampler::~ProductSampler() = default;
ProductSampler::ProductSampler(ProductSampler&&) noexcept = default;
ProductSampler& ProductSampler::operator=(ProductSampler&&) noexcept = default;

ProductSample ProductSampler::sample(const Scatter& scatter, const LocalFrame& frame, Vec3f view, Vec2f u,
                                     float keep, Vec3f along, float& density_along) const {
  const Tables& tables = *tables_;
  density_along = 0;
  if (is_delta(scatter) || !(view.z > 0)) return {};
  const Prepared prepared(scatter, view);
  const Tables::Mixture mixture = tables.mixture(prepared, frame);
  const float shares = mixture.glossy.share + mixture.diffuse.share;
  if (!(shares > 0)) return {};
  density_along = tables.lobe_pdf(mixture, tables.environment.texel_of(along));
  Keeper keeper(keep);
  const float of_glossy = mixture.glossy.share / shares;
  for (int i = 0; i < tables.options.candidates; ++i) {
    Vec2f v = lattice_point(u, i, tables.options.candidates);
    const bool glossy = v.x < of_glossy;
    v.x = std::min(glossy ? v.x / of_glossy : (v.x - of_glossy) / (1 - of_glossy), largest_below_1);
    const Tables::Found found = glossy ? tables.choose(mixture.glossy, mixture.diffuse, v)
                                       : tables.choose(mixture.diffuse, mixture.glossy, v);
    const Vec3f direction = tables.environment.direction_in(found.texel, found.within);
    const Vec3f light = frame.to_local(direction);
    if (!(light.z > 0)) continue;
    const ScatterValue f = prepared.value(light);
    keeper.show(tables.weighted(direction, found.texel, f.value, f.pdf, found.pdf));
  }
  return keeper.result();
}

std::size_t ProductSampler::table_bytes() const {
  std::size_t bytes = tables_->map.bytes();
  for (const LobeTable& lobe : tables_->lobes) bytes += lobe.bytes();
  return bytes;
}

}  // namespace welkin

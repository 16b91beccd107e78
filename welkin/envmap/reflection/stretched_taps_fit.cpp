#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <welkin/envmap/reflection/simplex_search.h>
#include <welkin/envmap/reflection/stretched_taps.h>
#include <welkin/error.h>
#include <welkin/parallel/parallel_for.h>

// The table of stretched taps, texel by texel. Each texel has several local minima of nearly the same error, and a
// table that jumped between them could not be interpolated. So one column (cos_view of about 0.35) is fitted first,
// from several starts in one row, then row by row from its neighbour; and each row from its texel in that column
// outwards, each texel from the one before, with a small penalty on change.

namespace welkin {
namespace {

constexpr double stiffness = 3e-4;  // of the penalty on change, in shares of the error's own scale

using Taps = std::vector<StretchedTap>;

double square(double x) { return x * x; }

void check(const ChainShape& chain, const StretchedTapsOptions& o) {
  if (chain.levels < 2 || chain.levels > 14 || chain.size >> (chain.levels - 1) < 1)
    throw Error(fmt::format("no chain of size {} has {} levels to tap", chain.size, chain.levels));
  if (o.taps < 1 || o.taps > 4)
    throw Error(fmt::format("the number of taps must lie in [1, 4], not {}", o.taps));
  for (int size : {o.cos_size, o.roughness_size})
    if (size < 4 || size > 256)
      throw Error(fmt::format("a table of taps has 4 to 256 texels along an axis, not {}", size));
  if (!(o.light_power >= 0 && o.light_power <= 4))
    throw Error(fmt::format("the power of the light must lie in [0, 4], not {}", o.light_power));
}

// Variables of a search: offset / alpha and roughness / r of each tap, all of order 1.
struct Search {
  const TapLobe& lobe;
  double roughness;
  double unit;  // of the error: that of the best single tap

  Taps taps_at(std::span<const double> x) const {
    Taps taps(x.size() / 2);
    for (std::size_t k = 0; k < taps.size(); ++k) {
      taps[k].offset = x[2 * k] * roughness * roughness;
      taps[k].perceptual_roughness = x[2 * k + 1] * roughness;
    }
    return taps;
  }

  std::vector<double> variables(const Taps& taps) const {
    std::vector<double> x;
    for (const StretchedTap& tap : taps) {
      x.push_back(tap.offset / (roughness * roughness));
      x.push_back(tap.perceptual_roughness / roughness);
    }
    return x;
  }

  // From `start`; changes from there cost `penalty`.
  Taps run(const std::vector<double>& start, double penalty, int iterations, double* error = nullptr) const {
    const auto function = [&](std::span<const double> x) {
      Taps taps = taps_at(x);
      double change = 0;
      for (std::size_t i = 0; i < x.size(); ++i) change += (x[i] - start[i]) * (x[i] - start[i]);
      return lobe.solve(taps) + penalty * unit * change;
    };
    std::vector<double> step(start.size());
    for (std::size_t i = 0; i < step.size(); ++i) step[i] = i % 2 == 0 ? 0.2 : -0.1;
    const SimplexMinimum found = simplex_search(function, start, step, iterations);
    if (error) *error = found.value;
    Taps taps = taps_at(found.point);
    lobe.solve(taps);
    return taps;
  }
};

Search make_search(const TapLobe& lobe, double roughness) {
  Taps one(1, StretchedTap{0, roughness, 0, 0});
  return {lobe, roughness, std::abs(lobe.solve(one))};
}

Taps fit_afresh(const Search& search, int taps) {
  Taps best;
  double least = 0;
  for (int start = 0; start < 6; ++start) {
    std::vector<double> x;
    for (int k = 0; k < taps; ++k) {
      const double along = taps > 1 ? 2.0 * k / (taps - 1) - 1 : 0;
      x.push_back(along * (start % 2 == 0 ? 1 : 2) - (start >= 4 ? 1 : 0));
      x.push_back(0.9 - (start % 3 == 0 ? 0.25 * along : 0));
    }
    double error = 0;
    Taps fit = search.run(x, 0, 200, &error);
    fit = search.run(search.variables(fit), 0, 150, &error);
    if (best.empty() || error < least) {
      best = fit;
      least = error;
    }
  }
  std::sort(best.begin(), best.end(),
            [](const StretchedTap& a, const StretchedTap& b) { return a.offset < b.offset; });
  return best;
}

Taps fit_from(const TapSpace& space, double roughness, double cos_view, const Taps& neighbour) {
  const TapLobe lobe(space, cos_view, roughness);
  const Search search = make_search(lobe, roughness);
  return search.run(search.variables(neighbour), stiffness, 70);
}

// The taps of a neighbouring row as a start: the lobe scales with alpha.
Taps scaled(Taps taps, double ratio) {
  for (StretchedTap& tap : taps) {
    tap.offset *= ratio * ratio;
    tap.perceptual_roughness *= ratio;
  }
  return taps;
}

}  // namespace

StretchedTapsTable make_stretched_taps_table(const ChainShape& chain, const StretchedTapsOptions& options) {
  check(chain, options);
  const int columns = options.cos_size, rows = options.roughness_size;
  const TapSpace space(chain, options.light_power);
  const auto roughness = [&](int j) { return (j + 0.5) / rows; };
  const auto cos_view = [&](int i) { return square((i + 0.5) / columns); };
  std::vector<std::vector<Taps>> texels(rows, std::vector<Taps>(columns));

  const int middle = static_cast<int>(0.59 * columns), start = rows / 2;
  const TapLobe lobe(space, cos_view(middle), roughness(start));
  texels[start][middle] = fit_afresh(make_search(lobe, roughness(start)), options.taps);
  const auto continue_column = [&](int j, int from) {
    const Taps neighbour = scaled(texels[from][middle], roughness(j) / roughness(from));
    texels[j][middle] = fit_from(space, roughness(j), cos_view(middle), neighbour);
  };
  for (int j = start + 1; j < rows; ++j) continue_column(j, j - 1);
  for (int j = start - 1; j >= 0; --j) continue_column(j, j + 1);
  parallel_for(texels.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j) {
      const auto fit = [&](int i, int from) {
        texels[j][i] = fit_from(space, roughness(static_cast<int>(j)), cos_view(i), texels[j][from]);
      };
      for (int i = middle + 1; i < columns; ++i) fit(i, i - 1);
      for (int i = middle - 1; i >= 0; --i) fit(i, i + 1);
    }
  });

  StretchedTapsTable table{chain, options.taps, columns, rows, {}};
  for (const std::vector<Taps>& row : texels)
    for (const Taps& taps : row) table.texels.insert(table.texels.end(), taps.begin(), taps.end());
  return table;
}

}  // namespace welkin

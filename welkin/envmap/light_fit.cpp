#include <welkin/envmap/light_fit.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include <welkin/envmap/statistics.h>
#include <welkin/error.h>
#include <welkin/sh/basis.h>
#include <welkin/sh/convolution.h>
#include <welkin/sh/transform.h>
#include <welkin/sphere/equirect.h>

namespace welkin {

// Let A_l be the clamped cosine. Of the irradiance E, nine coefficients hold the degrees 0 to 2 exactly, and degree 3 is
// zero; what they miss is E' = sum over l >= 4 of A_l L_lm Y_lm. A light of irradiance w from d brings
// w K_d, K_d = sum A_l Y_lm(d) Y_lm. With inner products over the sphere,
//   <E', K_d>  = sum over l >= 4 of A_l^2 L_lm Y_lm(d) =: g(d),     <K_d, K_e> = sum A_l^2 (2l + 1)/(4 pi) P_l(dot(d, e)) =: h,
// so all that is needed is one map g, the radiance convolved with A_l^2, and one function h of an angle. The best
// single light stands where g is largest, as h(1) is the same everywhere. For several, w solves the normal
// equations H w = g, and the error falls by g^T H^-1 g, which is climbed.
namespace {

// A_l^2 falls with l^-5, so what is beyond leaves 1e-7 of E'.
constexpr int top_degree = 40;

// Of the mean irradiance: what nine coefficients miss by less is the transform's rounding, which no light should follow.
constexpr double rounding = 1e-7;

std::vector<double> squared_lobe() {
  std::vector<double> factors = cosine_lobe(top_degree);
  for (int l = 0; l <= top_degree; ++l) factors[l] = l < 4 ? 0 : factors[l] * factors[l];
  return factors;
}

double luminance(const double* c) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; }

class Fitter {
 public:
  explicit Fitter(const Image& map) : factors_(squared_lobe()) {
    const Spectrum spectrum = analyze(map, {.max_degree = top_degree});
    grid_ = synthesize(convolve(spectrum, factors_), 8 * top_degree, 16 * top_degree);
    const std::vector<double> power = luminance_power(spectrum);
    for (int l = 4; l <= top_degree; ++l) missed_ += factors_[l] * power[l];
  }

  double missed() const { return missed_; }

  std::array<double, 3> g(Vec3 d) const {
    std::array<float, 3> value{};
    interpolate(grid_, d, value.data());
    return {value[0], value[1], value[2]};
  }

  double h(double cosine) const {
    double sum = 0, before = 1, here = cosine;
    for (int l = 1; l <= top_degree; ++l) {
      sum += factors_[l] * (2 * l + 1) / (4 * std::numbers::pi) * here;
      before = std::exchange(here, ((2 * l + 1) * cosine * here - l * before) / (l + 1));
    }
    return sum;
  }

  // Weights of lights in the given directions for one right-hand side, >= 0: those that come out negative are left out.
  std::vector<double> weights(const std::vector<Vec3>& directions, const std::vector<double>& right) const {
    std::vector<bool> used(directions.size(), true);
    for (;;) {
      const std::vector<double> w = solve(directions, right, used);
      const auto worst = std::min_element(w.begin(), w.end());
      if (worst == w.end() || !(*worst < 0)) return w;
      used[worst - w.begin()] = false;
    }
  }

  // By how much lights in these directions lower the squared error of luminance.
  double gain(const std::vector<Vec3>& directions) const {
    std::vector<double> right;
    for (Vec3 d : directions) right.push_back(luminance(g(d).data()));
    const std::vector<double> w = weights(directions, right);
    double sum = 0;
    for (std::size_t i = 0; i < w.size(); ++i) sum += w[i] * right[i];
    return sum;
  }

  // The squared error of luminance that these lights leave.
  double left(const std::vector<DirectionalLight>& lights) const {
    double sum = missed_;
    for (const DirectionalLight& a : lights) {
      sum -= 2 * a.illuminance * luminance(g(a.direction).data());
      for (const DirectionalLight& b : lights)
        sum += a.illuminance * b.illuminance * h(dot(a.direction, b.direction));
    }
    return std::max(0.0, sum);
  }

  // The direction that gains most beside those that are there, on a grid of about 3 degrees.
  Vec3 best_addition(std::vector<Vec3> directions) const {
    constexpr int rows = 60;
    Vec3 best{0, 1, 0};
    double most = -1;
    directions.push_back(best);
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < 2 * rows; ++x) {
        directions.back() = equirect_direction({(x + 0.5) / (2 * rows), (y + 0.5) / rows});
        if (const double here = gain(directions); here > most) most = here, best = directions.back();
      }
    return best;
  }

  // Compass search: each direction tries a step to four sides; steps halve when no try is better by more than rounding.
  void climb(std::vector<Vec3>& directions) const {
    double here = gain(directions);
    const double least = 1e-9 * missed_;
    for (double step = 0.03; step > 1e-4;) {
      bool moved = false;
      for (std::size_t i = 0; i < directions.size(); ++i) {
        const Vec3 start = directions[i];
        const Vec3 side = normalized(cross(start, std::abs(start.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0}));
        const Vec3 up = cross(start, side);
        for (Vec3 way : {side, -side, up, -up}) {
          const Vec3 kept = directions[i];
          directions[i] = normalized(start + step * way);
          const double there = gain(directions);
          if (there > here + least)
            here = there, moved = true;
          else
            directions[i] = kept;
        }
      }
      if (!moved) step /= 2;
    }
  }

 private:
  static std::vector<double> luminance_power(const Spectrum& s) {
    std::vector<double> power(top_degree + 1);
    constexpr std::array<double, 3> weight{0.2126, 0.7152, 0.0722};
    for (int m = 0; m <= top_degree; ++m)
      for (int l = m; l <= top_degree; ++l) {
        std::complex<double> value = 0;
        for (int c = 0; c < 3; ++c) value += weight[c] * s.values[s.index(l, m) * 3 + c];
        power[l] += (m == 0 ? 1 : 2) * std::norm(value);
      }
    return power;
  }

  // Gaussian elimination of the normal equations; H is positive definite for distinct directions, and the little that
  // is added to its diagonal keeps it so for equal ones.
  std::vector<double> solve(const std::vector<Vec3>& directions, const std::vector<double>& right,
                            const std::vector<bool>& used) const {
    const std::size_t n = directions.size();
    std::vector<double> a(n * n), w = right;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        a[i * n + j] = used[i] && used[j] ? h(i == j ? 1 : dot(directions[i], directions[j])) : 0;
        if (i == j) a[i * n + j] = used[i] ? a[i * n + j] * (1 + 1e-9) : 1;
      }
    for (std::size_t i = 0; i < n; ++i)
      if (!used[i]) w[i] = 0;
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t i = k + 1; i < n; ++i) {
        const double factor = a[i * n + k] / a[k * n + k];
        for (std::size_t j = k; j < n; ++j) a[i * n + j] -= factor * a[k * n + j];
        w[i] -= factor * w[k];
      }
    for (std::size_t k = n; k-- > 0;) {
      for (std::size_t j = k + 1; j < n; ++j) w[k] -= a[k * n + j] * w[j];
      w[k] /= a[k * n + k];
    }
    return w;
  }

  std::vector<double> factors_;
  SphereGrid grid_;
  double missed_ = 0;
};

std::vector<DirectionalLight> make_lights(const Fitter& fitter, const std::vector<Vec3>& directions,
                                          double map_flux) {
  std::vector<DirectionalLight> lights(directions.size());
  std::vector<std::array<double, 3>> right;
  for (Vec3 d : directions) right.push_back(fitter.g(d));
  for (int c = 0; c < 3; ++c) {
    std::vector<double> channel;
    for (const auto& r : right) channel.push_back(r[c]);
    const std::vector<double> w = fitter.weights(directions, channel);
    for (std::size_t i = 0; i < w.size(); ++i) lights[i].irradiance[c] = w[i];
  }
  for (std::size_t i = 0; i < lights.size(); ++i) {
    DirectionalLight& light = lights[i];
    light.direction = directions[i];
    light.illuminance = luminance(light.irradiance.data());
    light.share = map_flux > 0 ? light.illuminance / map_flux : 0;
    for (int c = 0; c < 3; ++c)
      light.color[c] = light.illuminance > 0 ? light.irradiance[c] / light.illuminance : 1;
  }
  std::erase_if(lights, [](const DirectionalLight& light) { return !(light.illuminance > 0); });
  std::stable_sort(lights.begin(), lights.end(), [](const DirectionalLight& a, const DirectionalLight& b) {
    return a.illuminance > b.illuminance;
  });
  return lights;
}

// Degrees 4, 6, 8, ... are the same for a light from d and from -d. Nine coefficients make up for the difference, but
// shadows and highlights would come from the wrong side. So each light gets the side that leaves least of the map's
// luminance moment, the integral of radiance times direction, to the coefficients.
void choose_sides(std::vector<DirectionalLight>& lights, const ShCoefficients& map) {
  const double y_1 = std::sqrt(3 / (4 * std::numbers::pi));  // Y_1m = y_1 times y, z, x
  const auto moment = [&](std::size_t i) { return luminance(&map.values[3 * i]) / y_1; };
  const Vec3 of_map{moment(3), moment(1), moment(2)};
  unsigned best = 0;
  double least = 0;
  for (unsigned flipped = 0; flipped < 1u << lights.size(); ++flipped) {
    Vec3 rest = of_map;
    for (std::size_t i = 0; i < lights.size(); ++i)
      rest = rest - ((flipped >> i & 1) ? -1 : 1) * lights[i].illuminance * lights[i].direction;
    const double here = length(rest);
    if (flipped == 0 || here < least * (1 - 1e-9)) best = flipped, least = here;
  }
  for (std::size_t i = 0; i < lights.size(); ++i)
    if (best >> i & 1) lights[i].direction = -lights[i].direction;
}

}  // namespace

LightFit fit_lights(const Image& equirect, int max_lights) {
  assert(equirect.channels == 3);
  if (max_lights < 1 || max_lights > 8) throw Error("the number of lights to fit must be 1 to 8");
  const Fitter fitter(equirect);
  const double sphere = 4 * std::numbers::pi, flux = luminance(map_statistics(equirect).energy.data());
  LightFit fit;
  fit.error_before = std::sqrt(fitter.missed() / sphere);
  if (fit.error_before > rounding * flux / 4) {  // the mean irradiance is flux / 4
    std::vector<Vec3> directions;
    for (int i = 0; i < max_lights; ++i) {
      directions.push_back(fitter.best_addition(directions));
      fitter.climb(directions);
    }
    fit.lights = make_lights(fitter, directions, flux);
  }
  fit.rest = project_equirect(equirect, 2);
  choose_sides(fit.lights, fit.rest);
  fit.error = std::sqrt(fitter.left(fit.lights) / sphere);
  std::array<double, 9> basis{};
  for (const DirectionalLight& light : fit.lights) {
    evaluate_sh_basis(light.direction, 2, basis);
    for (std::size_t i = 0; i < 9; ++i)
      for (int c = 0; c < 3; ++c) fit.rest.values[3 * i + c] -= light.irradiance[c] * basis[i];
  }
  return fit;
}

}  // namespace welkin

#include <welkin/envmap/sky/daylight.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <welkin/sampling/quadrature.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

constexpr double radians(double degrees) { return degrees * (pi / 180); }

// Multi-lobe fits to the CIE 1931 colour matching functions (Wyman, Sloan, Shirley 2013), wavelength in nm.
Rgb colour_matching(double wavelength) {
  const auto lobe = [wavelength](double mean, double left, double right) {
    const double t = (wavelength - mean) / (wavelength < mean ? left : right);
    return std::exp(-0.5 * t * t);
  };
  return {1.056 * lobe(599.8, 37.9, 31.0) + 0.362 * lobe(442.0, 16.0, 26.7) - 0.065 * lobe(501.1, 20.4, 26.2),
          0.821 * lobe(568.8, 46.9, 40.5) + 0.286 * lobe(530.9, 16.3, 31.1),
          1.217 * lobe(437.0, 11.8, 36.0) + 0.681 * lobe(459.0, 26.0, 13.8)};
}

constexpr double first_wavelength = 380, wavelength_step = 10;  // nm
constexpr int wavelengths = 38;

// Solar irradiance outside the atmosphere, W/(m^2 um) (Thekaekara 1973).
constexpr std::array<double, wavelengths> solar_spectrum{
    1120, 1098, 1429, 1751, 1747, 1639, 1810, 2006, 2066, 2033, 2074, 1950, 1942,
    1882, 1833, 1842, 1783, 1725, 1695, 1712, 1715, 1700, 1666, 1635, 1602, 1570,
    1544, 1511, 1486, 1456, 1427, 1402, 1369, 1344, 1314, 1290, 1260, 1235};

// Absorption of ozone, 1/cm (Leckner 1978, as in Iqbal 1983).
constexpr std::array<double, wavelengths> ozone{
    0,     0,     0,     0,     0,     0,     0.003, 0.003, 0.006, 0.009, 0.014, 0.021, 0.030,
    0.040, 0.048, 0.063, 0.075, 0.085, 0.103, 0.120, 0.120, 0.115, 0.125, 0.120, 0.105, 0.090,
    0.079, 0.067, 0.057, 0.048, 0.036, 0.028, 0.023, 0.018, 0.014, 0.011, 0.010, 0.009};

// Absorption of water vapour, 1/cm (same sources); nothing below 690 nm. Mixed gases absorb only beyond 750 nm.
double water_vapour(int index) {
  constexpr std::array<double, 7> from_690{0.016, 0.024, 0.0125, 1.0, 0.87, 0.061, 0.001};
  return index < 31 ? 0 : from_690[index - 31];
}

// Relative optical mass (Kasten 1965).
double air_mass(double zenith_degrees) {
  const double z = std::min(zenith_degrees, 90.0);
  return 1 / (std::cos(radians(z)) + 0.15 * std::pow(93.885 - z, -1.253));
}

// What is left of the direct light at one wavelength, by cause.
struct Transmittance {
  double rayleigh, aerosol, absorption;
};

Transmittance transmittance(int index, double mass, double turbidity) {
  const double um = (first_wavelength + index * wavelength_step) / 1000;
  const double rayleigh_depth = 0.008735 * std::pow(um, -4.08);
  const double aerosol_depth = (0.04608 * turbidity - 0.04586) * std::pow(um, -1.3);
  const double ozone_depth = ozone[index] * 0.35;            // cm of ozone
  const double water_path = water_vapour(index) * 2 * mass;  // 2 cm of precipitable water
  const double water_loss = 0.2385 * water_path / std::pow(1 + 20.07 * water_path, 0.45);
  return {std::exp(-rayleigh_depth * mass), std::exp(-aerosol_depth * mass),
          std::exp(-ozone_depth * mass - water_loss)};
}

// XYZ, in W/m^2 of 179 lm, of the solar spectrum times share(transmittance) at each wavelength.
template <class Share>
Rgb filtered_sunlight(const DaylightOptions& options, Share&& share) {
  const double mass = air_mass(90 - options.elevation);
  Rgb xyz{};
  for (int i = 0; i < wavelengths; ++i) {
    const double spectral = solar_spectrum[i] / 1000;  // W/(m^2 nm)
    const double weight = wavelength_step * spectral * share(transmittance(i, mass, options.turbidity));
    xyz = xyz + weight * colour_matching(first_wavelength + i * wavelength_step);
  }
  return 683 / luminous_efficacy * xyz;
}

// How the light of a clear sky falls after sunset, as a factor on the sky at sunset: illuminances of 400, 3.4, 0.008 and
// 0.0006 lx at 0, -6, -12 and -18 degrees (Seidelmann 1992), linear in the logarithm between; night stays at the last.
double twilight_factor(double elevation) {
  constexpr std::array<double, 4> log10_lux{2.602, 0.531, -2.097, -3.222};
  if (elevation >= 0) return 1;
  const double x = std::min(-elevation / 6, 3.0);
  const int i = std::min(static_cast<int>(x), 2);
  const double here = log10_lux[i] + (x - i) * (log10_lux[i + 1] - log10_lux[i]);
  return std::pow(10, here - log10_lux[0]);
}

Vec3 direction_of(double elevation_degrees, double azimuth_degrees) {
  const double e = radians(elevation_degrees), a = radians(azimuth_degrees);
  return {std::cos(e) * std::cos(a), std::sin(e), std::cos(e) * std::sin(a)};
}

// Zenith chromaticities: (T^2, T, 1) M (t^3, t^2, t, 1), t the sun's zenith angle (Preetham et al. 1999, A.2).
double zenith_chromaticity(const std::array<std::array<double, 4>, 3>& m, double turbidity, double t) {
  const auto row = [t](const std::array<double, 4>& c) { return ((c[0] * t + c[1]) * t + c[2]) * t + c[3]; };
  return (row(m[0]) * turbidity + row(m[1])) * turbidity + row(m[2]);
}

constexpr std::array<std::array<double, 4>, 3> zenith_x{{{0.00166, -0.00375, 0.00209, 0},
                                                         {-0.02903, 0.06377, -0.03202, 0.00394},
                                                         {0.11693, -0.21196, 0.06052, 0.25886}}};
constexpr std::array<std::array<double, 4>, 3> zenith_y{{{0.00275, -0.00610, 0.00317, 0},
                                                         {-0.04214, 0.08970, -0.04153, 0.00516},
                                                         {0.15346, -0.26756, 0.06670, 0.26688}}};

}  // namespace

Vec3 sun_direction(const DaylightOptions& options) {
  return direction_of(options.elevation, options.azimuth);
}

double sun_solid_angle() {
  const double s = std::sin(radians(sun_diameter_degrees) / 4);
  return 4 * pi * s * s;  // 2 pi (1 - cos(radius))
}

Rgb sun_irradiance(const DaylightOptions& options) {
  return rec709_from_xyz(filtered_sunlight(
      options, [](const Transmittance& t) { return t.rayleigh * t.aerosol * t.absorption; }));
}

// Bird & Riordan 1986, eq. 3-5 to 3-13. Of the sunlight that reaches the ground as if nothing scattered, molecules send
// down 0.5 (1 - R^0.95) and the aerosol F R^1.5 (1 - A^w), with R and A their transmittances, w the aerosol's
// single-scattering albedo and F its forward part; A^(1 - w) is absorbed. 1 / mass stands for the sine of the elevation
// in the projection onto the ground, so that the sky fades to some 300 lx at sunset instead of to nothing; twilight goes
// on from there.
double sky_illuminance(const DaylightOptions& options) {
  const double mass = air_mass(90 - options.elevation);
  const double sine = std::max(0.0, std::sin(radians(options.elevation)));
  const double log_asymmetry = std::log(1 - 0.65);
  const double linear = log_asymmetry * (1.459 + log_asymmetry * (0.1595 + log_asymmetry * 0.4129));
  const double quadratic = log_asymmetry * (0.0783 + log_asymmetry * (-0.3824 - log_asymmetry * 0.5874));
  const double forward = 1 - 0.5 * std::exp((linear + quadratic * sine) * sine);
  const Rgb xyz = filtered_sunlight(options, [=](const Transmittance& t) {
    constexpr double albedo =
        0.936;  // 0.945 exp(-0.095 ln^2(um / 0.4)) at 0.55 um, 0.93 to 0.945 over the visible
    const double absorption = t.absorption * std::pow(t.aerosol, 1 - albedo);
    const double molecules = 0.5 * (1 - std::pow(t.rayleigh, 0.95));
    const double aerosol = forward * std::pow(t.rayleigh, 1.5) * (1 - std::pow(t.aerosol, albedo));
    return absorption * (molecules + aerosol);
  });
  return xyz[1] / mass * twilight_factor(options.elevation);
}

Rgb sun_radiance(const DaylightOptions& options) { return (1 / sun_solid_angle()) * sun_irradiance(options); }

// The sky's distribution is Perez's F(theta, gamma) = (1 + A e^(B / cos theta)) (1 + C e^(D gamma) + E cos^2 gamma) for
// each of Y, x, y, with theta the direction's zenith angle and gamma its angle to the sun; scaled to the zenith value:
// value = zenith F(theta, gamma) / F(0, theta_sun). Below T = 2, 1 + A e^B passes zero and the fit explodes towards
// the horizon (Zotti et al. 2007), so the sky (not the sun) uses at least 2. After sunset the sun of the distribution
// stays on the horizon and the luminance follows the measured twilight. The distribution and its colours are Preetham's;
// how bright the whole is comes from the balance with the sun, unless the published zenith is asked for.
PreethamSky::PreethamSky(const DaylightOptions& options) {
  const double T = std::max(options.turbidity, 2.0);
  const double sun_elevation = std::max(options.elevation, 0.0);
  const double sun_zenith = radians(90 - sun_elevation);
  sun_ = direction_of(sun_elevation, options.azimuth);
  perez_ = {{{0.1787 * T - 1.4630, -0.3554 * T + 0.4275, -0.0227 * T + 5.3251, 0.1206 * T - 2.5771,
              -0.0670 * T + 0.3703},
             {-0.0193 * T - 0.2592, -0.0665 * T + 0.0008, -0.0004 * T + 0.2125, -0.0641 * T - 0.8989,
              -0.0033 * T + 0.0452},
             {-0.0167 * T - 0.2608, -0.0950 * T + 0.0092, -0.0079 * T + 0.2102, -0.0441 * T - 1.6537,
              -0.0109 * T + 0.0529}}};
  const double chi = (4.0 / 9 - T / 120) * (pi - 2 * sun_zenith);
  const double zenith_candela =
      1000 * ((4.0453 * T - 4.9710) * std::tan(chi) - 0.2155 * T + 2.4192);  // cd/m^2
  const Rgb zenith{zenith_candela * twilight_factor(options.elevation) / luminous_efficacy,
                   zenith_chromaticity(zenith_x, T, sun_zenith),
                   zenith_chromaticity(zenith_y, T, sun_zenith)};
  for (int i = 0; i < 3; ++i) {
    const Perez& p = perez_[i];
    const double cos_sun = std::cos(sun_zenith);
    const double at_zenith =
        (1 + p.a * std::exp(p.b)) * (1 + p.c * std::exp(p.d * sun_zenith) + p.e * cos_sun * cos_sun);
    zenith_[i] = zenith[i] / at_zenith;
  }
  if (!options.published_zenith) zenith_[0] *= sky_illuminance(options) / luminance(horizontal_irradiance());
}

Rgb PreethamSky::gradation(double cos_zenith) const {
  Rgb result;
  for (int i = 0; i < 3; ++i)
    result[i] = cos_zenith > 0 ? 1 + perez_[i].a * std::exp(perez_[i].b / cos_zenith) : 1;  // B < 0
  return result;
}

Rgb PreethamSky::radiance(Vec3 direction, Rgb gradation_of_y) const {
  const double cos_gamma = std::clamp(dot(direction, sun_), -1.0, 1.0);
  const double gamma = std::acos(cos_gamma);
  Rgb value;
  for (int i = 0; i < 3; ++i) {
    const Perez& p = perez_[i];
    value[i] =
        zenith_[i] * gradation_of_y[i] * (1 + p.c * std::exp(p.d * gamma) + p.e * cos_gamma * cos_gamma);
  }
  return rec709_from_xyz(xyz_from_chromaticity(value[1], value[2], std::max(value[0], 0.0)));
}

Rgb PreethamSky::radiance(Vec3 direction) const { return radiance(direction, gradation(direction.y)); }

// Gauss-Legendre in cos_zenith^(1/2) (the gradation is steep at the horizon), the midpoint rule in azimuth.
Rgb PreethamSky::horizontal_irradiance() const {
  static const QuadratureRule rule = gauss_legendre(64);
  constexpr int azimuths = 256;
  Rgb sum{};
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double x = (1 + rule.nodes[i]) / 2;
    const double cos_zenith = x * x, sin_zenith = std::sqrt(1 - cos_zenith * cos_zenith);
    const Rgb by_height = gradation(cos_zenith);
    Rgb ring{};
    for (int j = 0; j < azimuths; ++j) {
      const double phi = 2 * pi * (j + 0.5) / azimuths;
      ring = ring + radiance({sin_zenith * std::cos(phi), cos_zenith, sin_zenith * std::sin(phi)}, by_height);
    }
    sum = sum + (rule.weights[i] / 2 * 2 * x * cos_zenith * 2 * pi / azimuths) * ring;
  }
  return sum;
}

}  // namespace welkin

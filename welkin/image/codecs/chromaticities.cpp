#include <welkin/image/codecs/chromaticities.h>

#include <cmath>

namespace welkin {
namespace {

ColourMatrix product(const ColourMatrix& a, const ColourMatrix& b) {
  ColourMatrix result{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 3; ++k) result[3 * i + j] += a[3 * i + k] * b[3 * k + j];
    }
  }
  return result;
}

// By cofactors; all zero when there is no inverse.
ColourMatrix inverse(const ColourMatrix& m) {
  ColourMatrix result{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const int r0 = (j + 1) % 3, r1 = (j + 2) % 3, c0 = (i + 1) % 3, c1 = (i + 2) % 3;
      result[3 * i + j] = m[3 * r0 + c0] * m[3 * r1 + c1] - m[3 * r0 + c1] * m[3 * r1 + c0];
    }
  }
  const double determinant = m[0] * result[0] + m[1] * result[3] + m[2] * result[6];
  if (!(std::abs(determinant) > 1e-12) || !std::isfinite(determinant)) return {};
  for (double& value : result) value /= determinant;
  return result;
}

std::array<double, 3> xyz_of(const std::array<double, 2>& xy) {
  return {xy[0] / xy[1], 1, (1 - xy[0] - xy[1]) / xy[1]};
}

}  // namespace

// The columns are the XYZ of the primaries, each scaled such that (1, 1, 1) gives the white.
ColourMatrix rgb_to_xyz(const Chromaticities& from) {
  const std::array<std::array<double, 3>, 3> primaries{xyz_of(from.red), xyz_of(from.green),
                                                       xyz_of(from.blue)};
  const std::array<double, 3> white = xyz_of(from.white);
  ColourMatrix m{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) m[3 * i + j] = primaries[j][i];
  }
  const ColourMatrix solve = inverse(m);
  for (int j = 0; j < 3; ++j) {
    const double scale = solve[3 * j] * white[0] + solve[3 * j + 1] * white[1] + solve[3 * j + 2] * white[2];
    if (!std::isfinite(scale)) return {};
    for (int i = 0; i < 3; ++i) m[3 * i + j] *= scale;
  }
  return m;
}

ColourMatrix xyz_to_rec709() { return inverse(rgb_to_xyz({})); }

ColourMatrix rgb_to_rec709(const Chromaticities& from) {
  const Chromaticities rec709;
  const std::array<double, 3> source = xyz_of(from.white), target = xyz_of(rec709.white);
  ColourMatrix adapt{};
  for (int i = 0; i < 3; ++i) adapt[4 * i] = source[i] != 0 ? target[i] / source[i] : 1;
  const ColourMatrix result = product(xyz_to_rec709(), product(adapt, rgb_to_xyz(from)));
  for (double value : result) {
    if (!std::isfinite(value)) return {};
  }
  return result;
}

void transform_colour(const ColourMatrix& m, float* triple) {
  const double a = triple[0], b = triple[1], c = triple[2];
  for (int i = 0; i < 3; ++i) {
    triple[i] = static_cast<float>(m[3 * i] * a + m[3 * i + 1] * b + m[3 * i + 2] * c);
  }
}

}  // namespace welkin

#include <welkin/sh/irradiance_matrix.h>

#include <cassert>
#include <cstddef>

#include <welkin/error.h>
#include <welkin/parallel/target_clones.h>
#include <welkin/sh/convolution.h>
#include <welkin/sh/degree2_constants.h>
#include <welkin/sh/quadric.h>

namespace welkin {
namespace {

using namespace degree2;

// One channel as a polynomial in floats: the ten different entries, those off the diagonal doubled.
struct Polynomial {
  float xx, xy, xz, x, yy, yz, y, zz, z, one;
};

std::array<Polynomial, 3> polynomials(const IrradianceMatrices& matrices) {
  const auto f = [](double v) { return static_cast<float>(v); };
  std::array<Polynomial, 3> out;
  for (int c = 0; c < 3; ++c) {
    const QuadraticForm& m = matrices[c];
    out[c] = {f(m[0][0]),     f(2 * m[0][1]), f(2 * m[0][2]), f(2 * m[0][3]), f(m[1][1]),
              f(2 * m[1][2]), f(2 * m[1][3]), f(m[2][2]),     f(2 * m[2][3]), f(m[3][3])};
  }
  return out;
}

inline float value(const Polynomial& p, float x, float y, float z) {
  return x * (p.xx * x + p.xy * y + p.xz * z + p.x) + y * (p.yy * y + p.yz * z + p.y) + z * (p.zz * z + p.z) +
         p.one;
}

constexpr int lanes = 16;

// Blocks of `lanes` normals, so that the compiler turns each inner loop into a few vector instructions.
WELKIN_TARGET_CLONES void evaluate_blocks(const Polynomial* channels, const std::array<float, 3>* normals,
                                          std::size_t blocks, std::array<float, 3>* rgb) {
  for (std::size_t block = 0; block < blocks; ++block, normals += lanes, rgb += lanes) {
    float x[lanes], y[lanes], z[lanes], out[3][lanes];
    for (int i = 0; i < lanes; ++i) {
      x[i] = normals[i][0];
      y[i] = normals[i][1];
      z[i] = normals[i][2];
    }
    for (int c = 0; c < 3; ++c) {
      const Polynomial p = channels[c];
      for (int i = 0; i < lanes; ++i) out[c][i] = value(p, x[i], y[i], z[i]);
    }
    for (int i = 0; i < lanes; ++i)
      for (int c = 0; c < 3; ++c) rgb[i][c] = out[c][i];
  }
}

}  // namespace

// Equation 12 in irradiance coefficients: c1 L_22 = y22 E_22, c2 L_1m = y1 E_1m / 2, c3 L_20 = 3 y20 E_20, c4 L_00 = y00 E_00, c5
// L_20 = y20 E_20, since E_lm = A_l L_lm.
IrradianceMatrices irradiance_matrices(const ShCoefficients& irradiance) {
  if (irradiance.max_degree != 2 || irradiance.channels != 3)
    throw Error("irradiance matrices are made of nine RGB coefficients");
  IrradianceMatrices matrices;
  for (int c = 0; c < 3; ++c) {
    const auto e = [&](int l, int m) { return irradiance.values[sh_index(l, m) * 3 + c]; };
    const double xy = y22 * e(2, -2), yz = y22 * e(2, -1), xz = y22 * e(2, 1), xx = y22 * e(2, 2);
    const double x = 0.5 * y1 * e(1, 1), y = 0.5 * y1 * e(1, -1), z = 0.5 * y1 * e(1, 0);
    matrices[c] = {std::array<double, 4>{xx, xy, xz, x},
                   {xy, -xx, yz, y},
                   {xz, yz, 3 * y20 * e(2, 0), z},
                   {x, y, z, y00 * e(0, 0) - y20 * e(2, 0)}};
  }
  return matrices;
}

IrradianceMatrices irradiance_matrices_from_radiance(const ShCoefficients& radiance) {
  return irradiance_matrices(convolve(radiance, cosine_lobe(2)));
}

ShCoefficients irradiance_from_matrices(const IrradianceMatrices& matrices) {
  ShCoefficients irradiance(2, 3);
  for (int c = 0; c < 3; ++c) {
    const QuadraticForm& m = matrices[c];
    const double third = (m[0][0] + m[1][1] + m[2][2]) / 3;
    std::array<double, 9> f;
    sh_from_quadric({m[0][0] - third,
                     m[1][1] - third,
                     m[2][2] - third,
                     m[0][1],
                     m[1][2],
                     m[0][2],
                     {m[0][3], m[1][3], m[2][3]},
                     m[3][3] + third},
                    f);
    for (int i = 0; i < 9; ++i) irradiance.values[i * 3 + c] = f[i];
  }
  return irradiance;
}

double evaluate(const QuadraticForm& matrix, Vec3 normal) {
  const double n[4] = {normal.x, normal.y, normal.z, 1};
  double sum = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) sum += n[i] * matrix[i][j] * n[j];
  return sum;
}

void irradiance_of_normals(const IrradianceMatrices& matrices, std::span<const std::array<float, 3>> normals,
                           std::span<std::array<float, 3>> rgb) {
  assert(rgb.size() == normals.size());
  const std::size_t blocks = normals.size() / lanes, done = blocks * lanes;
  evaluate_blocks(polynomials(matrices).data(), normals.data(), blocks, rgb.data());
  irradiance_of_normals_scalar(matrices, normals.subspan(done), rgb.subspan(done));
}

void irradiance_of_normals_scalar(const IrradianceMatrices& matrices,
                                  std::span<const std::array<float, 3>> normals,
                                  std::span<std::array<float, 3>> rgb) {
  assert(rgb.size() == normals.size());
  const auto channels = polynomials(matrices);
  for (std::size_t i = 0; i < normals.size(); ++i)
    for (int c = 0; c < 3; ++c) rgb[i][c] = value(channels[c], normals[i][0], normals[i][1], normals[i][2]);
}

}  // namespace welkin

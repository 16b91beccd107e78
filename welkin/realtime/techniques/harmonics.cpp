#include <welkin/realtime/techniques/forward_technique.h>
#include <welkin/realtime/techniques/technique_list.h>
#include <welkin/sh/irradiance_matrix.h>

// Diffuse surfaces lit by nine coefficients of the environment (Ramamoorthi & Hanrahan 2001).

namespace welkin {
namespace {

class ShPixel : public ForwardTechnique {
 public:
  ShPixel() : ForwardTechnique("sh_pixel.frag") {}
};

Matrix4 to_gl(const QuadraticForm& form) {
  Matrix4 matrix;
  for (std::size_t i = 0; i < 16; ++i) matrix.m[i] = static_cast<float>(form[i / 4][i % 4]);  // symmetric
  return matrix;
}

class ShMatrix : public ForwardTechnique {
 public:
  ShMatrix() : ForwardTechnique("sh_matrix.frag", "sh_matrix.vert") {}

 private:
  void bind(const Program& program, const Frame& frame, const ParameterValues&) override {
    static constexpr const char* names[3] = {"irradiance_matrix[0]", "irradiance_matrix[1]",
                                             "irradiance_matrix[2]"};
    ShCoefficients radiance(2, 3);
    for (std::size_t i = 0; i < 9; ++i) {
      const Vec3f& c = frame.environment.radiance_sh[i];
      radiance.values[3 * i] = c.x;
      radiance.values[3 * i + 1] = c.y;
      radiance.values[3 * i + 2] = c.z;
    }
    const IrradianceMatrices matrices = irradiance_matrices_from_radiance(radiance);
    for (std::size_t c = 0; c < 3; ++c) program.set(names[c], to_gl(matrices[c]));
  }
};

void make_diffuse(Scene& scene) {
  for (Material& material : scene.materials) material.model = MaterialModel::lambert;
}

void make_diffuse_and_smooth(Scene& scene) {
  make_diffuse(scene);
  for (Material& material : scene.materials) material.normal_texture.texture = -1;
}

template <class T>
std::unique_ptr<Technique> make() {
  return std::make_unique<T>();
}

constexpr TechniqueInfo table[] = {
    {"sh-pixel",
     "every surface diffuse: nine spherical-harmonic coefficients, summed in each pixel",
     "Ramamoorthi & Hanrahan 2001",
     Truth::unshadowed,
     {},
     make<ShPixel>,
     make_diffuse},
    {"sh-matrix",
     "every surface diffuse: the same nine as a 4 x 4 matrix a colour, at the vertices, without normal maps",
     "Ramamoorthi & Hanrahan 2001",
     Truth::unshadowed,
     {},
     make<ShMatrix>,
     make_diffuse_and_smooth},
};

}  // namespace

std::span<const TechniqueInfo> harmonic_techniques() { return table; }

}  // namespace welkin

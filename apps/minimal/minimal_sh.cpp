// Diffuse light from nine numbers a channel: project an environment on spherical harmonics, evaluate it for a normal.
// Usage: minimal_sh [INPUT]
#include <welkin/envmap/environment.h>
#include <welkin/error.h>
#include <welkin/sh/convolution.h>
#include <welkin/sh/projection.h>

#include <cstdio>

int main(int argc, char** argv) try {
  const welkin::Environment environment =
      welkin::load_environment(argc > 1 ? argv[1] : "sky:overcast,size=256x128");

  // Coefficients of the radiance: degrees 0, 1 and 2, nothing multiplied in.
  const welkin::ShCoefficients radiance = welkin::project_equirect(environment.radiance, 2);
  for (int l = 0; l <= 2; ++l)
    for (int m = -l; m <= l; ++m) {
      const double* rgb = &radiance.values[welkin::sh_index(l, m) * 3];
      std::printf("L(%d,%2d) = % .5f % .5f % .5f\n", l, m, rgb[0], rgb[1], rgb[2]);
    }

  // Degree l times pi, 2 pi/3, pi/4: the coefficients of the irradiance.
  const welkin::ShCoefficients irradiance = welkin::convolve(radiance, welkin::cosine_lobe(2));
  for (const welkin::Vec3 normal : {welkin::Vec3{0, 1, 0}, welkin::Vec3{1, 0, 0}, welkin::Vec3{0, -1, 0}}) {
    double e[3];
    welkin::evaluate(irradiance, normal, e);
    std::printf("irradiance on a surface that faces (%g, %g, %g): %.4f %.4f %.4f\n", normal.x, normal.y,
                normal.z, e[0], e[1], e[2]);
  }
} catch (const welkin::Error& error) {
  std::fprintf(stderr, "minimal_sh: %s\n", error.what());
  return 1;
}

// A sphere of any BRDF under an environment, by lobes filtered once and looked up once a pixel.
// Usage: minimal_reflect [INPUT [BRDF [OUTPUT.png]]]     BRDF is ggx:ALPHA[,F0], ward:ALPHA, merl:FILE, ...
#include <welkin/brdf/brdf_spec.h>
#include <welkin/envmap/environment.h>
#include <welkin/envmap/reflection/lobe_stack.h>
#include <welkin/error.h>
#include <welkin/image/load.h>

#include <cstdio>
#include <vector>

int main(int argc, char** argv) try {
  const char* input = argc > 1 ? argv[1] : "sky:studio,size=256x128";
  const char* spec = argc > 2 ? argv[2] : "ggx:0.35,0.9";
  const char* output = argc > 3 ? argv[3] : "sphere.png";

  const welkin::Environment environment = welkin::load_environment(input);
  const welkin::IsotropicBrdf brdf = welkin::parse_brdf(spec);

  // All the work of filtering is here; the stack then answers any normal and any view.
  const welkin::LobeStack stack = welkin::prepare_lobe_stack(environment.radiance, brdf);

  constexpr int size = 128;
  welkin::Image picture(size, size);
  const std::vector<welkin::ReflectionQuery> queries = welkin::sphere_picture_queries(size);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    if (welkin::length(queries[i].normal) == 0) continue;  // beside the sphere
    const auto rgb = welkin::reflect(stack, queries[i]);
    for (int c = 0; c < 3; ++c) picture.pixels[3 * i + c] = static_cast<float>(rgb[c]);
  }
  welkin::save_image(output, picture);
  std::printf("%s: %s, %zu cubes\n", output, brdf.name.c_str(), stack.cubes.size());
} catch (const welkin::Error& error) {
  std::fprintf(stderr, "minimal_reflect: %s\n", error.what());
  return 1;
}

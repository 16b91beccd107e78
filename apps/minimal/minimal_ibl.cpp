// An environment in, one texture out: the specular mip chain that an engine samples by roughness.
// Usage: minimal_ibl [INPUT [OUTPUT.ktx2]]     INPUT is an HDR file or a built-in sky such as sky:day,elevation=20
#include <welkin/envmap/environment.h>
#include <welkin/envmap/ibl.h>
#include <welkin/error.h>
#include <welkin/image/codecs/ktx2.h>
#include <welkin/image/output_file.h>

#include <cstdio>

int main(int argc, char** argv) try {
  const char* input = argc > 1 ? argv[1] : "sky:day,size=512x256";
  const char* output = argc > 2 ? argv[2] : "specular.ktx2";

  // Whatever the file is, this is equirectangular radiance: 3 channels, linear Rec. 709, finite and >= 0.
  const welkin::Environment environment = welkin::load_environment(input);

  welkin::IblOptions options;
  options.size = 128;
  const welkin::IblSet set = welkin::make_ibl(environment.radiance, options);
  for (std::size_t k = 0; k < set.levels.size(); ++k)
    std::printf("level %zu: %3d x %-3d texels, perceptual roughness %.3f\n", k, set.specular.levels[k].size,
                set.specular.levels[k].size, set.levels[k].perceptual_roughness);

  // Half floats end at 65504. A sun does not, so the file may be divided by a power of two; it says which.
  const welkin::EncodedTexture texture = welkin::encode_ktx2(set.specular);
  welkin::write_file(output, texture.bytes);
  std::printf("%s: %zu bytes; true value = stored value * %g\n", output, texture.bytes.size(),
              texture.stored_scale);
} catch (const welkin::Error& error) {
  std::fprintf(stderr, "minimal_ibl: %s\n", error.what());
  return 1;
}

#include <welkin/pathtrace/picture.h>

#include <array>

#include <welkin/pathtrace/picture_loop.h>
#include <welkin/sampling/sobol.h>

namespace welkin {

namespace {

/// All replicates of a pixel, 16 samples at a time.
struct PixelRenderer {
  const RenderScene& scene;
  const Camera& camera;
  const PictureOptions& options;
  std::array<std::uint32_t, picture_replicates> seeds;

  void batch(int x, int y, std::uint32_t begin, std::span<PixelSample> out) const {
    std::array<SampleNumber, picture_loop::batch_size> numbers;
    for (std::uint32_t i = 0; i < out.size(); ++i) {
      const std::uint32_t at = begin + i;
      numbers[i] = {at / picture_replicates, seeds[at % picture_replicates]};
    }
    render_samples(scene, camera, options.size, x, y, std::span(numbers.data(), out.size()),
                   options.integrator, out);
  }
};

}  // namespace

bool render_picture(PictureState& state, const RenderScene& scene, const Camera& camera,
                    const PictureOptions& options, const PictureObserver& observer) {
  PixelRenderer renderer{scene, camera, options, {}};
  for (std::uint32_t r = 0; r < picture_replicates; ++r) {
    renderer.seeds[r] = mix_bits32(options.integrator.seed + 0x9e3779b9u * (r + 1));
  }
  return sample_picture(state, options, renderer, observer);
}

}  // namespace welkin

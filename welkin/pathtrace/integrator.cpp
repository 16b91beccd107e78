#include <welkin/pathtrace/integrator.h>

#include <welkin/pathtrace/render_sample.h>

namespace welkin {

void render_samples(const RenderScene& scene, const Camera& camera, PictureSize size, int x, int y,
                    std::span<const SampleNumber> numbers, const IntegratorOptions& options,
                    std::span<PixelSample> out) {
  render_samples_with(scene.tables().rays, scene, camera, size, x, y, numbers, options, out);
}

PixelSample render_sample(const RenderScene& scene, const Camera& camera, PictureSize size, int x, int y,
                          std::uint32_t index, const IntegratorOptions& options) {
  PixelSample sample;
  const SampleNumber number{index, options.seed};
  render_samples(scene, camera, size, x, y, {&number, 1}, options, {&sample, 1});
  return sample;
}

}  // namespace welkin

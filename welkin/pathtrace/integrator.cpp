#include <welkin/pathtrace/integrator.h>

#include <welkin/pathtrace/render_sample.h>

namespace welkin {

void render_samples(const RenderScene& scene, const Camera& camera, PictureSize size, int x, int y,
                    std::uint32_t first, std::span<PixelSample> samples, const IntegratorOptions& options) {
  render_samples_with(scene.tables().rays, scene, camera, size, x, y, first, samples, options);
}

PixelSample render_sample(const RenderScene& scene, const Camera& camera, PictureSize size, int x, int y,
                          std::uint32_t index, const IntegratorOptions& options) {
  PixelSample sample;
  render_samples(scene, camera, size, x, y, index, {&sample, 1}, options);
  return sample;
}

}  // namespace welkin

#include <welkin/pathtrace/integrator.h>

#include <welkin/pathtrace/render_sample.h>

namespace welkin {

PixelSample render_sample(const RenderScene& scene, const Camera& camera, PictureSize size, int x, int y,
                          std::uint32_t index, const IntegratorOptions& options) {
  return render_sample_with(scene.tables().rays, scene, camera, size, x, y, index, options);
}

}  // namespace welkin

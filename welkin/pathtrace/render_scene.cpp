#include <welkin/pathtrace/render_scene.h>

#include <welkin/error.h>

namespace welkin {

RenderScene::RenderScene(const Scene& scene, const EnvironmentSampler* environment) {
  if (scene.instances.empty() && scene.spheres.empty() && environment == nullptr) {
    throw Error(scene.source, "nothing that could be seen: no geometry and no environment");
  }
  tables_ = std::make_unique<Tables>(scene, environment);
}

RenderScene::~RenderScene() = default;
RenderScene::RenderScene(RenderScene&&) noexcept = default;
RenderScene& RenderScene::operator=(RenderScene&&) noexcept = default;

}  // namespace welkin

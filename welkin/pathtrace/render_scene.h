#pragma once
#include <welkin/pathtrace/integrator.h>
#include <welkin/pathtrace/light_table.h>
#include <welkin/pathtrace/shading.h>

namespace welkin {

/// What RenderScene holds; for the integrators and what stands beside them.
struct RenderScene::Tables {
  Tables(const Scene& of, const EnvironmentSampler* sky)
      : scene(of), environment(sky), rays(of), materials(of), lights(rays, sky) {}

  const Scene& scene;
  const EnvironmentSampler* environment;  ///< null: black
  RayScene rays;
  ShadingMaterials materials;
  LightTable lights;
};

}  // namespace welkin

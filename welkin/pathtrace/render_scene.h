#pragma once
#include <memory>
#include <mutex>

#include <welkin/pathtrace/integrator.h>
#include <welkin/pathtrace/light_table.h>
#include <welkin/pathtrace/product_sampling.h>
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

  /// For LightSampling::product: the environment's light by its product with the BRDF, all other lights by their power.
  struct Product {
    ProductSampler environment;
    LightTable others;
  };
  /// Made on first use. Needs an environment.
  const Product& product() const {
    std::call_once(product_once_, [this] {
      product_ = std::make_unique<Product>(Product{ProductSampler(*environment), LightTable(rays, nullptr)});
    });
    return *product_;
  }

 private:
  mutable std::once_flag product_once_;
  mutable std::unique_ptr<Product> product_;
};

}  // namespace welkin

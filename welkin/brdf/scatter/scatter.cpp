#include <welkin/brdf/scatter/scatter.h>

#include <cmath>

#include <welkin/brdf/scatter/layers.h>
#include <welkin/brdf/scatter/warps.h>

namespace welkin {
namespace {

using namespace scatter_detail;

ScatterValue lambert_value(const Scatter& s, Vec3f light) {
  const float share = light.z / pi;
  return {share * s.color, share};
}

// What a smooth surface reflects; black for the rough models.
Rgb mirror_reflectance(const Scatter& s, Vec3f view) {
  switch (s.model) {
    case ScatterModel::mirror: return s.color;
    case ScatterModel::conductor: return fresnel_conductor(view.z, s.eta, s.k);
    case ScatterModel::dielectric: {
      const float f = fresnel_dielectric(view.z, s.eta.r);
      return {f, f, f};
    }
    default: return {};
  }
}

bool has_layers(ScatterModel model) {
  return model == ScatterModel::ggx || model == ScatterModel::ggx_conductor ||
         model == ScatterModel::coated_diffuse || model == ScatterModel::metallic_roughness;
}

}  // namespace

bool is_delta(const Scatter& s) {
  return s.model == ScatterModel::mirror || s.model == ScatterModel::conductor ||
         s.model == ScatterModel::dielectric;
}

ScatterValue evaluate_with_pdf(const Scatter& s, Vec3f light, Vec3f view) {
  if (!(light.z > 0) || !(view.z > 0) || is_delta(s)) return {};
  if (has_layers(s.model)) return layers_value(make_layers(s, view), light);
  return lambert_value(s, light);
}

Rgb evaluate(const Scatter& s, Vec3f light, Vec3f view) { return evaluate_with_pdf(s, light, view).value; }

float pdf(const Scatter& s, Vec3f light, Vec3f view) { return evaluate_with_pdf(s, light, view).pdf; }

ScatterSample sample(const Scatter& s, Vec3f view, Vec2f u, float lobe) {
  if (!(view.z > 0)) return {};
  if (is_delta(s)) return {{-view.x, -view.y, view.z}, mirror_reflectance(s, view), INFINITY};
  if (has_layers(s.model)) return sample_layers(make_layers(s, view), u, lobe);
  const Vec3f light = sample_cosine(u);
  return {light, s.color, light.z / pi};
}

Rgb approximate_albedo(const Scatter& s, Vec3f view) {
  if (!(view.z > 0)) return {};
  if (is_delta(s)) return mirror_reflectance(s, view);
  if (has_layers(s.model)) return layers_albedo(s, view);
  return s.color;
}

std::string_view scatter_model_name(ScatterModel model) {
  switch (model) {
    case ScatterModel::lambert: return "lambert";
    case ScatterModel::oren_nayar: return "oren-nayar";
    case ScatterModel::phong: return "phong";
    case ScatterModel::blinn_phong: return "blinn-phong";
    case ScatterModel::lafortune: return "lafortune";
    case ScatterModel::ggx: return "ggx";
    case ScatterModel::ggx_conductor: return "ggx-conductor";
    case ScatterModel::mirror: return "mirror";
    case ScatterModel::conductor: return "conductor";
    case ScatterModel::dielectric: return "dielectric";
    case ScatterModel::coated_diffuse: return "coated-diffuse";
    case ScatterModel::metallic_roughness: return "metallic-roughness";
  }
  return "";
}

}  // namespace welkin

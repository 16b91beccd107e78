#include <welkin/brdf/scatter/scatter.h>

#include <cmath>

#include <welkin/brdf/scatter/layers.h>
#include <welkin/brdf/scatter/oren_nayar.h>
#include <welkin/brdf/scatter/power_lobe.h>
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

// The direction and what evaluate_with_pdf says of it.
ScatterSample weighed(Vec3f light, ScatterValue value) {
  if (!(light.z > 0) || !(value.pdf > 0)) return {};
  return {light, (1 / value.pdf) * value.value, value.pdf};
}

ScatterSample sample_oren_nayar(const Scatter& s, Vec3f view, Vec2f u, float choice) {
  const OrenNayar lobe = make_oren_nayar(s, view);
  const Vec3f light = choice < lobe.p_uniform ? sample_uniform(u) : sample_cosine(u);
  return weighed(light, oren_nayar_value(lobe, s.color, light));
}

ScatterSample sample_power(const Scatter& s, Vec3f view, Vec2f u, float choice) {
  const PowerLobe lobe = make_power_lobe(s, view);
  const Vec3f light = sample_power_lobe(lobe, u, choice);
  if (!(light.z > 0)) return {};
  return weighed(light, power_lobe_value(lobe, s.color, light));
}

}  // namespace

bool is_delta(const Scatter& s) {
  return s.model == ScatterModel::mirror || s.model == ScatterModel::conductor ||
         s.model == ScatterModel::dielectric;
}

ScatterValue evaluate_with_pdf(const Scatter& s, Vec3f light, Vec3f view) {
  if (!(light.z > 0) || !(view.z > 0)) return {};
  switch (s.model) {
    case ScatterModel::lambert: return lambert_value(s, light);
    case ScatterModel::oren_nayar: return oren_nayar_value(make_oren_nayar(s, view), s.color, light);
    case ScatterModel::phong:
    case ScatterModel::blinn_phong:
    case ScatterModel::lafortune: return power_lobe_value(make_power_lobe(s, view), s.color, light);
    case ScatterModel::ggx:
    case ScatterModel::ggx_conductor:
    case ScatterModel::coated_diffuse:
    case ScatterModel::metallic_roughness: return layers_value(make_layers(s, view), light);
    case ScatterModel::mirror:
    case ScatterModel::conductor:
    case ScatterModel::dielectric: break;
  }
  return {};
}

Rgb evaluate(const Scatter& s, Vec3f light, Vec3f view) { return evaluate_with_pdf(s, light, view).value; }

float pdf(const Scatter& s, Vec3f light, Vec3f view) { return evaluate_with_pdf(s, light, view).pdf; }

ScatterSample sample(const Scatter& s, Vec3f view, Vec2f u, float lobe) {
  if (!(view.z > 0)) return {};
  switch (s.model) {
    case ScatterModel::lambert: {
      const Vec3f light = sample_cosine(u);
      return {light, s.color, light.z / pi};
    }
    case ScatterModel::oren_nayar: return sample_oren_nayar(s, view, u, lobe);
    case ScatterModel::phong:
    case ScatterModel::blinn_phong:
    case ScatterModel::lafortune: return sample_power(s, view, u, lobe);
    case ScatterModel::ggx:
    case ScatterModel::ggx_conductor:
    case ScatterModel::coated_diffuse:
    case ScatterModel::metallic_roughness: return sample_layers(make_layers(s, view), u, lobe);
    case ScatterModel::mirror:
    case ScatterModel::conductor:
    case ScatterModel::dielectric: return {{-view.x, -view.y, view.z}, mirror_reflectance(s, view), INFINITY};
  }
  return {};
}

Rgb approximate_albedo(const Scatter& s, Vec3f view) {
  if (!(view.z > 0)) return {};
  switch (s.model) {
    case ScatterModel::lambert: return s.color;
    case ScatterModel::oren_nayar: return oren_nayar_albedo(make_oren_nayar(s, view), s.color);
    case ScatterModel::phong:
    case ScatterModel::blinn_phong:
    case ScatterModel::lafortune: return power_lobe_albedo(s, view);
    case ScatterModel::ggx:
    case ScatterModel::ggx_conductor:
    case ScatterModel::coated_diffuse:
    case ScatterModel::metallic_roughness: return layers_albedo(s, view);
    case ScatterModel::mirror:
    case ScatterModel::conductor:
    case ScatterModel::dielectric: return mirror_reflectance(s, view);
  }
  return {};
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

#include <welkin/envmap/level_law.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <welkin/error.h>

namespace welkin {

LevelLaw parse_level_law(std::string_view text) {
  for (LevelLaw law : {LevelLaw::linear, LevelLaw::quadratic, LevelLaw::logarithmic})
    if (text == name(law)) return law;
  throw Error("unknown level law '" + std::string(text) + "'; choose linear, quadratic or log2");
}

std::string_view name(LevelLaw law) {
  switch (law) {
    case LevelLaw::quadratic: return "quadratic";
    case LevelLaw::logarithmic: return "log2";
    default: return "linear";
  }
}

std::string_view formula(LevelLaw law) {
  switch (law) {
    case LevelLaw::quadratic: return "level = (levels - 1) * r * (2 - r)";
    case LevelLaw::logarithmic: return "level = log2(size * r * r)";
    default: return "level = r * (levels - 1)";
  }
}

double level_to_perceptual_roughness(LevelLaw law, double level, int levels, int size) {
  if (levels <= 1 || level <= 0) return 0;
  const double share = std::min(1.0, level / (levels - 1));
  switch (law) {
    case LevelLaw::quadratic: return 1 - std::sqrt(1 - share);
    case LevelLaw::logarithmic: return std::min(1.0, std::sqrt(std::exp2(level) / size));
    default: return share;
  }
}

double perceptual_roughness_to_level(LevelLaw law, double perceptual_roughness, int levels, int size) {
  const double r = std::clamp(perceptual_roughness, 0.0, 1.0), last = std::max(0, levels - 1);
  switch (law) {
    case LevelLaw::quadratic: return last * r * (2 - r);
    case LevelLaw::logarithmic: return r > 0 ? std::clamp(std::log2(size * r * r), 0.0, last) : 0;
    default: return last * r;
  }
}

ZonalKernel kernel_for_alpha(KernelKind kind, double alpha) {
  const double exponent = 1 + (1 / (alpha * alpha) - 1) / 2;
  switch (kind) {
    case KernelKind::ggx: return make_ggx_kernel(alpha);
    case KernelKind::phong: return make_phong_kernel(exponent);
    case KernelKind::gaussian: return make_gaussian_kernel(1 / std::sqrt(exponent));
    case KernelKind::blinn_phong: return make_blinn_phong_kernel(2 / (alpha * alpha) - 2);
    case KernelKind::von_mises_fisher: return make_von_mises_fisher_kernel(exponent);
    default: return make_lambert_kernel();
  }
}

}  // namespace welkin

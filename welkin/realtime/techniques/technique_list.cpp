#include <welkin/realtime/techniques/technique_list.h>

#include <vector>

namespace welkin {

std::span<const TechniqueInfo> techniques() {
  static const std::vector<TechniqueInfo> all = [] {
    std::vector<TechniqueInfo> list;
    for (const auto family : {
             basic_techniques(),
             harmonic_techniques(),
             dynamic_irradiance_techniques(),
             power_lobe_techniques(),
             stretched_techniques(),
             dynamic_glossy_techniques(),
             view_elevation_techniques(),
             occlusion_techniques(),
             importance_techniques(),
             bump_techniques(),
             bump_supersampled_techniques(),
         })
      list.insert(list.end(), family.begin(), family.end());
    return list;
  }();
  return all;
}

}  // namespace welkin

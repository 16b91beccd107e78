#include <welkin/realtime/techniques/forward_technique.h>
#include <welkin/realtime/techniques/technique_list.h>

// Techniques that are one forward pass with the environment's maps: a fragment shader each.

namespace welkin {
namespace {

template <const char* const& fragment_file>
std::unique_ptr<Technique> make_forward() {
  return std::make_unique<ForwardTechnique>(fragment_file);
}

class Mirror : public ForwardTechnique {
 public:
  Mirror() : ForwardTechnique("mirror.frag") {}

 private:
  void bind(const Program& program, const Frame&, const ParameterValues& values) override {
    program.set("mirror_footprint", values.empty() || values[0] == 0 ? 1 : 0);
  }
};

constexpr std::string_view look_ups[] = {"footprint", "point"};
constexpr Parameter mirror_parameters[] = {
    {"lookup", "the mean over what a pixel sees (by the derivatives of the mirrored view), or a point", 0, 1,
     0, true, look_ups},
};

void make_mirrors(Scene& scene) {
  for (Material& material : scene.materials) {
    material.model = MaterialModel::mirror;
    material.base_color = {1, 1, 1};
  }
}

void make_diffuse(Scene& scene) {
  for (Material& material : scene.materials) material.model = MaterialModel::lambert;
}

constexpr const char* irradiance_file = "irradiance_map.frag";
constexpr const char* prefiltered_file = "prefiltered_ggx.frag";

constexpr TechniqueInfo table[] = {
    {"mirror", "every surface a mirror: one look-up by the reflected view", "Miller & Hoffman 1984",
     Truth::unshadowed, mirror_parameters,
     [] { return std::unique_ptr<Technique>(std::make_unique<Mirror>()); }, make_mirrors},
    {"irradiance-map",
     "every surface diffuse: one look-up by the normal",
     "Greene 1986",
     Truth::unshadowed,
     {},
     make_forward<irradiance_file>,
     make_diffuse},
    {"prefiltered-ggx",
     "glossy by the GGX-filtered chain and the DFG table, diffuse by the irradiance map",
     "Karis 2013",
     Truth::unshadowed,
     {},
     make_forward<prefiltered_file>,
     nullptr},
};

}  // namespace

std::span<const TechniqueInfo> basic_techniques() { return table; }

}  // namespace welkin

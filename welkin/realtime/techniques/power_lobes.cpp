#include <welkin/realtime/techniques/forward_technique.h>
#include <welkin/realtime/techniques/power_lobe_maps.h>
#include <welkin/realtime/techniques/technique_list.h>

// Techniques that look up the chain of cosine powers (power_lobe_maps.h).

namespace welkin {
namespace {

constexpr std::string_view lobes[] = {"moments", "published"};
constexpr Parameter lobe_parameters[] = {
    {"lobe", "energy, axis and width of lobe times cosine, or the cosine outside as published", 0, 1, 0, true,
     lobes},
};

constexpr std::string_view laws[] = {"schlick", "exact"};
constexpr Parameter blend_parameters[] = {
    {"fresnel", "law of dielectric coats", 0, 1, 0, true, laws},
    {"lobe", "energy, axis and width of lobe times cosine, or the cosine outside as published", 0, 1, 0, true,
     lobes},
};

class PowerLobes : public ForwardTechnique {
 public:
  explicit PowerLobes(const char* fragment_file) : ForwardTechnique(fragment_file) {}

 protected:
  void prepare(const Frame& frame, const ParameterValues&) override { maps_.prepare(frame); }

  void bind(const Program& program, const Frame&, const ParameterValues& values) override {
    maps_.bind(program, first_technique_unit);
    program.set("power_published", !values.empty() && values.back() != 0 ? 1 : 0);
  }

 private:
  PowerLobeMaps maps_;
};

class FresnelBlendTechnique : public PowerLobes {
 public:
  FresnelBlendTechnique() : PowerLobes("fresnel_blend.frag") {}

 private:
  void bind(const Program& program, const Frame& frame, const ParameterValues& values) override {
    PowerLobes::bind(program, frame, values);
    program.set("fresnel_exact", !values.empty() && values.front() != 0 ? 1 : 0);
  }
};

// A base under a coat: nothing is metal.
void make_coated(Scene& scene) {
  for (Material& material : scene.materials) {
    material.metallic = 0;
    material.metallic_texture.texture = -1;
  }
}

constexpr TechniqueInfo table[] = {
    {"prefiltered-phong", "glossy by a chain of maps filtered with Phong's lobe, the exponent pixel by pixel",
     "Heidrich & Seidel 1999", Truth::unshadowed, lobe_parameters,
     [] { return std::unique_ptr<Technique>(std::make_unique<PowerLobes>("prefiltered_phong.frag")); },
     nullptr},
    {"fresnel-blend", "diffuse base and mirror or glossy coat, mixed by the Fresnel term of the view",
     "Debevec et al. 2006, course", Truth::unshadowed, blend_parameters,
     [] { return std::unique_ptr<Technique>(std::make_unique<FresnelBlendTechnique>()); }, make_coated},
    {"lafortune", "Lafortune's lobes, bent or anisotropic, their parameters pixel by pixel",
     "McAllister, Lastra & Heidrich 2002", Truth::unshadowed, lobe_parameters,
     [] { return std::unique_ptr<Technique>(std::make_unique<PowerLobes>("lafortune.frag")); }, nullptr},
};

}  // namespace

std::span<const TechniqueInfo> power_lobe_techniques() { return table; }

}  // namespace welkin

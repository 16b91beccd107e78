#include <welkin/realtime/techniques/bump_techniques.h>

// Normal maps seen from far away: a forward pass each. The surface below is the same for all (prefiltered-ggx).

namespace welkin {
namespace {

class BumpTechnique : public Technique {
 public:
  explicit BumpTechnique(const char* fragment_file)
      : program_("mesh.vert", fragment_file), name_(fragment_file) {}

  void draw(const Frame& frame, const ParameterValues& values) override {
    maps_.update(frame);
    const PassTimer::Scope timed(frame.timer, name_);
    program_.use();
    set_environment(program_, frame.environment);
    set_values(program_, frame, values);
    draw_scene(program_, frame.scene, frame.view, &maps_);
  }

 protected:
  virtual void set_values(const Program&, const Frame&, const ParameterValues&) const {}

 private:
  Program program_;
  GpuBumpMaps maps_;
  const char* name_;
};

class NaiveTechnique : public BumpTechnique {
 public:
  NaiveTechnique() : BumpTechnique("bump_naive.frag") {}

 protected:
  void set_values(const Program& program, const Frame&, const ParameterValues& values) const override {
    program.set("mips", values[0] == 0 ? 1 : 0);
  }
};

class SchillingTechnique : public BumpTechnique {
 public:
  SchillingTechnique() : BumpTechnique("bump_schilling.frag") {}

 protected:
  void set_values(const Program& program, const Frame& frame, const ParameterValues&) const override {
    program.set("environment_size", static_cast<float>(frame.environment.environment_size));
  }
};

constexpr std::string_view mip_choices[] = {"all", "none"};
constexpr Parameter naive_parameters[] = {
    {"mips", "levels of the normal map that are used", 0, 1, 0, true, mip_choices}};

template <class T>
std::unique_ptr<Technique> make() {
  return std::make_unique<T>();
}
std::unique_ptr<Technique> make_toksvig() { return std::make_unique<BumpTechnique>("bump_toksvig.frag"); }
std::unique_ptr<Technique> make_lean() { return std::make_unique<BumpTechnique>("bump_lean.frag"); }

constexpr TechniqueInfo table[] = {
    {"bump-naive", "mip-mapped normals and the surface's own lobe: bumps vanish or alias", "Blinn 1978",
     Truth::unshadowed, naive_parameters, make<NaiveTechnique>, nullptr},
    {"toksvig",
     "a mean normal shorter than 1 widens the lobe",
     "Toksvig 2005",
     Truth::unshadowed,
     {},
     make_toksvig,
     nullptr},
    {"lean",
     "mean and second moments of slopes widen the lobe, isotropic look-up",
     "Olano & Baker 2010",
     Truth::unshadowed,
     {},
     make_lean,
     nullptr},
    {"schilling",
     "the covariance of the normals as an anisotropic footprint, four look-ups",
     "Schilling 1997; Olano & Baker 2010",
     Truth::unshadowed,
     {},
     make<SchillingTechnique>,
     nullptr},
};

}  // namespace

std::span<const TechniqueInfo> bump_techniques() { return table; }

}  // namespace welkin

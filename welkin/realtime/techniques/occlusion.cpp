#include <welkin/realtime/occlusion/screen_occlusion.h>
#include <welkin/realtime/techniques/technique_list.h>

// Screen-space occlusion: every method alone, as a picture of openness or over the irradiance map.

namespace welkin {
namespace {

constexpr std::string_view show_choices[] = {"occlusion", "shaded"};

// The first parameters of every method, in this order.
enum Common { show, radius, cap, power, common_count };

constexpr Parameter show_parameter{
    "show", "openness alone, or diffuse light dimmed by it", 0, 1, 0, true, show_choices};
constexpr Parameter radius_parameter{
    "radius", "how far an occluder may be, metres", 0.001f, 1000, 0.5f, false, {}};
constexpr Parameter cap_parameter{"cap", "largest radius in the picture, pixels", 1, 4096, 256, true, {}};
constexpr Parameter power_parameter{
    "power", "exponent of the openness; 1 is what was measured", 0.1f, 8, 1, false, {}};
constexpr Parameter samples_parameter{"samples", "depth reads of a pixel", 1, 256, 16, true, {}};

constexpr Parameter point_parameters[] = {show_parameter, radius_parameter, cap_parameter, power_parameter,
                                          samples_parameter};
constexpr Parameter range_parameters[] = {
    show_parameter,    radius_parameter,
    cap_parameter,     power_parameter,
    samples_parameter, {"falloff", "part of the radius over which far occluders fade", 0, 1, 1, false, {}}};

using ReadOptions = void (*)(const ParameterValues&, OcclusionOptions&);

void read_points(const ParameterValues& values, OcclusionOptions& options) {
  options.samples = static_cast<int>(values[common_count]);
  if (values.size() > common_count + 1) options.falloff = values[common_count + 1];
}

class OcclusionTechnique : public Technique {
 public:
  OcclusionTechnique(OcclusionMethod method, ReadOptions read)
      : program_("mesh.vert", "occlusion_shaded.frag"), method_(method), read_(read) {}

  void draw(const Frame& frame, const ParameterValues& values) override {
    OcclusionOptions options;
    options.method = method_;
    options.radius_metres = values[radius];
    options.largest_radius_pixels = values[cap];
    read_(values, options);
    occlusion_.draw(frame.scene, frame.view, options, frame.fullscreen, frame.timer);
    frame.target.bind();
    const PassTimer::Scope timed(frame.timer, "shade");
    program_.use();
    set_environment(program_, frame.environment);
    set_screen_occlusion(program_, occlusion_, first_technique_unit);
    program_.set("show_openness", values[show] == 0 ? 1 : 0);
    program_.set("use_bent_normal", 0);
    program_.set("power", values[power]);
    draw_scene(program_, frame.scene, frame.view);
  }

 private:
  ScreenOcclusion occlusion_;
  Program program_;
  OcclusionMethod method_;
  ReadOptions read_;
};

template <OcclusionMethod method, ReadOptions read>
std::unique_ptr<Technique> make() {
  return std::make_unique<OcclusionTechnique>(method, read);
}

void make_diffuse(Scene& scene) {
  for (Material& material : scene.materials) material.model = MaterialModel::lambert;
}

constexpr TechniqueInfo table[] = {
    {"ssao-sphere", "occlusion from points in a ball; flat walls come out half open", "Mittring 2007",
     Truth::ambient_occlusion, point_parameters, make<OcclusionMethod::sphere, read_points>, make_diffuse},
    {"ssao-hemisphere", "occlusion from points on the side of the normal", "Filion & McNaughton 2008",
     Truth::ambient_occlusion, point_parameters, make<OcclusionMethod::hemisphere, read_points>,
     make_diffuse},
    {"ssao-range", "the same, occluders beyond the radius fade", "Filion & McNaughton 2008",
     Truth::ambient_occlusion, range_parameters, make<OcclusionMethod::hemisphere, read_points>,
     make_diffuse},
};

}  // namespace

std::span<const TechniqueInfo> occlusion_techniques() { return table; }

}  // namespace welkin

#include <welkin/realtime/occlusion/screen_occlusion.h>
#include <welkin/realtime/techniques/technique_list.h>

// Screen-space occlusion: every method alone, as a picture of openness or over the irradiance map; and one technique that has them
// all over the irradiance map, by the normal or the bent normal.

namespace welkin {
namespace {

constexpr std::string_view show_choices[] = {"occlusion", "shaded"};
constexpr std::string_view no_yes[] = {"off", "on"};
constexpr std::string_view method_choices[] = {"sphere", "hemisphere",         "alchemy",        "sao",
                                               "gtao",   "visibility-bitmask", "horizon-sectors"};

// The first parameters of every method, in this order.
enum Common { show, radius, cap, power, denoise, own };

constexpr Parameter show_parameter{
    "show", "openness alone, or diffuse light dimmed by it", 0, 1, 0, true, show_choices};
constexpr Parameter radius_parameter{
    "radius", "how far an occluder may be, metres", 0.001f, 1000, 0.5f, false, {}};
constexpr Parameter cap_parameter{"cap", "largest radius in the picture, pixels", 1, 4096, 256, true, {}};
constexpr Parameter power_parameter{
    "power", "exponent of the openness; 1 is what was measured", 0.1f, 8, 1, false, {}};
constexpr Parameter denoise_parameter{"denoise", "cross-bilateral filter", 0, 1, 1, true, no_yes};
constexpr Parameter samples_parameter{"samples", "depth reads of a pixel", 1, 256, 16, true, {}};
constexpr Parameter slices_parameter{"slices", "half planes through the view ray", 1, 64, 2, true, {}};
constexpr Parameter steps_parameter{"steps", "depth reads on each side of a slice", 1, 64, 4, true, {}};
constexpr Parameter thickness_parameter{
    "thickness", "of everything that is seen, metres", 0.001f, 1000, 0.1f, false, {}};

constexpr Parameter point_parameters[] = {show_parameter,  radius_parameter,  cap_parameter,
                                          power_parameter, denoise_parameter, samples_parameter};
constexpr Parameter range_parameters[] = {
    show_parameter,
    radius_parameter,
    cap_parameter,
    power_parameter,
    denoise_parameter,
    samples_parameter,
    {"falloff", "part of the radius over which far occluders fade", 0, 1, 1, false, {}}};
constexpr Parameter alchemy_parameters[] = {
    show_parameter,
    radius_parameter,
    cap_parameter,
    power_parameter,
    denoise_parameter,
    samples_parameter,
    {"intensity", "factor of the occlusion; 1 fits traced occlusion best", 0, 10, 1, false, {}}};
constexpr Parameter sao_parameters[] = {
    show_parameter,
    radius_parameter,
    cap_parameter,
    power_parameter,
    denoise_parameter,
    samples_parameter,
    {"intensity", "factor of the occlusion; 0.6 fits traced occlusion best", 0, 10, 0.6f, false, {}}};
constexpr Parameter gtao_parameters[] = {
    show_parameter,
    radius_parameter,
    cap_parameter,
    power_parameter,
    denoise_parameter,
    slices_parameter,
    steps_parameter,
    {"falloff", "part of the radius over which far occluders fade", 0, 1, 0.615f, false, {}},
    {"thin", "how fast a horizon sinks behind a thin occluder", 0, 1, 0, false, {}}};
constexpr Parameter sector_parameters[] = {show_parameter,  radius_parameter,   cap_parameter,
                                           power_parameter, denoise_parameter,  slices_parameter,
                                           steps_parameter, thickness_parameter};

using ReadOptions = void (*)(const ParameterValues&, OcclusionOptions&);

void read_points(const ParameterValues& values, OcclusionOptions& options) {
  options.samples = static_cast<int>(values[own]);
  if (values.size() > own + 1) options.falloff = values[own + 1];
}

void read_alchemy(const ParameterValues& values, OcclusionOptions& options) {
  options.samples = static_cast<int>(values[own]);
  options.intensity = values[own + 1];
}

void read_slices(const ParameterValues& values, OcclusionOptions& options) {
  options.slices = static_cast<int>(values[own]);
  options.steps = static_cast<int>(values[own + 1]);
}

void read_gtao(const ParameterValues& values, OcclusionOptions& options) {
  read_slices(values, options);
  options.falloff = values[own + 2];
  options.thin = values[own + 3];
}

void read_sectors(const ParameterValues& values, OcclusionOptions& options) {
  read_slices(values, options);
  options.thickness_metres = values[own + 2];
  if (options.method == OcclusionMethod::visibility_bitmask) options.step_power = 1;  // as published
}

// Draws the openness and then the scene with it.
class OcclusionTechnique : public Technique {
 public:
  OcclusionTechnique(OcclusionMethod method, ReadOptions read)
      : program_("mesh.vert", "occlusion_shaded.frag"), method_(method), read_(read) {}

  void draw(const Frame& frame, const ParameterValues& values) override {
    OcclusionOptions options;
    options.method = method_;
    options.radius_metres = values[radius];
    options.largest_radius_pixels = values[cap];
    options.denoise = values[denoise] != 0;
    read_(values, options);
    draw_with(frame, options, values[show] == 0, values[power]);
  }

 protected:
  void draw_with(const Frame& frame, const OcclusionOptions& options, bool openness_alone, float exponent) {
    occlusion_.draw(frame.scene, frame.view, options, frame.fullscreen, frame.timer);
    frame.target.bind();
    const PassTimer::Scope timed(frame.timer, "shade");
    program_.use();
    set_environment(program_, frame.environment);
    set_screen_occlusion(program_, occlusion_, first_technique_unit);
    program_.set("show_openness", openness_alone ? 1 : 0);
    program_.set("use_bent_normal", options.bent_normals ? 1 : 0);
    program_.set("power", exponent);
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

enum Shaded { method_of, bent, shaded_radius, shaded_cap, shaded_denoise, slices, steps, thickness };
constexpr Parameter shaded_parameters[] = {
    {"method", "of occlusion", 0, occlusion_methods - 1, occlusion_methods - 1, true, method_choices},
    {"bent", "look up irradiance by the bent normal", 0, 1, 1, true, no_yes},
    radius_parameter,
    cap_parameter,
    denoise_parameter,
    slices_parameter,
    steps_parameter,
    thickness_parameter};

class ShadedTechnique : public OcclusionTechnique {
 public:
  ShadedTechnique() : OcclusionTechnique(OcclusionMethod::horizon_sectors, nullptr) {}

  void draw(const Frame& frame, const ParameterValues& values) override {
    OcclusionOptions options;
    options.method = static_cast<OcclusionMethod>(static_cast<int>(values[method_of]));
    options.bent_normals = values[bent] != 0;
    options.radius_metres = values[shaded_radius];
    options.largest_radius_pixels = values[shaded_cap];
    options.denoise = values[shaded_denoise] != 0;
    options.slices = static_cast<int>(values[slices]);
    options.steps = static_cast<int>(values[steps]);
    options.samples = 2 * options.slices * options.steps;
    options.thickness_metres = values[thickness];
    options.step_power = options.method == OcclusionMethod::visibility_bitmask ? 1.0f : 2.0f;
    draw_with(frame, options, false, 1);
  }
};

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
    {"alchemy", "obscurance from taps on surfaces around the pixel",
     "McGuire, Osman, Bukowski & Hennessy 2011", Truth::ambient_occlusion, alchemy_parameters,
     make<OcclusionMethod::alchemy, read_alchemy>, make_diffuse},
    {"sao", "the same on a spiral, far taps from smaller levels of depth", "McGuire, Mara & Luebke 2012",
     Truth::ambient_occlusion, sao_parameters, make<OcclusionMethod::sao, read_alchemy>, make_diffuse},
    {"gtao", "occlusion between the horizons of slices, in closed form", "Jimenez, Wu, Pesce & Jarabo 2016",
     Truth::ambient_occlusion, gtao_parameters, make<OcclusionMethod::gtao, read_gtao>, make_diffuse},
    {"visibility-bitmask", "occlusion by 32 sectors of a slice: light passes under thin things",
     "Therrien, Levesque & Gilet 2023", Truth::ambient_occlusion, sector_parameters,
     make<OcclusionMethod::visibility_bitmask, read_sectors>, make_diffuse},
    {"horizon-sectors", "occlusion by sectors of equal measure and taps that stand for pieces of surface",
     "our own, after Therrien et al. 2023", Truth::ambient_occlusion, sector_parameters,
     make<OcclusionMethod::horizon_sectors, read_sectors>, make_diffuse},
    {"ssao-irradiance", "diffuse light of the irradiance map, dimmed by screen-space occlusion",
     "McGuire et al. 2011; bent normals: Landis 2002", Truth::direct, shaded_parameters,
     [] { return std::unique_ptr<Technique>(std::make_unique<ShadedTechnique>()); }, make_diffuse},
};

}  // namespace

std::span<const TechniqueInfo> occlusion_techniques() { return table; }

}  // namespace welkin

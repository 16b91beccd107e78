#include <welkin/realtime/capture/dynamic_light.h>
#include <welkin/realtime/capture/glossy_maps.h>
#include <welkin/realtime/techniques/dynamic_choices.h>
#include <welkin/realtime/techniques/technique_list.h>

// Dynamic glossy reflections (Kautz et al. 2000, Ashikhmin & Ghosh 2003, Kautz et al. 2004): the surroundings are captured and filtered each frame by one of five
// methods; each pixel takes its own roughness from them.

namespace welkin {
namespace {

constexpr int lobe_unit = first_technique_unit + 3;  // the glossy maps have those before
constexpr int smallest_size = 16;

class DynamicGlossy : public Technique {
 public:
  DynamicGlossy() : program_("mesh.vert", "dynamic_glossy.frag") {}

  void draw(const Frame& frame, const ParameterValues& values) override {
    const auto whole = [&values](std::size_t i) { return static_cast<int>(values[i]); };
    const GlossyOptions glossy{static_cast<GlossyMethod>(whole(0)), whole(1) == 1, whole(2), smallest_size << whole(3)};
    DynamicLightOptions options;
    options.around = static_cast<SurroundingsKind>(whole(4));
    options.sky = whole(5);
    options.size = glossy.size;
    options.bounces = whole(6);
    options.flare_radiance = values[7];
    light_.update(frame, options);
    if (!maps_ || !same(glossy, glossy_)) {
      maps_.reset();
      maps_.emplace(glossy);
      glossy_ = glossy;
    }
    {
      const PassTimer::Scope timed(frame.timer, "glossy maps");
      maps_->update(light_.capture().cube(), frame.fullscreen);
    }
    shade(frame);
  }

  Cube captured_environment() const override {
    return light_.ready() ? light_.capture().read_as_cube() : Cube{};
  }

 private:
  static bool same(const GlossyOptions& a, const GlossyOptions& b) {
    return a.method == b.method && a.seams_shown == b.seams_shown && a.taps == b.taps && a.size == b.size;
  }

  void shade(const Frame& frame) {
    const View view = light_.view_of(frame);
    frame.target.bind();
    {
      const PassTimer::Scope timed(frame.timer, "scene");
      program_.use();
      set_environment(program_, frame.environment);
      maps_->set(program_, light_.capture().cube());
      program_.set_texture("lobe_map", lobe_unit, GL_TEXTURE_CUBE_MAP, light_.irradiance().cube());
      draw_scene(program_, frame.scene, view);
    }
    light_.draw_around(frame, view);
  }

  Program program_;
  DynamicLight light_;
  GlossyOptions glossy_;
  std::optional<GlossyMaps> maps_;
};

std::unique_ptr<Technique> make_glossy() { return std::make_unique<DynamicGlossy>(); }

constexpr std::string_view methods[] = {"box", "bordered", "paraboloid", "quick", "importance"};
constexpr std::string_view sizes[] = {"16", "32", "64", "128", "256"};
constexpr std::string_view seams[] = {"fixed", "shown"};

constexpr Parameter parameters[] = {
    {"method", "how the capture is filtered", 0, 4, 3, true, methods},
    {"seams", "the edges of box, bordered and paraboloid without their remedy", 0, 1, 0, true, seams},
    {"taps", "look-ups of quick and importance", 2, 64, 16, true, {}},
    {"size", "texels along an edge of the capture", 0, 4, 3, true, sizes},
    {"around", "what moves around the scene", 0, 3, 1, true, around},
    {"sky", "the environment, or a day of 60 s", 0, 1, 0, true, skies},
    {"bounces", "times that light goes from the surroundings to the surroundings", 0, 3, 1, true, {}},
    {"flare", "radiance of the flares, W/(sr m^2)", 0, 2000, 150, false, {}},
};

constexpr TechniqueInfo table[] = {
    {"dynamic-glossy", "glossy and diffuse, by maps of moving surroundings that are filtered each frame",
     "Kautz et al. 2004", Truth::dynamic, parameters, make_glossy, nullptr},
};

}  // namespace

std::span<const TechniqueInfo> dynamic_glossy_techniques() { return table; }

}  // namespace welkin

#include <welkin/scene/built_in.h>

#include <fmt/format.h>

#include <welkin/error.h>
#include <welkin/scene/built_in_scenes.h>

namespace welkin {
namespace {

constexpr BuiltInScene scenes[] = {
    {"spheres", "rows of spheres, mirror to rough from left to right: metal above, coated plastic below",
     "alphas=0/0.03/0.1/0.2/0.4/0.7/1 (GGX width of each column, 0 is a mirror)"},
    {"plane", "a sphere that rests on a large plane: its ambient occlusion has a closed form",
     "radius=1 (metres)"},
    {"furnace", "lossless spheres of every reflection model: they vanish in a constant environment",
     "alpha=0.25 (GGX width)"},
    {"box",
     "a room of coloured walls with two blocks and a rectangle light, after the Cornell box; needs no "
     "environment",
     "radiance=17 (of the light, W/(sr m^2))"},
    {"shader-ball", "a ball with a ring on a foot over a chequered ground, of metallic-roughness materials",
     "metallic=0, roughness=0.3 (perceptual), anisotropy=0"},
    {"bumpy", "a glossy metal plane or ball with a normal map",
     "alpha=0.1 (GGX width), bumps=4 (to a side), slope=0.5, pattern=bumps (or noise, brushed, waves, "
     "bricks), tiling=1 (times that the map repeats), shape=plane (or ball)"},
    {"fences", "rows of thin fences on a ground: shadows, occlusion and leaks of thin things",
     "rows=6, posts=24, thickness=0.02 (metres)"},
    {"stairs", "steps with thin rails between pillars, before a wall: corners of every depth",
     "steps=9, baluster=0.025 (metres)"},
    {"cards", "a bush of loose leaves on a stem, in thin grass: occluders without thickness",
     "leaves=700, size=0.16 (metres)"},
};
using Maker = Scene (*)(SceneParameters& parameters);
constexpr Maker makers[] = {make_spheres_scene, make_plane_scene,       make_furnace_scene,
                            make_box_scene,     make_shader_ball_scene, make_bumpy_scene,
                            make_fences_scene,  make_stairs_scene,      make_cards_scene};
static_assert(std::size(scenes) == std::size(makers));

}  // namespace

std::span<const BuiltInScene> built_in_scenes() { return scenes; }

Scene make_built_in_scene(std::string_view name) {
  const std::size_t colon = name.find(':');
  const std::string_view base = name.substr(0, colon);
  for (std::size_t i = 0; i < std::size(scenes); ++i) {
    if (scenes[i].name != base) continue;
    SceneParameters parameters(name, colon == std::string_view::npos ? "" : name.substr(colon + 1));
    Scene scene = makers[i](parameters);
    parameters.refuse_others();
    scene.source = name;
    check_scene(scene);
    return scene;
  }
  std::string known;
  for (const BuiltInScene& scene : scenes)
    known += fmt::format("{}{}", known.empty() ? "" : ", ", scene.name);
  throw Error(name, fmt::format("there is no built-in scene of this name; there are {}", known));
}

}  // namespace welkin

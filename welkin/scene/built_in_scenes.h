#pragma once
#include <welkin/scene/built_in_parameters.h>
#include <welkin/scene/scene.h>

// What built_in.cpp lists, one function a scene.

namespace welkin {

Scene make_spheres_scene(SceneParameters& parameters);
Scene make_plane_scene(SceneParameters& parameters);
Scene make_furnace_scene(SceneParameters& parameters);
Scene make_box_scene(SceneParameters& parameters);
Scene make_shader_ball_scene(SceneParameters& parameters);
Scene make_bumpy_scene(SceneParameters& parameters);
Scene make_fences_scene(SceneParameters& parameters);
Scene make_stairs_scene(SceneParameters& parameters);
Scene make_cards_scene(SceneParameters& parameters);

}  // namespace welkin

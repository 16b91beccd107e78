#pragma once
#include <span>
#include <string_view>

#include <welkin/scene/scene.h>

// Scenes that welkin makes itself: nothing is stored, every one is a function of its name and parameters.

namespace welkin {

struct BuiltInScene {
  std::string_view name;
  std::string_view description;  ///< one line
  std::string_view parameters;   ///< "key=default (meaning), ..."; empty for none
};

/// All of them, in the order of documentation.
std::span<const BuiltInScene> built_in_scenes();

/// "name" or "name:key=value,key=value"; lists have / between their numbers. The scene passes check_scene, has one camera
/// that frames it and names its materials. Throws Error for an unknown name or key and for a value out of range.
Scene make_built_in_scene(std::string_view name);

}  // namespace welkin

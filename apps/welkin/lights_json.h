#pragma once
#include <nlohmann/json.hpp>
#include <span>

#include <welkin/envmap/lights.h>
#include <welkin/envmap/lights_check.h>

namespace welkin {

/// The lights of a manifest or a coefficient file: an array, strongest first, of
///   direction (towards the light), angular_radius_degrees, irradiance [r, g, b] of a surface that faces it,
///   illuminance (its luminance), color (irradiance / illuminance), share of the map's flux.
nlohmann::ordered_json lights_to_json(std::span<const DirectionalLight> lights);

/// How far map and residual + lights are apart, shares of the map's largest irradiance.
nlohmann::ordered_json recombination_to_json(const RecombinationErrors& errors);

/// A table for people, one line a light; says so when there is none.
void print_lights(std::span<const DirectionalLight> lights);

}  // namespace welkin

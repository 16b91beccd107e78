#pragma once
#include <welkin/envmap/sky/rgb.h>
#include <welkin/sphere/vec3.h>

namespace welkin {

/// The photographer's studio: a large key box to the left of +X and above, a broad dim fill on the right, a narrow
/// bright rim strip behind, an overhead box, dark walls and a grey floor with the key's pool of light. Radiance towards
/// the unit direction; the key is 24 W/(sr m^2), the walls about 0.05.
Rgb studio_radiance(Vec3 direction);

}  // namespace welkin

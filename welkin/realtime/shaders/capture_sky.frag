// The sky of a capture: the environment's map, at the level whose texels are as large as the capture's, or a clear day. With PARABOLOID the picture is one of two
// paraboloids, else a perspective one.
#include "environment.glsl"
#include "daylight.glsl"
in vec2 uv;
uniform vec3 ray_corner, ray_right, ray_up;
uniform float paraboloid_side;
uniform int sky_kind;        // 0: the map, 1: the day
uniform float sky_level;
layout(location = 0) out vec4 radiance;

void main() {
#ifdef PARABOLOID
  vec2 place = vec2(2.0 * uv.x - 1.0, 1.0 - 2.0 * uv.y);
  float scale = 2.0 / (1.0 + dot(place, place));
  vec3 direction = vec3(place * scale, paraboloid_side * (scale - 1.0));
#else
  vec3 direction = normalize(ray_corner + uv.x * ray_right + uv.y * ray_up);
#endif
  vec3 seen = sky_kind == 0 ? textureLod(environment_map, in_map(direction), sky_level).rgb : daylight(direction);
  radiance = vec4(min(seen, vec3(65504.0)), 0.0);
}

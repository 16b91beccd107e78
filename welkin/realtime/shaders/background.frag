// What is seen behind the scene: a ray for each pixel.
#include "environment.glsl"
in vec2 uv;
uniform vec3 ray_corner, ray_right, ray_up;  // ray of a perspective camera: corner + uv.x right + uv.y up, from the bottom left
layout(location = 0) out vec4 radiance;      // alpha 0: no surface

void main() {
  radiance = vec4(environment_radiance(normalize(ray_corner + uv.x * ray_right + uv.y * ray_up)), 0.0);
}

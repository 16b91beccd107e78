// One layer of the bordered pictures: a face of the cube that goes on beyond its edges, or a paraboloid that goes on beyond its rim, from the captured cube. Where texels of the
// face and of the cube are the same they are copied.
#include "cube_faces.glsl"
uniform samplerCube cube;
uniform int layer, paraboloid;
uniform float size, reach;  // texels of the picture's edge
layout(location = 0) out vec4 radiance;

vec3 paraboloid_direction(vec2 at) {
  float scale = 2.0 / (1.0 + dot(at, at));
  return vec3(at.x * scale, -at.y * scale, (layer == 0 ? 1.0 : -1.0) * (scale - 1.0));
}

void main() {
  vec2 texel = gl_FragCoord.xy - 0.5;
  if (paraboloid == 0) {
    radiance = textureLod(cube, cube_ray(layer, reach * (2.0 * (texel + 0.5) / size - 1.0)), 0.0);
    return;
  }
  vec4 sum = vec4(0.0);
  for (int k = 0; k < 4; ++k) {
    vec2 inside = texel + vec2(k % 2 == 0 ? 0.25 : 0.75, k < 2 ? 0.25 : 0.75);
    sum += textureLod(cube, paraboloid_direction(reach * (2.0 * inside / size - 1.0)), 0.0);
  }
  radiance = 0.25 * sum;
}

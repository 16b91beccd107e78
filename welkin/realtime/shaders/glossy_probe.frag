// A face of what glossy.glsl gives for one roughness in all directions, to be measured.
#include "glossy.glsl"
uniform int face;
uniform float size, perceptual_roughness;
layout(location = 0) out vec4 radiance;

void main() {
  radiance = vec4(glossy_radiance(cube_ray(face, 2.0 * gl_FragCoord.xy / size - 1.0), perceptual_roughness), 1.0);
}

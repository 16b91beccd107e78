// A level of a cube's chain by quadratic B-splines (Manson & Sloan 2016; welkin/envmap/methods/spline_mips.h): the mean of the 4 x 4 texels around with weights 1 3 3 1
// along each axis times solid angle; those beyond an edge are looked up there, in a corner there are 12.
#include "cube_faces.glsl"
uniform samplerCube finer;  // its base level is the finer one
uniform int face;
uniform float finer_size;
layout(location = 0) out vec4 radiance;

void main() {
  vec4 sum = vec4(0.0);
  vec2 first = 2.0 * (gl_FragCoord.xy - 0.5) - 1.0;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      vec2 texel = first + vec2(i, j);
      bvec2 outside = notEqual(clamp(texel, vec2(0.0), vec2(finer_size - 1.0)), texel);
      if (outside.x && outside.y) continue;
      vec2 at = (2.0 * texel + 1.0) / finer_size - 1.0;
      vec2 inside = clamp(at, vec2(1.0 / finer_size - 1.0), vec2(1.0 - 1.0 / finer_size));
      float r2 = 1.0 + dot(inside, inside);
      float weight = (i == 0 || i == 3 ? 1.0 : 3.0) * (j == 0 || j == 3 ? 1.0 : 3.0) / (r2 * sqrt(r2));
      sum += weight * vec4(textureLod(finer, cube_ray(face, at), 0.0).rgb, 1.0);
    }
  }
  radiance = sum / sum.w;
}

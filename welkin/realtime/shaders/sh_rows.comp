// First stage as a compute program: invocation (y, g) sums row y of the map for coefficients 4 g to 4 g + 3. No shared memory and no barriers, which cost more than they save
// where few rows are added up.
layout(local_size_x = 32) in;
#include "map_texel.glsl"
uniform int size, width, height;
layout(std430, binding = 0) readonly buffer Table { vec4 table[]; };      // [(g * height + y) * width + x]
layout(std430, binding = 1) writeonly buffer Rows { vec4 rows[]; };       // [i * height + y]

void main() {
  int y = int(gl_GlobalInvocationID.x), group = int(gl_GlobalInvocationID.y);
  if (y >= height) return;
  int first = (group * height + y) * width;
  vec3 a = vec3(0.0), b = a, c = a, d = a;
  for (int x = 0; x < width; ++x) {
    vec3 radiance = map_texel(x, y, size);
    vec4 weights = table[first + x];
    a += weights.x * radiance;
    b += weights.y * radiance;
    c += weights.z * radiance;
    d += weights.w * radiance;
  }
  int out_at = 4 * group * height + y;
  rows[out_at] = vec4(a, 1.0);
  rows[out_at + height] = vec4(b, 1.0);
  rows[out_at + 2 * height] = vec4(c, 1.0);
  rows[out_at + 3 * height] = vec4(d, 1.0);
}

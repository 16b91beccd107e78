// One of two rounds, along x and along y, of the cross-bilateral filter. The noise repeats every four pixels, and (1/2, 1, 1, 1, 1/2) / 4 has all
// four of them with equal weights: what remains on an even surface is the mean over all 16 turns. A neighbour is weighted by
// 1 / (1 + (difference / noise)^2), see docs/realtime-occlusion.md: difference in openness expected from its distance to the plane of
// either pixel, from the way along the plane, and from the angle between the normals.
#include "occlusion_layer.glsl"
uniform sampler2D noisy;      // bent normal and openness
uniform bool upwards;         // along y, else along x
uniform vec3 noise_scale;     // off the plane and along it, parts of the radius; angle, radians

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float depth = depth_at(pixel);
  vec4 mine = texelFetch(noisy, pixel, 0);
  openness = mine;
  if (depth <= 0.0) return;
  vec3 position = view_position(vec2(pixel) + 0.5, depth), normal = normal_at(pixel);
  float weights = 1.0, size = 0.05 / pixels_per_metre(depth);
  vec4 sum = mine;
  for (int i = -2; i <= 2; ++i) {
    ivec2 tap = pixel + (upwards ? ivec2(0, i) : ivec2(i, 0));
    if (i == 0 || outside(tap) || depth_at(tap) <= 0.0) continue;
    vec3 to = position_at(tap) - position, other = normal_at(tap);
    float off = max(max(abs(dot(to, normal)), abs(dot(to, other))) - size, 0.0);
    vec3 difference = vec3(off, length(to), length(other - normal)) / (noise_scale * vec3(radius, radius, 1.0));
    float weight = (abs(i) == 2 ? 0.5 : 1.0) / (1.0 + dot(difference, difference));
    sum += weight * texelFetch(noisy, tap, 0);
    weights += weight;
  }
  sum /= weights;
  openness = vec4(dot(sum.rgb, sum.rgb) > 1e-12 ? normalize(sum.rgb) : mine.rgb, sum.a);
}

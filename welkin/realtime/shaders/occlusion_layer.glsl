// The depth layer that every screen-space method reads, and the noise that turns each pixel's samples. Camera's frame: x right,
// y up, z towards the eye. gl_FragCoord names pixels from the bottom left.
#include "constants.glsl"
uniform sampler2D depth_layer;       // metres along the view axis, 0: nothing
uniform sampler2D view_normals;
uniform vec4 view_window;            // corner and size of what the picture shows: at depth 1, or anywhere if orthographic
uniform bool orthographic;
#define picture_size textureSize(view_normals, 0)
uniform float radius, largest_radius_pixels, thickness, falloff;
uniform mat3 view_to_world;
layout(location = 0) out vec4 openness;  // bent normal, world, unit; share of the hemisphere that is open

vec3 view_position(vec2 pixel, float depth) {
  vec2 across = view_window.xy + view_window.zw * pixel / vec2(picture_size);
  return vec3(orthographic ? across : across * depth, -depth);
}

bool outside(ivec2 pixel) {
  return any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, picture_size));
}

float depth_at(ivec2 pixel) { return texelFetch(depth_layer, pixel, 0).r; }

vec3 position_at(ivec2 pixel) { return view_position(vec2(pixel) + 0.5, depth_at(pixel)); }

vec3 normal_at(ivec2 pixel) { return normalize(texelFetch(view_normals, pixel, 0).xyz); }

vec3 towards_eye(vec3 position) { return orthographic ? vec3(0.0, 0.0, 1.0) : normalize(-position); }

// Where a point of the camera's frame is seen, in pixels.
vec2 pixel_of(vec3 position) {
  vec2 across = orthographic ? position.xy : position.xy / -position.z;
  return (across - view_window.xy) / view_window.zw * vec2(picture_size);
}

float pixels_per_metre(float depth) { return float(picture_size.y) / (view_window.w * (orthographic ? 1.0 : depth)); }

float radius_in_pixels(float depth) { return min(radius * pixels_per_metre(depth), largest_radius_pixels); }

// A number 0 to 15 for each pixel: every 4 x 4 pixels have all of them, neighbours lie far apart (an ordered-dither matrix).
int pattern_index(ivec2 pixel) {
  int x = pixel.x & 3, y = pixel.y & 3, d = x ^ y;
  return ((d & 1) << 3) | ((x & 1) << 2) | (d & 2) | ((x & 2) >> 1);
}

// The 16 points of Hammersley's set: (k / 16, k with its bits reversed / 16), in the middle of their strata.
vec2 pattern(ivec2 pixel) {
  int k = pattern_index(pixel);
  int reversed = ((k & 1) << 3) | ((k & 2) << 1) | ((k & 4) >> 1) | ((k & 8) >> 3);
  return (vec2(float(k), float(reversed)) + 0.5) / 16.0;
}

float radical_inverse(int i) {
  uint b = uint(i);
  b = (b << 16u) | (b >> 16u);
  b = ((b & 0x55555555u) << 1u) | ((b & 0xAAAAAAAAu) >> 1u);
  b = ((b & 0x33333333u) << 2u) | ((b & 0xCCCCCCCCu) >> 2u);
  b = ((b & 0x0F0F0F0Fu) << 4u) | ((b & 0xF0F0F0F0u) >> 4u);
  b = ((b & 0x00FF00FFu) << 8u) | ((b & 0xFF00FF00u) >> 8u);
  return float(b >> 8u) / 16777216.0;
}

void write_openness(vec3 bent, vec3 normal, float open) {
  vec3 direction = dot(bent, bent) > 1e-12 ? normalize(bent) : normal;
  openness = vec4(view_to_world * direction, clamp(open, 0.0, 1.0));
}

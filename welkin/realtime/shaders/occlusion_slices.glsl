// Slices: half planes through the view ray. In a slice every direction is one angle from the ray to the eye (v), positive towards
// the slice's direction on the screen; a tap of the depth layer hides an interval of angles.
#include "occlusion_layer.glsl"
uniform int slices, steps;        // 2 * slices * steps depth reads a pixel
uniform float step_power;         // taps lie at radius * u^step_power

struct Slice {
  vec2 screen;         // unit, pixels
  vec3 tangent, view;  // of the slice's plane, unit, at right angles
  vec3 across;         // unit normal of the plane: tangent x view
  float projected;     // length of the normal's part in the plane
  float angle;         // of that part, from the view: gamma
};

// The plane that contains the view ray and the direction on the screen.
Slice slice_on_screen(float turn, vec3 view, vec3 normal) {
  Slice s;
  s.screen = vec2(cos(turn), sin(turn));
  s.view = view;
  s.tangent = normalize(vec3(s.screen, 0.0) - dot(vec3(s.screen, 0.0), view) * view);
  s.across = cross(s.tangent, view);
  float t = dot(normal, s.tangent), v = dot(normal, view);
  s.projected = sqrt(t * t + v * v);
  s.angle = atan(t, v);
  return s;
}

// Integral of |sin x| cos(x - gamma) from 0 to angle, taken positive on both sides (gamma: c its cosine, s its sine). For x > 0
// the product is (sin(2x - gamma) + sin gamma) / 2; the other side is the mirror image with -gamma.
float slice_measure(float angle, float gamma, float c, float s) {
  float a = abs(angle), side = angle < 0.0 ? -1.0 : 1.0;
  return 0.25 * (c - cos(2.0 * a - side * gamma)) + 0.5 * a * side * s;
}

// Integral of |sin x| cos(x - gamma) (sin x, cos x) from 0 to angle, for x > 0 in the first and in the second coordinate
//   c sin^3 / 3 + s (cos^3 / 3 - cos + 2/3),   c (1 - cos^3) / 3 + s sin^3 / 3;
// the other side is the mirror image: gamma and the first coordinate change their signs.
vec2 slice_direction(float angle, float c, float s) {
  float a = abs(angle), side = angle < 0.0 ? -1.0 : 1.0, z = cos(a), y = sin(a);
  float y3 = y * y * y / 3.0, z3 = z * z * z / 3.0;
  return vec2(side * (c * y3 + side * s * (z3 - z + 2.0 / 3.0)), c * (1.0 / 3.0 - z3) + side * s * y3);
}

int bits_of(uint b) {
  b = b - ((b >> 1u) & 0x55555555u);
  b = (b & 0x33333333u) + ((b >> 2u) & 0x33333333u);
  return int(((b + (b >> 4u) & 0x0F0F0F0Fu) * 0x01010101u) >> 24u);
}

// Radiance to what a screen shows: exposure, curve, sRGB encoding; the same curves as welkin/image/tonemap.h.
uniform float exposure;  // factor
uniform int curve;       // 0 clamp, 1 reinhard, 2 filmic
uniform float white;     // reinhard

// Brighter than any screen and still far from what overflows when it is squared.
const float BRIGHTEST = 1e15;

vec3 encode_srgb(vec3 linear) {
  linear = clamp(linear, 0.0, 1.0);
  return mix(1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, 12.92 * linear, vec3(lessThanEqual(linear, vec3(0.0031308))));
}

// Narkowicz 2015. Above 1000 it is 1 to within the clamp.
vec3 filmic_curve(vec3 x) {
  x = min(x, vec3(1000.0));
  return clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

// NaN becomes black (a comparison with it is false), infinity white.
vec3 finite_radiance(vec3 c) { return mix(vec3(0.0), min(c, vec3(BRIGHTEST)), greaterThan(c, vec3(0.0))); }

vec3 tone_mapped(vec3 radiance) {
  vec3 c = min(finite_radiance(radiance) * exposure, vec3(BRIGHTEST));
  if (curve == 1) {
    float luminance = dot(c, vec3(0.2126, 0.7152, 0.0722));
    c *= (1.0 + luminance / (white * white)) / (1.0 + luminance);
  } else if (curve == 2) {
    c = filmic_curve(c);
  }
  return encode_srgb(c);
}

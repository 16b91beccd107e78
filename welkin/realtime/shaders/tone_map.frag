// Radiance to what a screen shows: exposure, curve, sRGB encoding; the same curves as welkin/image/tonemap.h.
in vec2 uv;
uniform sampler2D picture;
uniform float exposure;  // factor
uniform int curve;       // 0 clamp, 1 reinhard, 2 filmic
uniform float white;     // reinhard
layout(location = 0) out vec4 color;

vec3 srgb(vec3 linear) {
  linear = clamp(linear, 0.0, 1.0);
  return mix(1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, 12.92 * linear, vec3(lessThanEqual(linear, vec3(0.0031308))));
}

vec3 filmic(vec3 x) { return clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0); }

void main() {
  vec3 c = max(texture(picture, uv).rgb, 0.0) * exposure;
  if (curve == 1) {
    float luminance = dot(c, vec3(0.2126, 0.7152, 0.0722));
    c *= (1.0 + luminance / (white * white)) / (1.0 + luminance);
  } else if (curve == 2) {
    c = filmic(c);
  }
  color = vec4(srgb(c), 1.0);
}

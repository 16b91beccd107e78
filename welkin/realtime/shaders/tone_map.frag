// Radiance to what a screen shows.
#include "tone_curves.glsl"
in vec2 uv;
uniform sampler2D picture;
layout(location = 0) out vec4 color;

void main() { color = vec4(tone_mapped(texture(picture, uv).rgb), 1.0); }

// Openness that an earlier pass found for this pixel (welkin/realtime/occlusion/screen_occlusion.h): rgb the bent normal in the
// world, a the open share of the hemisphere.
uniform sampler2D screen_openness;
vec4 openness_of_fragment() { return texelFetch(screen_openness, ivec2(gl_FragCoord.xy), 0); }

// The depth layer's smaller levels in one texture, one below the other: level k is (size >> k), at row sum of those before. Each texel is
// one texel of the level before it, of the four in turns (McGuire, Mara & Luebke 2012: no mean, so that no depth appears
// that nothing has); followed back to the layer itself, so that all levels are one pass.
uniform sampler2D depth_layer;
uniform int levels;
layout(location = 0) out float view_depth;

void main() {
  ivec2 full = textureSize(depth_layer, 0), at = ivec2(gl_FragCoord.xy);
  int level = 1;
  while (level < levels && at.y >= (full.y >> level)) {
    at.y -= full.y >> level;
    ++level;
  }
  for (int k = level; k > 0; --k) at = 2 * at + ivec2(at.y & 1, at.x & 1);
  at = min(at, full - 1);
  view_depth = texelFetch(depth_layer, at, 0).r;
}

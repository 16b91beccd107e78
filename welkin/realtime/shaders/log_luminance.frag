// For each cell of a coarse grid over the picture: the sum of log2 of the luminances in it that are above 0 and finite, and their count.
uniform sampler2D picture;
uniform ivec2 grid;  // cells
layout(location = 0) out vec4 sum_and_count;

const int TAPS = 8;  // along each side of a cell at most

void main() {
  ivec2 size = textureSize(picture, 0);
  ivec2 cell = ivec2(gl_FragCoord.xy);
  ivec2 first = cell * size / grid, last = (cell + 1) * size / grid;
  ivec2 taps = min(last - first, ivec2(TAPS));
  float sum = 0.0, count = 0.0;
  for (int y = 0; y < TAPS; ++y) {
    for (int x = 0; x < TAPS; ++x) {
      if (x >= taps.x || y >= taps.y) continue;
      ivec2 at = first + ivec2(x, y) * (last - first) / taps;
      float luminance = dot(texelFetch(picture, at, 0).rgb, vec3(0.2126, 0.7152, 0.0722));
      if (luminance > 0.0 && luminance < 1e30) {
        sum += log2(luminance);
        count += 1.0;
      }
    }
  }
  sum_and_count = vec4(sum, count, 0.0, 1.0);
}

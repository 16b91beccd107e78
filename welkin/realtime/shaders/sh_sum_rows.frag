// Second stage: pixel i adds up the rows of coefficient i.
uniform sampler2D rows0, rows1, rows2, rows3;
uniform int height;
layout(location = 0) out vec4 coefficient;

void main() {
  int i = int(gl_FragCoord.x), group = i / 4, member = i % 4;
  vec3 sum = vec3(0.0);
  for (int y = 0; y < height; ++y) {
    ivec2 at = ivec2(group, y);
    sum += (member == 0 ? texelFetch(rows0, at, 0) : member == 1 ? texelFetch(rows1, at, 0)
            : member == 2 ? texelFetch(rows2, at, 0) : texelFetch(rows3, at, 0)).rgb;
  }
  coefficient = vec4(sum, 1.0);
}

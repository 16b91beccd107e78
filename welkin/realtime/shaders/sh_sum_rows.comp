// Second stage: invocation i adds up the rows of coefficient i.
layout(local_size_x = 16) in;
uniform int height, count;
layout(std430, binding = 1) readonly buffer Rows { vec4 rows[]; };
layout(rgba32f, binding = 0) uniform writeonly image2D coefficients;

void main() {
  int i = int(gl_GlobalInvocationID.x);
  if (i >= count) return;
  vec3 sum = vec3(0.0);
  for (int y = 0; y < height; ++y) sum += rows[i * height + y].rgb;
  imageStore(coefficients, ivec2(i, 0), vec4(sum, 1.0));
}

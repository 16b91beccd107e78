// Irradiance at each vertex: E(n) = (n, 1)^T M (n, 1) for each colour (Ramamoorthi & Hanrahan 2001, equation 11). It comes
// in two parts, of even and of odd degree, so that the fragment can have E(n) in front and E(-n) = even - odd behind.
#include "mesh_vertex.glsl"
uniform mat4 irradiance_matrix[3];  // red, green, blue
uniform mat3 world_to_environment;
out vec3 irradiance_even, irradiance_odd;

void main() {
  place_vertex();
  vec3 n = normalize(world_to_environment * world_normal);
  for (int c = 0; c < 3; ++c) {
    vec4 row = irradiance_matrix[c] * vec4(n, 1.0);
    vec3 linear = irradiance_matrix[c][3].xyz;  // the matrix is symmetric: half of the odd part
    irradiance_odd[c] = 2.0 * dot(linear, n);
    irradiance_even[c] = dot(row, vec4(n, 1.0)) - irradiance_odd[c];
  }
}

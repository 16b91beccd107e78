// The inputs and outputs of every vertex shader of meshes: call place_vertex() from main.
layout(location = 0) in vec3 vertex_position;
layout(location = 1) in vec3 vertex_normal;
layout(location = 2) in vec4 vertex_tangent;  // w: the sign of the bitangent
layout(location = 3) in vec4 vertex_texcoords;  // xy: set 0, zw: set 1

uniform mat4 to_world;
uniform mat3 normal_to_world;
uniform mat4 world_to_clip;

out vec3 world_position;
out vec3 world_normal;
out vec4 world_tangent;
out vec4 texcoords;

void place_vertex() {
  vec4 position = to_world * vec4(vertex_position, 1.0);
  world_position = position.xyz;
  world_normal = normal_to_world * vertex_normal;
  // In a mirrored mesh the cross product of the placed normal and tangent is the placed bitangent's negative.
  float side = determinant(mat3(to_world)) < 0.0 ? -1.0 : 1.0;
  world_tangent = vec4(mat3(to_world) * vertex_tangent.xyz, side * vertex_tangent.w);
  texcoords = vertex_texcoords;
  gl_Position = world_to_clip * position;
}

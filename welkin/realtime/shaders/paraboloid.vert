// Vertices to one of two paraboloids around a point (Heidrich & Seidel 1998; drawn as Brabec, Annen & Seidel 2002 do): only the vertices are mapped, lines between
// them stay straight, which is wrong for large triangles. Row 0 of the picture is b = 1, as the map's first row (welkin/sphere/mapping.h).
layout(location = 0) in vec3 vertex_position;
layout(location = 1) in vec3 vertex_normal;

uniform mat4 to_world;
uniform mat3 normal_to_world;
uniform vec3 eye_position;
uniform float paraboloid_side;          // 1: z >= 0; -1
uniform float near_metres, far_metres;

out vec3 world_position;
out vec3 world_normal;
out float ahead;

void main() {
  vec4 position = to_world * vec4(vertex_position, 1.0);
  world_position = position.xyz;
  world_normal = normal_to_world * vertex_normal;
  vec3 ray = position.xyz - eye_position;
  float distance_metres = max(length(ray), 1e-9);
  vec3 direction = ray / distance_metres;
  ahead = paraboloid_side * direction.z;
  vec2 place = direction.xy / max(1.0 + ahead, 1e-3);
  float depth = (distance_metres - near_metres) / (far_metres - near_metres);
  gl_Position = vec4(place.x, -place.y, 2.0 * depth - 1.0, 1.0);
}

// Faces of a cube as pictures: where a direction falls, s rightwards and t downwards in [-1, 1] (welkin/sphere/cube.h).
vec3 cube_ray(int face, vec2 at) {
  float s = at.x, t = at.y;
  return face == 0 ? vec3(1.0, -t, -s) : face == 1 ? vec3(-1.0, -t, s) : face == 2 ? vec3(s, 1.0, t)
       : face == 3 ? vec3(s, -1.0, -t) : face == 4 ? vec3(s, -t, 1.0) : vec3(-s, -t, -1.0);
}

// (s, t, face)
vec3 cube_place(vec3 d) {
  vec3 a = abs(d);
  if (a.x >= a.y && a.x >= a.z) return d.x > 0.0 ? vec3(-d.z / a.x, -d.y / a.x, 0.0) : vec3(d.z / a.x, -d.y / a.x, 1.0);
  if (a.y >= a.z) return d.y > 0.0 ? vec3(d.x / a.y, d.z / a.y, 2.0) : vec3(d.x / a.y, -d.z / a.y, 3.0);
  return d.z > 0.0 ? vec3(d.x / a.z, -d.y / a.z, 4.0) : vec3(-d.x / a.z, -d.y / a.z, 5.0);
}

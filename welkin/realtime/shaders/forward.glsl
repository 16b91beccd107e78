// The main of every technique's fragment shader: put it last, after `vec3 shade(Surface s)` (radiance towards the eye without
// the surface's own emission).
layout(location = 0) out vec4 radiance;   // alpha 1: a surface

void main() {
  Surface s = surface_of_fragment();
  radiance = vec4(shade(s) + s.emission, 1.0);
}

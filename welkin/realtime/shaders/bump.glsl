// The normals under a pixel. Include after surface.glsl, which must have been told to leave the normal map alone (SMOOTH_NORMAL): s.normal is
// the mesh's own then. Textures and what is in them: welkin/realtime/bump_maps.h.
uniform bool bump_present;         // else the material has no normal map
uniform sampler2D bump_slopes;     // E[s_x], E[s_y], E[s_x s_x], E[s_y s_y]
uniform sampler2D bump_shapes;     // E[s_x s_y]
uniform sampler2D bump_normals;    // E[n]
uniform vec2 bump_size;            // texels of level 0

// A normal of the tangent frame in the world, not yet turned to the viewer.
vec3 bumped_normal(vec3 in_frame, mat3 frame) {
  float side = gl_FrontFacing ? 1.0 : -1.0;
  return normalize(side * in_frame.x * frame[0] + side * in_frame.y * frame[1] + in_frame.z * frame[2]);
}

// What the surface sends to the eye when its glossy part reflects `reflected`, the average over a lobe of this roughness.
vec3 lit_surface(Surface s, vec3 normal, float perceptual_roughness, vec3 reflected) {
  vec2 dfg = look_up_dfg(clamp(dot(normal, s.view), 0.0, 1.0), perceptual_roughness);
  vec3 light = reflected_share(dfg, s.f0, s.f90, material_compensated) * reflected;
  if (s.diffuse != vec3(0.0)) light += coat_transmission(s, dfg) * s.diffuse / PI * irradiance(normal);
  return light;
}

// What screen-space occlusion knows of a scene: distance along the view axis, metres (0: nothing there), and the shading
// normal in the frame of the camera (x right, y up, z towards the eye).
#include "surface.glsl"
uniform mat4 world_to_view;
layout(location = 0) out float view_depth;
layout(location = 1) out vec4 view_normal;

void main() {
  Surface s = surface_of_fragment();
  view_depth = -(world_to_view * vec4(s.position, 1.0)).z;
  view_normal = vec4(mat3(world_to_view) * s.normal, 1.0);
}

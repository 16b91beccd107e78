// Vertices of a mesh to the world and to the screen.
#include "mesh_vertex.glsl"

void main() { place_vertex(); }

// One triangle that covers the viewport, on the far plane; uv is (0, 0) at its bottom left corner.
out vec2 uv;

void main() {
  uv = vec2(float((gl_VertexID << 1) & 2), float(gl_VertexID & 2));
  gl_Position = vec4(2.0 * uv - 1.0, 1.0, 1.0);
}

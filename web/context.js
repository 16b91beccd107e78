// The WebGL 2 context, or an Error that says to a reader what is missing.
const attributes = { alpha: false, antialias: false, depth: false, stencil: false, powerPreference: 'high-performance', preserveDrawingBuffer: false };

export function makeContext(canvas) {
  const gl = canvas.getContext('webgl2', attributes);
  if (!gl) throw new Error('This page draws with WebGL 2, which this browser does not offer here. A current Chrome, Edge, Firefox or Safari has it; graphics acceleration may be switched off in the settings.');
  enableExtensions(gl);
  return gl;
}

// Also after a lost context came back: extensions go with it.
export function enableExtensions(gl) {
  if (!gl.getExtension('EXT_color_buffer_float'))
    throw new Error('This page draws light into textures of floats, which this device does not offer (EXT_color_buffer_float is missing).');
  for (const name of ['OES_texture_float_linear', 'EXT_float_blend', 'EXT_disjoint_timer_query_webgl2']) gl.getExtension(name);
}

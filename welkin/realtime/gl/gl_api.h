#pragma once
// OpenGL ES as every file of realtime sees it. What WebGL 2 lacks (compute shaders, ES 3.1) is declared natively only.
#ifdef __EMSCRIPTEN__
#include <GLES3/gl3.h>
#else
#include <GLES3/gl31.h>
#endif

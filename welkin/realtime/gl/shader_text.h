#pragma once
#include <string>
#include <string_view>

namespace welkin {

/// Every file of welkin/realtime/shaders is in the library. The text of one with its lines `#include "other.glsl"`
/// replaced by that file, each file once, and without a #version line. Throws Error for a name that is not there.
std::string shader_text(std::string_view file);

/// What stands before every shader: #version 300 es (or 310 es, for compute shaders) and highp for everything.
std::string_view shader_head(bool compute = false);

}  // namespace welkin

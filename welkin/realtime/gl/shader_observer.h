#pragma once
#include <string>
#include <string_view>

namespace welkin {

/// Told each shader before it is compiled: its file and the whole text, head, defines and includes in it. For programs that show or check
/// shaders; nullptr ends it. One in the process, not for several threads.
using ShaderObserver = void (*)(std::string_view file, const std::string& text);
void observe_shaders(ShaderObserver observer);

}  // namespace welkin

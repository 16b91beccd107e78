#pragma once

#include <string_view>

#include <welkin/realtime/technique.h>

namespace welkin {

/// "unshadowed", ...
std::string_view truth_name(Truth truth);

/// Prints all techniques of the real-time renderer, for people or as JSON.
void list_techniques(bool json);

}  // namespace welkin

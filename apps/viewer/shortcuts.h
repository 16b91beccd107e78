#pragma once
#include <span>

#include "session.h"

namespace welkin {

struct Shortcut {
  const char *keys, *meaning;
};
/// What the help shows: all keys and mouse movements.
std::span<const Shortcut> shortcuts();

/// What keys change beside the session.
struct WindowState {
  bool panel = true, help = false, quit = false;
  bool dragging_split = false;
};

/// Takes the keys and the mouse of ImGui's frame that no control wants. The picture's rectangle is in points.
void take_input(Session& session, WindowState& window, float picture_x, float picture_width,
                float picture_height);

}  // namespace welkin

#pragma once
#include "session.h"

namespace welkin {

/// The controls, in a column at the left of the window, so many points wide. Everything it shows is made from the techniques' tables.
void draw_panel(Session& session, float width, float height);

inline constexpr float panel_width = 330;

}  // namespace welkin

#pragma once
#include "session.h"

namespace welkin {

/// A rectangle of the window in points, from the top left.
struct Area {
  float x = 0, y = 0, width = 0, height = 0;
};

/// The colours of a difference with their values, at the bottom of the picture; nothing while none is shown.
void draw_legend(const Session& session, const Area& picture);
/// What is being loaded, and the line there is to say.
void draw_status(const Session& session, const Area& picture);
/// Names at both sides of a split.
void draw_split_names(const Session& session, const Area& picture);
/// Keys and mouse; `open` becomes false when it is closed.
void draw_help(bool& open, const Area& picture);

}  // namespace welkin

#pragma once
#include <string>
#include <string_view>
#include <vector>

#include <welkin/sh/forms/document.h>

// Private to sh/forms: the lights beside the coefficients, as comment lines and as JSON, in the form's axes.

namespace welkin {

inline constexpr std::string_view light_marker = "welkin-light: ";
inline constexpr std::string_view lights_follow = "; lights that follow: ";

/// One line of comment a light, and one that says what to do with them; nothing when there is none.
std::string light_lines(const std::vector<ShLight>& lights, ShForm form, std::string_view sign);

/// The lights of all such lines of a text. Throws Error naming `name` for a damaged one, and where a number of
/// lights is promised (lights_follow) and others are there.
std::vector<ShLight> lights_in(std::string_view text, ShForm form, std::string_view name);

/// Our axes to those of the form, or back.
ShLight turned(const ShLight& light, ShForm form);
ShLight turned_back(const ShLight& light, ShForm form);

/// Throws Error naming `name` unless the direction is of unit length to 1e-3 and the rest finite and >= 0; a direction
/// within that is made unit.
ShLight checked(ShLight light, std::string_view name);

}  // namespace welkin

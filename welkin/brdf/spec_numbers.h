#pragma once
#include <optional>
#include <string_view>
#include <vector>

// The parts of a BRDF's text form (brdf_spec.h): private to welkin/brdf.

namespace welkin {

/// The parts between separators; an empty text is one empty part.
std::vector<std::string_view> split_spec(std::string_view text, char separator);

/// A finite number that takes the whole text; nothing for anything else.
std::optional<double> spec_number(std::string_view text);

}  // namespace welkin

#pragma once
#include <string>

namespace welkin {

/// What a written file says it was made of: the sky, or the input file's name alone, not where that was on the disk.
std::string source_name(const std::string& input);

}  // namespace welkin

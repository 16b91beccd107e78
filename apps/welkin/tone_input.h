#pragma once
#include <CLI/CLI.hpp>
#include <string>

#include <welkin/image/tonemap.h>

namespace welkin {

/// --exposure and --curve of the commands that write a picture to look at.
void add_tone_options(CLI::App& sub, std::string& exposure, std::string& curve);

/// Throws CLI::ValidationError for an exposure that is neither auto nor a number of stops.
ToneMapOptions parse_tone(const std::string& exposure, const std::string& curve);

}  // namespace welkin

#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include <welkin/image/output_file.h>
#include <welkin/image/tonemap.h>
#include <welkin/pathtrace/picture.h>

#include "render_options.h"

namespace welkin {

/// FILE.png and FILE.exr.state beside FILE.exr.
std::string picture_name(const std::string& exr);
std::string state_name(const std::string& exr);

/// Throws CLI::ValidationError or Error, before any work, for names that cannot be written.
void check_render_output(const RenderCommand& command);

ToneMapOptions tone_options(const RenderCommand& command);

/// The layered OpenEXR (docs/rendering.md) and the PNG of what a picture has so far.
std::vector<OutputFile> render_files(const RenderCommand& command, const PictureState& state);

}  // namespace welkin

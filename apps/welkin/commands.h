#pragma once
#include <CLI/CLI.hpp>

// The subcommands of `welkin`, one file each. Each declares its options on `app` and runs in a callback; whatever it
// throws is printed as one line by main.

namespace welkin {

void add_brdf_command(CLI::App& app);
void add_compare_command(CLI::App& app);
void add_convert_command(CLI::App& app);
void add_filter_command(CLI::App& app);
void add_frame_command(CLI::App& app);
void add_ibl_command(CLI::App& app);
void add_info_command(CLI::App& app);
void add_reflect_command(CLI::App& app);
void add_render_command(CLI::App& app);
void add_sampling_command(CLI::App& app);
void add_scene_command(CLI::App& app);
void add_sh_command(CLI::App& app);
void add_sky_command(CLI::App& app);
void add_view_command(CLI::App& app);

}  // namespace welkin

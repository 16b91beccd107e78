#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "commands.h"
#include "flat_file.h"

#include <welkin/envmap/sky/sky.h>
#include <welkin/error.h>
#include <welkin/image/output_file.h>

// welkin sky: writes a built-in environment. Every option is a key of the library's text form, so that
// `welkin sky --kind day --elevation 10 -o a.hdr` and the input `sky:day,elevation=10` are the same map.

namespace welkin {
namespace {

struct SkyCommand {
  std::string kind = "day";
  std::string output;
  std::vector<std::pair<std::string, std::string>> keys;  // name, value; an empty value was not given
  bool no_sun = false;
};

// Whatever the library refuses here was said on the command line.
Image make(const std::string& spec) {
  try {
    return make_sky(parse_sky(spec));
  } catch (const Error& error) {
    throw CLI::ValidationError(error.what());
  }
}

void run(const SkyCommand& command) {
  check_flat_name(command.output);
  std::string spec = "sky:" + command.kind;
  for (const auto& [key, value] : command.keys)
    if (!value.empty()) spec += "," + key + "=" + value;
  if (command.no_sun) spec += ",sun=0";
  write_file(command.output, encode_flat(command.output, make(spec)));
}

}  // namespace

void add_sky_command(CLI::App& app) {
  const std::vector<std::pair<std::string, std::string>> keys{
      {"size", "Width x height, 1024x512"},
      {"elevation", "Of the sun, degrees above the horizon (day, overcast)"},
      {"azimuth", "Of the sun, degrees from +X (the middle column) rightwards (day)"},
      {"turbidity", "1.7 very clear to 10 hazy (day)"},
      {"albedo", "Of the ground, 0 to 1 (day, overcast)"},
      {"value", "Radiance, one number or R:G:B (constant, texel, ramp, sh)"},
      {"x", "Column of the lit texel, -1 for the middle (texel)"},
      {"y", "Row of the lit texel, -1 for the middle (texel)"},
      {"offset", "Added before scaling by value (ramp, sh)"},
      {"slope", "Times the cosine from +Y (ramp)"},
      {"degree", "l of Y_lm (sh)"},
      {"order", "m of Y_lm (sh)"},
      {"scale", "Multiplies everything"}};
  auto command = std::make_shared<SkyCommand>();
  for (const auto& key : keys) command->keys.emplace_back(key.first, "");
  CLI::App* sub = app.add_subcommand("sky", "Write a built-in environment as an equirectangular map");
  sub->add_option("--kind", command->kind, "What to make")
      ->check(CLI::IsMember({"day", "studio", "overcast", "constant", "texel", "ramp", "sh", "labelled"}))
      ->capture_default_str();
  for (std::size_t i = 0; i < keys.size(); ++i)
    sub->add_option("--" + keys[i].first, command->keys[i].second, keys[i].second);
  sub->add_flag("--no-sun", command->no_sun, "Leave the sun's disc out (day)");
  sub->add_option("-o,--output", command->output, "File to write: .hdr, .exr or .png")->required();
  sub->footer(
      "Example: welkin sky --kind day --elevation 10 --size 2048x1024 -o day.hdr\n\nOther commands take as "
      "INPUT " +
      sky_spec_help());
  sub->callback([command] { run(*command); });
}

}  // namespace welkin

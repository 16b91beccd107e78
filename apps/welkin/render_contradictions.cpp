#include <fmt/format.h>

#include <string_view>
#include <vector>

#include "render_options.h"

namespace welkin {
namespace {

// Refuses the first of these options that was given.
void refuse(const CLI::App& sub, const std::vector<const char*>& options, std::string_view reason) {
  for (const char* option : options)
    if (sub.count(option) > 0) throw CLI::ValidationError(option, std::string(reason));
}

void check_comparison(const CLI::App& sub, const RenderCommand& command) {
  refuse(sub, {"--error", "--resume", "--keep-state", "--watch", "--state-every"},
         "does not go with --sampling compare, which renders from start to end with --spp");
  refuse(sub, {"--bounces", "--clamp", "--heuristic"}, "has no effect on --sampling compare");
  if (sub.count("--integrator") > 0 && command.integrator != "direct")
    throw CLI::ValidationError("--integrator", "is direct for --sampling compare");
}

void check_integrator(const CLI::App& sub, const RenderCommand& command) {
  const std::string& integrator = command.integrator;
  const std::string reason = fmt::format("has no effect on --integrator {}", integrator);
  if (integrator != "ao") refuse(sub, {"--ao-distance"}, reason);
  if (integrator != "direct") refuse(sub, {"--no-shadows"}, reason);
  if (integrator != "path") refuse(sub, {"--bounces", "--clamp"}, reason);
  if (integrator == "ao" || integrator == "ibl") refuse(sub, {"--sampling", "--heuristic"}, reason);
}

}  // namespace

void check_contradictions(const CLI::App& sub, const RenderCommand& command) {
  if (command.sampling == "compare") {
    check_comparison(sub, command);
  } else {
    check_integrator(sub, command);
    if (command.sampling == "bsdf" || command.sampling == "light")
      refuse(sub, {"--heuristic"}, fmt::format("has no effect on --sampling {}", command.sampling));
  }
  if (sub.count("--error") == 0) refuse(sub, {"--min-spp", "--max-spp"}, "is for --error");
  if (sub.count("--min-spp") > 0 && command.least_samples > command.most_samples)
    throw CLI::ValidationError("--min-spp", "is above --max-spp");
  if (command.environment == "none")
    refuse(sub, {"--env-mapping", "--env-rotate", "--env-mirror"}, "has no effect on --env none");
}

}  // namespace welkin

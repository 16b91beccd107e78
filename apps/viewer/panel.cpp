#include "panel.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <imgui/imgui.h>

#include <welkin/scene/built_in.h>

namespace welkin {
namespace {

std::string text_of(std::string_view view) { return std::string(view); }

void explain(std::string_view text) {
  if (!ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 28);
  ImGui::TextUnformatted(text.data(), text.data() + text.size());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

template <class Names>
bool combo(const char* label, int& chosen, const Names& names) {
  bool changed = false;
  const std::string shown = text_of(names[static_cast<std::size_t>(chosen)]);
  if (!ImGui::BeginCombo(label, shown.c_str())) return false;
  for (std::size_t i = 0; i < std::size(names); ++i) {
    const bool selected = static_cast<int>(i) == chosen;
    if (ImGui::Selectable(text_of(names[i]).c_str(), selected) && !selected) {
      chosen = static_cast<int>(i);
      changed = true;
    }
  }
  ImGui::EndCombo();
  return changed;
}

void parameter_control(const Parameter& p, float& value) {
  const std::string name = text_of(p.name);
  if (!p.choices.empty()) {
    int chosen = std::clamp(static_cast<int>(value), 0, static_cast<int>(p.choices.size()) - 1);
    if (combo(name.c_str(), chosen, p.choices)) value = static_cast<float>(chosen);
  } else if (p.whole && p.minimum == 0 && p.maximum == 1) {
    bool on = value != 0;
    if (ImGui::Checkbox(name.c_str(), &on)) value = on ? 1.0f : 0.0f;
  } else if (p.whole) {
    int whole = static_cast<int>(std::lround(value));
    if (ImGui::SliderInt(name.c_str(), &whole, static_cast<int>(p.minimum), static_cast<int>(p.maximum), "%d",
                         ImGuiSliderFlags_AlwaysClamp))
      value = static_cast<float>(whole);
  } else {
    const bool wide = p.minimum > 0 && p.maximum / p.minimum >= 1000;
    ImGui::SliderFloat(name.c_str(), &value, p.minimum, p.maximum, "%.3g",
                       ImGuiSliderFlags_AlwaysClamp | (wide ? ImGuiSliderFlags_Logarithmic : 0));
  }
  explain(p.meaning);
}

void technique_controls(const char* label, TechniqueChoice& choice) {
  if (choice.technique == nullptr) return;
  ImGui::PushID(label);
  if (ImGui::BeginCombo(label, text_of(choice.technique->name).c_str(), ImGuiComboFlags_HeightLarge)) {
    for (const TechniqueInfo& technique : techniques()) {
      if (ImGui::Selectable(text_of(technique.name).c_str(), &technique == choice.technique) &&
          &technique != choice.technique)
        choose_technique(choice, technique);
      explain(fmt::format("{}\n({})", technique.summary, technique.source));
    }
    ImGui::EndCombo();
  }
  for (std::size_t i = 0; i < choice.technique->parameters.size() && i < choice.values.size(); ++i)
    parameter_control(choice.technique->parameters[i], choice.values[i]);
  if (!choice.values.empty() && ImGui::SmallButton("defaults")) choose_technique(choice, *choice.technique);
  ImGui::PopID();
}

std::string short_name(const std::string& name) {
  const std::string last = std::filesystem::path(name).filename().string();
  return last.empty() ? name : last;
}

void scene_section(Session& session) {
  if (ImGui::BeginCombo("scene", short_name(session.scene_name()).c_str(), ImGuiComboFlags_HeightLarge)) {
    for (const BuiltInScene& scene : built_in_scenes()) {
      const std::string name = text_of(scene.name);
      if (ImGui::Selectable(name.c_str(), name == session.scene_name())) session.load(LoadKind::scene, name);
      explain(scene.description);
    }
    ImGui::EndCombo();
  }
  if (ImGui::BeginCombo("light", short_name(session.environment_name()).c_str())) {
    if (ImGui::Selectable("sky:", session.environment_name() == "sky:"))
      session.load(LoadKind::environment, "sky:");
    ImGui::EndCombo();
  }
  ImGui::TextDisabled("or drop .glb .obj .ply .hdr .exr here");
  ViewerState& state = session.viewer.state;
  ImGui::SliderFloat("rotation", &state.rotation_degrees, -180, 180, "%.0f deg");
  ImGui::Checkbox("background", &state.background);
  ImGui::SameLine();
  ImGui::Checkbox("animate", &state.animate);
  ImGui::SameLine();
  ImGui::TextDisabled("%.1f s", state.time_seconds);
}

void numbers_section(const Session& session) {
  const Viewer& viewer = session.viewer;
  if (viewer.state.reference == ReferenceKind::truth) {
    const Session::TruthStatus truth = session.truth_status();
    if (truth.stored)
      ImGui::TextUnformatted("truth: the file, for the first view");
    else if (truth.samples > 0)
      ImGui::Text("truth: %.0f samples%s, itself off by %.2g %%", truth.samples, truth.busy ? " so far" : "",
                  100 * truth.relative_error);
    else
      ImGui::TextUnformatted("truth: is being traced");
  }
  const std::optional<DifferenceNumbers>& n = viewer.numbers();
  if (!n) return;
  ImGui::Text("mean %+.4g   RMS %.4g", n->mean, n->rms);
  ImGui::Text("p99 %.4g   largest %.4g", n->p99, n->largest);
  ImGui::Text("RMS / reference %.3g %%", 100 * n->relative_rms);
  explain("Radiance, over the pixels that show a surface in both pictures");
  if (n->faults > 0) ImGui::Text("%zu pixels are not finite", n->faults);
}

void compare_section(Session& session) {
  ViewerState& state = session.viewer.state;
  int mode = static_cast<int>(state.comparison), kind = static_cast<int>(state.reference);
  if (combo("show", mode, comparison_names)) state.comparison = static_cast<Comparison>(mode);
  if (combo("against", kind, reference_names)) {
    state.reference = static_cast<ReferenceKind>(kind);
    if (state.comparison == Comparison::picture) state.comparison = Comparison::split;
  }
  if (state.reference == ReferenceKind::technique) technique_controls("other", state.reference_technique);
  if (state.comparison == Comparison::split) ImGui::SliderFloat("split", &state.split, 0, 1, "%.2f");
  if (shows_difference(state.comparison)) {
    bool automatic = state.difference_scale <= 0;
    if (ImGui::Checkbox("scale fits p99", &automatic))
      state.difference_scale = automatic ? 0.0f : static_cast<float>(session.viewer.difference_scale());
    if (!automatic)
      ImGui::SliderFloat("scale", &state.difference_scale, 1e-5f, 1e3f, "%.3g", ImGuiSliderFlags_Logarithmic);
  }
  if (state.comparison != Comparison::picture) numbers_section(session);
}

void display_section(Viewer& viewer) {
  ViewerState& state = viewer.state;
  int curve = static_cast<int>(state.curve);
  ImGui::Checkbox("automatic", &state.automatic_exposure);
  ImGui::SameLine();
  ImGui::TextDisabled("%+.2f stops in all", static_cast<double>(viewer.exposure_ev()));
  ImGui::SliderFloat("exposure", &state.exposure_ev, -12, 12, "%+.2f stops");
  if (combo("curve", curve, curve_names)) state.curve = static_cast<ToneCurve>(curve);
  if (state.curve == ToneCurve::reinhard)
    ImGui::SliderFloat("white", &state.white, 0.5f, 1000, "%.3g", ImGuiSliderFlags_Logarithmic);
}

void time_section(Viewer& viewer) {
  PassTimer& timer = viewer.renderer().timer();
  ImGui::Checkbox("time the passes", &timer.enabled);
  if (!timer.enabled) return;
  ImGui::TextDisabled(timer.mode == TimerMode::queries ? "by the GPU's clock"
                                                       : "by the clock, between two glFinish");
  double sum = 0;
  for (const PassTime& pass : viewer.passes()) {
    ImGui::Text("%*s%s", 2 * pass.depth, "", pass.name.c_str());
    ImGui::SameLine(ImGui::GetWindowWidth() - 7 * ImGui::GetFontSize());
    ImGui::Text("%8.3f ms", pass.milliseconds);
    if (pass.depth == 0) sum += pass.milliseconds;
  }
  ImGui::Text("sum");
  ImGui::SameLine(ImGui::GetWindowWidth() - 7 * ImGui::GetFontSize());
  ImGui::Text("%8.3f ms", sum);
}

}  // namespace

void draw_panel(Session& session, float width, float height) {
  ImGui::SetNextWindowPos({0, 0});
  ImGui::SetNextWindowSize({width, height});
  ImGui::Begin("welkin", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings);
  ImGui::PushItemWidth(0.62f * width);
  const ImGuiTreeNodeFlags open = ImGuiTreeNodeFlags_DefaultOpen;
  if (ImGui::CollapsingHeader("Scene and light", open)) scene_section(session);
  if (ImGui::CollapsingHeader("Technique", open)) {
    TechniqueChoice& choice = session.viewer.state.technique;
    technique_controls("name", choice);
    if (choice.technique != nullptr) {
      ImGui::TextWrapped("%s", text_of(choice.technique->summary).c_str());
      ImGui::TextDisabled("%s", text_of(choice.technique->source).c_str());
    }
  }
  if (ImGui::CollapsingHeader("Compare", open)) compare_section(session);
  if (ImGui::CollapsingHeader("Tone", open)) display_section(session.viewer);
  if (ImGui::CollapsingHeader("Time")) time_section(session.viewer);
  ImGui::Separator();
  if (ImGui::Button("frame (R)"))
    session.viewer.state.camera = frame_scene(session.viewer.renderer().scene());
  ImGui::SameLine();
  if (ImGui::Button("save (P)")) session.save_picture();
  ImGui::SameLine();
  ImGui::TextDisabled("F1: keys");
  ImGui::PopItemWidth();
  ImGui::End();
}

}  // namespace welkin

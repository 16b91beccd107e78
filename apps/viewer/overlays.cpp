#include "overlays.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>
#include <imgui/imgui.h>

#include "shortcuts.h"

namespace welkin {
namespace {

constexpr ImGuiWindowFlags fixed_window =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
    ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_AlwaysAutoResize;

ImU32 packed(Rgb c) { return ImGui::ColorConvertFloat4ToU32({c.r, c.g, c.b, 1}); }

std::string reference_name(const Session& session) {
  const ViewerState& state = session.viewer.state;
  if (state.reference == ReferenceKind::technique)
    return state.reference_technique.technique == nullptr
               ? ""
               : std::string(state.reference_technique.technique->name);
  const Session::TruthStatus truth = session.truth_status();
  return truth.stored ? "stored truth" : fmt::format("truth, {:.0f} samples", truth.samples);
}

}  // namespace

void draw_legend(const Session& session, const Area& picture) {
  const Viewer& viewer = session.viewer;
  if (!shows_difference(viewer.state.comparison) || !viewer.has_reference()) return;
  const bool with_sign = viewer.state.comparison == Comparison::signed_difference;
  const ColorScale& colors = with_sign ? signed_colors() : size_colors();
  const float line = ImGui::GetTextLineHeight(), width = std::clamp(0.6f * picture.width, 120.0f, 480.0f);
  const float left = picture.x + 0.5f * (picture.width - width), bar = 0.8f * line;
  const float top = picture.y + picture.height - 3.6f * line;
  ImDrawList& list = *ImGui::GetForegroundDrawList();
  list.AddRectFilled({left - 2 * line, top - 1.4f * line}, {left + width + 2 * line, top + bar + 1.5f * line},
                     IM_COL32(0, 0, 0, 170), 4);
  for (int i = 0; i + 1 < color_stops; ++i) {
    const float a = left + width * static_cast<float>(i) / (color_stops - 1);
    const float b = left + width * static_cast<float>(i + 1) / (color_stops - 1);
    const ImU32 from = packed(colors[static_cast<std::size_t>(i)]);
    const ImU32 to = packed(colors[static_cast<std::size_t>(i) + 1]);
    list.AddRectFilledMultiColor({a, top}, {b, top + bar}, from, to, to, from);
  }
  list.AddRect({left, top}, {left + width, top + bar}, IM_COL32(255, 255, 255, 120));
  const auto centred = [&](float x, float y, const std::string& text) {
    const float half = 0.5f * ImGui::CalcTextSize(text.c_str()).x;
    list.AddText({x - half, y}, IM_COL32_WHITE, text.c_str());
  };
  centred(left + 0.5f * width, top - 1.2f * line,
          with_sign ? "picture - reference, luminance, W/(sr m2)"
                    : "|picture - reference|, largest channel, W/(sr m2)");
  for (const LegendMark& mark : legend_marks(viewer.difference_scale(), with_sign))
    centred(left + width * mark.position, top + bar + 0.2f * line,
            fmt::format("{}{:.3g}", with_sign && mark.value > 0 ? "+" : "", mark.value));
}

void draw_split_names(const Session& session, const Area& picture) {
  const Viewer& viewer = session.viewer;
  if (viewer.state.comparison != Comparison::split || !viewer.has_reference()) return;
  ImDrawList& list = *ImGui::GetForegroundDrawList();
  const float at = picture.x + viewer.state.split * picture.width, pad = 0.5f * ImGui::GetTextLineHeight();
  const std::string left(viewer.state.technique.technique->name), right = reference_name(session);
  const auto label = [&](float x, const std::string& text) {
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    list.AddRectFilled({x - pad, picture.y + pad}, {x + size.x + pad, picture.y + 2 * pad + size.y},
                       IM_COL32(0, 0, 0, 150), 4);
    list.AddText({x, picture.y + 1.5f * pad}, IM_COL32_WHITE, text.c_str());
  };
  label(at - 2 * pad - ImGui::CalcTextSize(left.c_str()).x, left);
  label(at + 2 * pad, right);
}

void draw_status(const Session& session, const Area& picture) {
  const std::optional<Loader::Work> work = session.work();
  const Session::Message& message = session.message();
  if (!work && message.seconds_left <= 0) return;
  const float line = ImGui::GetTextLineHeight();
  ImGui::SetNextWindowPos({picture.x + line, picture.y + line});
  ImGui::SetNextWindowSizeConstraints({0, 0}, {std::max(60.0f, picture.width - 2 * line), 1e4f});
  ImGui::SetNextWindowBgAlpha(0.85f);
  ImGui::Begin("##status", nullptr, fixed_window);
  ImGui::PushTextWrapPos(std::max(60.0f, picture.width - 3 * line));
  if (work) {
    ImGui::TextUnformatted(work->text.c_str());
    ImGui::ProgressBar(static_cast<float>(work->share), {std::min(20 * line, picture.width - 3 * line), 0});
  }
  if (message.seconds_left > 0)
    ImGui::TextColored(message.is_error ? ImVec4(1, 0.55f, 0.45f, 1) : ImVec4(1, 1, 1, 1), "%s",
                       message.text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::End();
}

void draw_help(bool& open, const Area& picture) {
  if (!open) return;
  ImGui::SetNextWindowPos({picture.x + 0.5f * picture.width, picture.y + 0.5f * picture.height}, 0,
                          {0.5f, 0.5f});
  ImGui::SetNextWindowBgAlpha(0.92f);
  ImGui::Begin(
      "Keys and mouse", &open,
      ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoCollapse);
  for (const Shortcut& shortcut : shortcuts()) {
    ImGui::TextColored({1, 0.85f, 0.4f, 1}, "%s", shortcut.keys);
    ImGui::SameLine(12.5f * ImGui::GetFontSize());
    ImGui::TextUnformatted(shortcut.meaning);
  }
  ImGui::End();
}

}  // namespace welkin

#include "shortcuts.h"

#include <algorithm>
#include <cmath>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui/imgui.h>

namespace welkin {

std::span<const Shortcut> shortcuts() {
  static constexpr Shortcut all[] = {
      {"drag", "turn about the scene"},
      {"right or Shift drag", "move"},
      {"wheel, + and -", "nearer, farther"},
      {"Ctrl drag, , and .", "rotate the light"},
      {"arrows", "turn by a little"},
      {"R", "frame the scene"},
      {"T, Shift T", "next, previous technique"},
      {"1 2 3", "picture, reference, split"},
      {"4 5", "difference: signed, size"},
      {"V", "against the truth or a technique"},
      {"X", "swap technique and reference"},
      {"A", "automatic exposure"},
      {"[ and ]", "a third of a stop darker, brighter"},
      {"C", "next tone curve"},
      {"B", "background"},
      {"Space", "animation"},
      {"P", "save the picture"},
      {"Tab", "panel"},
      {"F1, Esc", "this list"},
      {"Ctrl Q", "quit"},
  };
  return all;
}

namespace {

bool pressed(int key) { return ImGui::IsKeyPressed(key, true); }
bool pressed_once(int key) { return ImGui::IsKeyPressed(key, false); }

void next_technique(TechniqueChoice& choice, int step) {
  const auto all = techniques();
  int at = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (&all[i] == choice.technique) at = static_cast<int>(i);
  const int count = static_cast<int>(all.size());
  choose_technique(choice, all[static_cast<std::size_t>((at + step + count) % count)]);
}

void camera_keys(ViewerState& state, const Viewer& viewer) {
  constexpr float step = 0.02f;
  OrbitCamera& camera = state.camera;
  if (pressed(GLFW_KEY_LEFT)) orbit(camera, {step, 0});
  if (pressed(GLFW_KEY_RIGHT)) orbit(camera, {-step, 0});
  if (pressed(GLFW_KEY_UP)) orbit(camera, {0, -step});
  if (pressed(GLFW_KEY_DOWN)) orbit(camera, {0, step});
  if (pressed(GLFW_KEY_EQUAL) || pressed(GLFW_KEY_KP_ADD)) zoom(camera, 0.9f);
  if (pressed(GLFW_KEY_MINUS) || pressed(GLFW_KEY_KP_SUBTRACT)) zoom(camera, 1 / 0.9f);
  if (pressed(GLFW_KEY_COMMA)) state.rotation_degrees = std::remainder(state.rotation_degrees - 5, 360.0f);
  if (pressed(GLFW_KEY_PERIOD)) state.rotation_degrees = std::remainder(state.rotation_degrees + 5, 360.0f);
  if (pressed_once(GLFW_KEY_R) && viewer.has_scene()) camera = frame_scene(viewer.renderer().scene());
}

void comparison_keys(ViewerState& state) {
  for (int i = 0; i < 5; ++i)
    if (pressed_once(GLFW_KEY_1 + i)) state.comparison = static_cast<Comparison>(i);
  if (pressed_once(GLFW_KEY_V))
    state.reference =
        state.reference == ReferenceKind::truth ? ReferenceKind::technique : ReferenceKind::truth;
  if (pressed_once(GLFW_KEY_X)) std::swap(state.technique, state.reference_technique);
  if (pressed_once(GLFW_KEY_T)) next_technique(state.technique, ImGui::GetIO().KeyShift ? -1 : 1);
}

void display_keys(ViewerState& state) {
  if (pressed_once(GLFW_KEY_A)) state.automatic_exposure = !state.automatic_exposure;
  if (pressed(GLFW_KEY_LEFT_BRACKET)) state.exposure_ev -= 1 / 3.0f;
  if (pressed(GLFW_KEY_RIGHT_BRACKET)) state.exposure_ev += 1 / 3.0f;
  if (pressed_once(GLFW_KEY_C)) state.curve = static_cast<ToneCurve>((static_cast<int>(state.curve) + 1) % 3);
  if (pressed_once(GLFW_KEY_B)) state.background = !state.background;
  if (pressed_once(GLFW_KEY_SPACE)) state.animate = !state.animate;
}

void window_keys(Session& session, WindowState& window) {
  if (pressed_once(GLFW_KEY_TAB)) window.panel = !window.panel;
  if (pressed_once(GLFW_KEY_F1)) window.help = !window.help;
  if (pressed_once(GLFW_KEY_ESCAPE)) window.help = false;
  if (pressed_once(GLFW_KEY_P)) session.save_picture();
}

void mouse(ViewerState& state, WindowState& window, float x, float width, float height) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.MouseWheel != 0) zoom(state.camera, std::pow(0.9f, io.MouseWheel));
  const float divider = x + state.split * width;
  if (ImGui::IsMouseClicked(0))
    window.dragging_split = state.comparison == Comparison::split && std::abs(io.MousePos.x - divider) < 8;
  if (!ImGui::IsMouseDown(0)) window.dragging_split = false;
  const Vec2f drag{io.MouseDelta.x / height, -io.MouseDelta.y / height};
  if (drag.x == 0 && drag.y == 0) return;
  const bool left = ImGui::IsMouseDown(0), other = ImGui::IsMouseDown(1) || ImGui::IsMouseDown(2);
  if (window.dragging_split)
    state.split = std::clamp((io.MousePos.x - x) / std::max(width, 1.0f), 0.0f, 1.0f);
  else if (other || (left && io.KeyShift))
    pan(state.camera, drag);
  else if (left && io.KeyCtrl)
    state.rotation_degrees = std::remainder(state.rotation_degrees + 180 * drag.x, 360.0f);
  else if (left)
    orbit(state.camera, drag);
}

}  // namespace

void take_input(Session& session, WindowState& window, float picture_x, float picture_width,
                float picture_height) {
  const ImGuiIO& io = ImGui::GetIO();
  ViewerState& state = session.viewer.state;
  if (io.KeyCtrl && pressed_once(GLFW_KEY_Q)) window.quit = true;
  if (!io.WantTextInput) {
    window_keys(session, window);
    camera_keys(state, session.viewer);
    comparison_keys(state);
    display_keys(state);
  }
  if (!io.WantCaptureMouse && picture_height > 0)
    mouse(state, window, picture_x, picture_width, picture_height);
}

}  // namespace welkin

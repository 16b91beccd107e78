#include <fmt/format.h>

#include <string>
#include <string_view>

#include <welkin/realtime/viewer/viewer_state.h>
#include <welkin/scene/built_in.h>

#include "web_calls.h"

// The tables that the page makes its controls from, as JSON.

namespace welkin {
namespace {

std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return result + '"';
}

template <class Range, class Entry>
std::string list(const Range& range, const Entry& entry) {
  std::string result = "[";
  for (const auto& item : range) {
    if (result.size() > 1) result += ',';
    result += entry(item);
  }
  return result + ']';
}

std::string parameter_json(const Parameter& p) {
  return fmt::format(
      R"({{"name":{},"meaning":{},"minimum":{},"maximum":{},"initial":{},"whole":{},"choices":{}}})",
      quoted(p.name), quoted(p.meaning), p.minimum, p.maximum, p.initial, p.whole, list(p.choices, quoted));
}

std::string technique_json(const TechniqueInfo& t) {
  return fmt::format(R"({{"name":{},"summary":{},"source":{},"parameters":{}}})", quoted(t.name),
                     quoted(t.summary), quoted(t.source), list(t.parameters, parameter_json));
}

std::string scene_json(const BuiltInScene& s) {
  return fmt::format(R"({{"name":{},"description":{}}})", quoted(s.name), quoted(s.description));
}

}  // namespace
}  // namespace welkin

extern "C" {

EMSCRIPTEN_KEEPALIVE const char* welkin_tables() {
  using namespace welkin;
  return give_text(fmt::format(R"({{"techniques":{},"scenes":{},"comparisons":{},"curves":{}}})",
                               list(techniques(), technique_json), list(built_in_scenes(), scene_json),
                               list(comparison_names, quoted), list(curve_names, quoted)));
}
}

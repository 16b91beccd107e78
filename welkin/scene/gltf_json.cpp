#include <welkin/scene/gltf_json.h>

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>

#include <welkin/error.h>

namespace welkin {
namespace {

constexpr int max_depth = 64;  // glTF itself needs about ten

const nlohmann::json& json(const void* value) { return *static_cast<const nlohmann::json*>(value); }

bool is_too_deep(std::string_view text) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '\\') ++i;
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    depth += c == '{' || c == '[' ? 1 : c == '}' || c == ']' ? -1 : 0;
    if (depth > max_depth) return true;
  }
  return false;
}

// One line, printable: the parser quotes what it last read.
std::string one_line(std::string_view message) {
  std::string line;
  for (char c : message.substr(0, 200)) line += c >= ' ' && c <= '~' ? c : '?';
  return line;
}

}  // namespace

struct JsonDocument::Tree {
  nlohmann::json root;
};

JsonDocument::JsonDocument(std::string_view text, std::string_view name) : tree_(std::make_unique<Tree>()) {
  if (is_too_deep(text)) throw Error(name, fmt::format("its JSON is nested more than {} deep", max_depth));
  try {
    tree_->root = nlohmann::json::parse(text);
  } catch (const nlohmann::json::exception& error) {
    throw Error(name, "its JSON is damaged: " + one_line(error.what()));
  }
  if (!tree_->root.is_object()) throw Error(name, "its JSON is not an object");
}

JsonDocument::~JsonDocument() = default;

JsonView JsonDocument::root() const { return JsonView(&tree_->root); }

bool JsonView::is_object() const { return value_ != nullptr && json(value_).is_object(); }

bool JsonView::is_array() const { return value_ != nullptr && json(value_).is_array(); }

JsonView JsonView::find(const char* key) const {
  if (!is_object()) return {};
  const auto found = json(value_).find(key);
  return found == json(value_).end() ? JsonView() : JsonView(&*found);
}

std::size_t JsonView::size() const { return is_array() ? json(value_).size() : 0; }

JsonView JsonView::at(std::size_t i) const { return JsonView(&json(value_)[i]); }

std::optional<double> JsonView::number() const {
  if (value_ == nullptr || !json(value_).is_number()) return std::nullopt;
  return json(value_).get<double>();
}

std::optional<bool> JsonView::boolean() const {
  if (value_ == nullptr || !json(value_).is_boolean()) return std::nullopt;
  return json(value_).get<bool>();
}

std::optional<std::string_view> JsonView::text() const {
  if (value_ == nullptr || !json(value_).is_string()) return std::nullopt;
  return json(value_).get_ref<const std::string&>();
}

std::optional<std::string_view> JsonView::key(std::size_t i) const {
  if (!is_object() || i >= json(value_).size()) return std::nullopt;
  return std::next(json(value_).begin(), static_cast<std::ptrdiff_t>(i)).key();
}

}  // namespace welkin

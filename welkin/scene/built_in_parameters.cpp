#include <welkin/scene/built_in_parameters.h>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include <welkin/error.h>

namespace welkin {
namespace {

// Cuts `text` at the first separator; the rest stays in `text`.
std::string_view take_until(std::string_view& text, char separator) {
  const std::size_t end = text.find(separator);
  const std::string_view part = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return part;
}

}  // namespace

SceneParameters::SceneParameters(std::string_view scene, std::string_view text) : scene_(scene) {
  while (!text.empty()) {
    std::string_view value = take_until(text, ',');
    const std::string_view key = take_until(value, '=');
    if (key.empty() || value.empty())
      throw Error(scene_, fmt::format("\"{}\" is not a parameter; they are written key=value", key));
    entries_.push_back({std::string(key), std::string(value)});
  }
}

const std::string* SceneParameters::find(std::string_view key) {
  const std::string* value = nullptr;
  for (Entry& entry : entries_) {
    if (entry.key != key) continue;
    entry.used = true;
    value = &entry.value;
  }
  return value;
}

float SceneParameters::parse(std::string_view key, std::string_view text, float low, float high) const {
  float value = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || end != text.data() + text.size() || !(value >= low && value <= high))
    throw Error(scene_, fmt::format("{} must be a number from {} to {}, not \"{}\"", key, low, high, text));
  return value;
}

float SceneParameters::number(std::string_view key, float otherwise, float low, float high) {
  const std::string* text = find(key);
  return text != nullptr ? parse(key, *text, low, high) : otherwise;
}

int SceneParameters::count(std::string_view key, int otherwise, int low, int high) {
  const float value =
      number(key, static_cast<float>(otherwise), static_cast<float>(low), static_cast<float>(high));
  if (value != std::floor(value)) throw Error(scene_, fmt::format("{} must be a whole number", key));
  return static_cast<int>(value);
}

std::vector<float> SceneParameters::list(std::string_view key, std::vector<float> otherwise, float low,
                                         float high) {
  const std::string* text = find(key);
  if (text == nullptr) return otherwise;
  std::vector<float> values;
  for (std::string_view rest = *text; !rest.empty();)
    values.push_back(parse(key, take_until(rest, '/'), low, high));
  if (values.empty() || values.size() > 16)
    throw Error(scene_, fmt::format("{} must be 1 to 16 numbers with / between", key));
  return values;
}

std::size_t SceneParameters::choice(std::string_view key, std::span<const std::string_view> names) {
  const std::string* text = find(key);
  if (text == nullptr) return 0;
  const auto place = std::find(names.begin(), names.end(), *text);
  if (place == names.end())
    throw Error(scene_, fmt::format("{} must be one of {}, not \"{}\"", key,
                                    fmt::join(names.begin(), names.end(), ", "), *text));
  return static_cast<std::size_t>(place - names.begin());
}

void SceneParameters::refuse_others() const {
  for (const Entry& entry : entries_) {
    if (!entry.used) throw Error(scene_, fmt::format("there is no parameter {}", entry.key));
  }
}

}  // namespace welkin

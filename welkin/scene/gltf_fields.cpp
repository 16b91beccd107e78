#include <welkin/scene/gltf_fields.h>

#include <fmt/format.h>

#include <cmath>

#include <welkin/error.h>

namespace welkin {

void GltfObject::fail(std::string_view what) const {
  throw Error(file, *kind == '\0' ? std::string(what) : fmt::format("{} {}: {}", kind, index, what));
}

GltfObject GltfObject::part(const char* key) const {
  const JsonView found = json.find(key);
  if (found && !found.is_object()) fail(fmt::format("{} is not an object", key));
  return {file, kind, index, found};
}

float GltfObject::number(const char* key, float otherwise) const {
  float value = otherwise;
  const JsonView found = json.find(key);
  if (!found) return value;
  if (!found.number()) fail(fmt::format("{} is not a number", key));
  value = static_cast<float>(*found.number());
  if (!std::isfinite(value)) fail(fmt::format("{} is too large", key));
  return value;
}

bool GltfObject::boolean(const char* key, bool otherwise) const {
  const JsonView found = json.find(key);
  if (found && !found.boolean()) fail(fmt::format("{} is neither true nor false", key));
  return found ? *found.boolean() : otherwise;
}

std::string GltfObject::text(const char* key) const {
  const JsonView found = json.find(key);
  if (found && !found.text()) fail(fmt::format("{} is not a text", key));
  return found ? std::string(*found.text()) : std::string();
}

std::uint64_t GltfObject::count(const char* key, std::uint64_t otherwise) const {
  const JsonView found = json.find(key);
  if (!found) return otherwise;
  const double value = found.number().value_or(-1);
  if (!(value >= 0 && value <= 9007199254740992.0 && value == std::floor(value)))
    fail(fmt::format("{} is not a whole number of 0 or more", key));
  return static_cast<std::uint64_t>(value);
}

int GltfObject::index_of(const char* key, std::size_t limit) const {
  if (!json.find(key)) return -1;
  const std::uint64_t value = count(key, 0);
  if (value >= limit) fail(fmt::format("{} {} does not exist, there are {}", key, value, limit));
  return static_cast<int>(value);
}

int GltfObject::required_index(const char* key, std::size_t limit) const {
  const int found = index_of(key, limit);
  if (found < 0) fail(fmt::format("{} is missing", key));
  return found;
}

bool GltfObject::numbers(const char* key, float* values, std::size_t size) const {
  const JsonView found = json.find(key);
  if (!found) return false;
  if (found.size() != size) fail(fmt::format("{} is not an array of {} numbers", key, size));
  for (std::size_t i = 0; i < size; ++i) {
    const std::optional<double> value = found.at(i).number();
    if (!value) fail(fmt::format("{} is not an array of {} numbers", key, size));
    values[i] = static_cast<float>(*value);
    if (!std::isfinite(values[i])) fail(fmt::format("{} has a number that is too large", key));
  }
  return true;
}

}  // namespace welkin

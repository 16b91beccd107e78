#pragma once
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

// A JSON text as glTF files have it, read only. nlohmann-json stays behind gltf_json.cpp.

namespace welkin {

/// A value in a JsonDocument, or nothing; as cheap as a pointer, valid as long as the document.
class JsonView {
 public:
  JsonView() = default;
  explicit JsonView(const void* value) : value_(value) {}

  explicit operator bool() const { return value_ != nullptr; }
  bool is_object() const;
  bool is_array() const;
  /// The member of an object; nothing where there is none or this is no object.
  JsonView find(const char* key) const;
  /// How many elements an array has; 0 for all else.
  std::size_t size() const;
  /// Element i < size() of an array.
  JsonView at(std::size_t i) const;
  /// Nothing for another type.
  std::optional<double> number() const;
  std::optional<bool> boolean() const;
  std::optional<std::string_view> text() const;
  /// The key of the i-th member of an object; nothing beyond the last one. Slow for large objects.
  std::optional<std::string_view> key(std::size_t i) const;

 private:
  const void* value_ = nullptr;
};

class JsonDocument {
 public:
  /// Throws Error(name, ...) for anything but an object in valid JSON, nested at most 64 deep.
  JsonDocument(std::string_view text, std::string_view name);
  ~JsonDocument();
  JsonDocument(const JsonDocument&) = delete;
  JsonDocument& operator=(const JsonDocument&) = delete;

  JsonView root() const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace welkin

#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include <welkin/scene/gltf_document.h>
#include <welkin/scene/gltf_json.h>

// Typed fields of the objects of a glTF file, and its parts that parse_gltf puts together.

namespace welkin {

/// One object of the file, e.g. node 7, for reading its fields and for messages. Fields that are there but of another
/// type throw Error, "FILE: node 7: ...".
struct GltfObject {
  std::string_view file;
  const char* kind = "";
  std::size_t index = 0;
  JsonView json;

  [[noreturn]] void fail(std::string_view what) const;
  /// A part of this object that is an object itself, with the same name in messages; empty where there is none.
  GltfObject part(const char* key) const;
  GltfObject extension(const char* key) const { return part("extensions").part(key); }
  explicit operator bool() const { return static_cast<bool>(json); }

  float number(const char* key, float otherwise) const;
  bool boolean(const char* key, bool otherwise) const;
  std::string text(const char* key) const;
  /// A whole number from 0 to 2^53.
  std::uint64_t count(const char* key, std::uint64_t otherwise) const;
  /// -1 where there is none; throws for one that is not below `limit`.
  int index_of(const char* key, std::size_t limit) const;
  int required_index(const char* key, std::size_t limit) const;
  /// False, and the values stay, where there is none.
  bool numbers(const char* key, float* values, std::size_t size) const;
  template <std::size_t Size>
  bool numbers(const char* key, std::array<float, Size>& values) const {
    return numbers(key, values.data(), Size);
  }
};

/// Calls visit(GltfObject) for every element of the array `key`; throws where it is no array of objects.
template <class Visit>
void for_each_object(const GltfObject& parent, const char* key, const char* kind, Visit&& visit) {
  const JsonView array = parent.json.find(key);
  if (array && !array.is_array()) parent.fail(std::string(key) + " is not an array");
  for (std::size_t i = 0; i < array.size(); ++i) {
    const GltfObject object{parent.file, kind, i, array.at(i)};
    if (!object.json.is_object()) object.fail("is not an object");
    visit(object);
  }
}

void parse_gltf_storage(const GltfObject& root, GltfDocument& document);
void parse_gltf_materials(const GltfObject& root, GltfDocument& document);
void parse_gltf_nodes(const GltfObject& root, GltfDocument& document);

}  // namespace welkin

#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace welkin {

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
enum class PlyForm : std::uint8_t { ascii, little_endian, big_endian };

constexpr std::size_t ply_size(PlyType type) {
  constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  bool is_list = false;
  PlyType count_type = PlyType::uint8;
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  /// -1 where there is none.
  int find(std::string_view property) const;
};

struct PlyHeader {
  PlyForm form = PlyForm::ascii;
  std::vector<PlyElement> elements;
  std::size_t size = 0;  ///< where the data begin
};

/// Throws Error(name, ...) for what is no PLY 1.0 header and for more than 1000 elements and properties.
PlyHeader parse_ply_header(std::string_view text, std::string_view name);

}  // namespace welkin

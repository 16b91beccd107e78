#include <welkin/scene/gltf_storage.h>

#include <fmt/format.h>

#include <cstring>
#include <limits>
#include <string_view>

#include <welkin/error.h>
#include <welkin/scene/data_uri.h>

namespace welkin {
namespace {

// A file may refer to the same bytes again and again. What is decoded in all may be this many times its bytes (buffers
// included), and this much for free.
constexpr std::uint64_t values_per_byte = 64, free_values = 1 << 20;

std::uint64_t component_size(int type) {
  switch (type) {
    case 5120:
    case 5121: return 1;
    case 5122:
    case 5123: return 2;
    case 5125:
    case 5126: return 4;
    default: return 0;
  }
}

template <class Number>
Number load(const std::uint8_t* bytes) {
  Number value;
  std::memcpy(&value, bytes, sizeof value);  // glTF is little-endian, and so is what welkin runs on
  return value;
}

std::uint32_t load_index(const std::uint8_t* bytes, int type) {
  return type == 5121 ? *bytes : type == 5123 ? load<std::uint16_t>(bytes) : load<std::uint32_t>(bytes);
}

// glTF 2.0, 3.11: c / 127 and so on, signed ones not below -1.
float load_float(const std::uint8_t* bytes, int type, bool normalized) {
  float value = 0, largest = 1;
  switch (type) {
    case 5120: value = load<std::int8_t>(bytes), largest = 127; break;
    case 5121: value = *bytes, largest = 255; break;
    case 5122: value = load<std::int16_t>(bytes), largest = 32767; break;
    case 5123: value = load<std::uint16_t>(bytes), largest = 65535; break;
    case 5125: value = static_cast<float>(load<std::uint32_t>(bytes)), largest = 4294967295.0f; break;
    default: return load<float>(bytes);
  }
  return normalized ? std::max(value / largest, -1.0f) : value;
}

}  // namespace

// Where an accessor's elements lie; `bytes` empty for one without a view, whose elements are 0.
struct GltfStorage::Packed {
  std::span<const std::uint8_t> bytes;
  std::uint64_t stride = 0, element = 0;
};

GltfStorage::GltfStorage(const GltfDocument& document, std::span<const std::uint8_t> binary_chunk,
                         const FileResolver& resolve, std::size_t file_size)
    : document_(document),
      binary_chunk_(binary_chunk),
      resolve_(resolve),
      budget_(free_values + values_per_byte * file_size),
      loaded_(document.buffers.size()) {}

void GltfStorage::fail(int accessor, std::string_view what) const {
  throw Error(document_.name, fmt::format("accessor {}: {}", accessor, what));
}

void GltfStorage::spend(std::uint64_t values) {
  if (values > budget_ || values > std::numeric_limits<std::size_t>::max() / 64)
    throw Error(document_.name,
                fmt::format("asks for more than {} times its size in vertices", values_per_byte));
  budget_ -= values;
}

std::vector<std::uint8_t> GltfStorage::uri_bytes(const std::string& uri) const {
  if (is_data_uri(uri)) return decode_data_uri(uri, document_.name);
  try {
    return resolve_(decode_percent(uri));
  } catch (const Error& error) {
    throw Error(document_.name, fmt::format("refers to a file that cannot be read: {}", error.what()));
  }
}

std::span<const std::uint8_t> GltfStorage::buffer_bytes(int index) {
  const GltfBuffer& buffer = document_.buffers[index];
  std::span<const std::uint8_t> bytes = binary_chunk_;
  if (buffer.uri) {
    if (loaded_[index].empty()) {
      loaded_[index] = uri_bytes(*buffer.uri);
      budget_ += values_per_byte * loaded_[index].size();
    }
    bytes = loaded_[index];
  } else if (index != 0 || bytes.empty()) {
    throw Error(document_.name,
                fmt::format("buffer {} is missing: it has no uri and is no binary chunk", index));
  }
  if (bytes.size() < buffer.byte_length)
    throw Error(document_.name, fmt::format("buffer {} is cut off: it has {} of {} bytes", index,
                                            bytes.size(), buffer.byte_length));
  return bytes.first(buffer.byte_length);
}

std::span<const std::uint8_t> GltfStorage::view_bytes(int index) {
  const GltfView& view = document_.views[index];
  const std::span<const std::uint8_t> bytes = buffer_bytes(view.buffer);
  if (view.offset > bytes.size() || view.length > bytes.size() - view.offset)
    throw Error(document_.name, fmt::format("buffer view {} reaches beyond its buffer", index));
  return bytes.subspan(view.offset, view.length);
}

std::span<const std::uint8_t> GltfStorage::strided(int view, std::uint64_t offset, std::uint64_t count,
                                                   std::uint64_t element, std::uint64_t& stride,
                                                   int accessor) {
  const std::span<const std::uint8_t> bytes = view_bytes(view);
  if (stride == 0) stride = element;
  if (count == 0) return {};
  if (offset > bytes.size() || element > bytes.size() - offset ||
      (count - 1) > (bytes.size() - offset - element) / stride)
    fail(accessor, "reaches beyond its buffer view");
  return bytes.subspan(offset);
}

GltfStorage::Packed GltfStorage::locate(int index) {
  const GltfAccessor& accessor = document_.accessors[index];
  const std::uint64_t size = component_size(accessor.component_type);
  if (size == 0) fail(index, "its componentType is not one of glTF's");
  Packed packed;
  packed.element = size * static_cast<std::uint64_t>(accessor.components);
  if (accessor.view < 0) return packed;
  packed.stride = document_.views[accessor.view].stride;
  packed.bytes =
      strided(accessor.view, accessor.offset, accessor.count, packed.element, packed.stride, index);
  return packed;
}

// visit(index, bytes of the element that stands there instead).
template <class Visit>
void GltfStorage::for_each_sparse(int index, std::uint64_t element, Visit&& visit) {
  const GltfAccessor& accessor = document_.accessors[index];
  if (!accessor.sparse) return;
  const GltfSparse& sparse = *accessor.sparse;
  const std::uint64_t index_size = component_size(sparse.index_type);
  if (sparse.index_type != 5121 && sparse.index_type != 5123 && sparse.index_type != 5125)
    fail(index, "its sparse indices are no unsigned integers");
  spend(sparse.count);
  std::uint64_t index_stride = index_size, value_stride = element;
  const auto indices =
      strided(sparse.index_view, sparse.index_offset, sparse.count, index_size, index_stride, index);
  const auto values =
      strided(sparse.value_view, sparse.value_offset, sparse.count, element, value_stride, index);
  for (std::uint64_t i = 0; i < sparse.count; ++i) {
    const std::uint32_t place = load_index(&indices[i * index_size], sparse.index_type);
    if (place >= accessor.count) fail(index, "a sparse index is beyond its count");
    visit(place, &values[i * element]);
  }
}

const std::vector<float>& GltfStorage::floats(int index, int components, const char* what) {
  floats_.resize(document_.accessors.size());
  const GltfAccessor& accessor = document_.accessors[index];
  if (accessor.components != components)
    fail(index, fmt::format("{} needs {} numbers for each vertex", what, components));
  if (floats_[index]) return *floats_[index];
  const Packed packed = locate(index);
  spend(accessor.count * static_cast<std::uint64_t>(components));
  auto values = std::make_unique<std::vector<float>>(accessor.count * static_cast<std::uint64_t>(components));
  const std::uint64_t size = packed.element / static_cast<std::uint64_t>(components);
  const auto read = [&](std::uint64_t element, const std::uint8_t* bytes) {
    for (int c = 0; c < components; ++c)
      (*values)[element * static_cast<std::uint64_t>(components) + c] = load_float(
          bytes + size * static_cast<std::uint64_t>(c), accessor.component_type, accessor.normalized);
  };
  if (!packed.bytes.empty())
    for (std::uint64_t i = 0; i < accessor.count; ++i) read(i, &packed.bytes[i * packed.stride]);
  for_each_sparse(index, packed.element, read);
  floats_[index] = std::move(values);
  return *floats_[index];
}

std::vector<std::uint32_t> GltfStorage::indices(int index) {
  const GltfAccessor& accessor = document_.accessors[index];
  const int type = accessor.component_type;
  if (accessor.components != 1 || (type != 5121 && type != 5123 && type != 5125))
    fail(index, "indices are unsigned integers, one each");
  const Packed packed = locate(index);
  spend(accessor.count);
  std::vector<std::uint32_t> values(accessor.count);
  if (!packed.bytes.empty())
    for (std::uint64_t i = 0; i < accessor.count; ++i)
      values[i] = load_index(&packed.bytes[i * packed.stride], type);
  for_each_sparse(index, packed.element, [&](std::uint32_t place, const std::uint8_t* bytes) {
    values[place] = load_index(bytes, type);
  });
  return values;
}

}  // namespace welkin

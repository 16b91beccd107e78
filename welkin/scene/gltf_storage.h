#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <welkin/scene/file_resolver.h>
#include <welkin/scene/gltf_document.h>

namespace welkin {

/// The bytes of a glTF file's buffers and what accessors make of them. Buffers are loaded when they are first asked for.
class GltfStorage {
 public:
  /// All three outlive this. `binary_chunk` is that of a GLB, or empty.
  GltfStorage(const GltfDocument& document, std::span<const std::uint8_t> binary_chunk,
              const FileResolver& resolve, std::size_t file_size);

  std::span<const std::uint8_t> view_bytes(int view);
  /// The bytes that a uri stands for: base64 data or a file.
  std::vector<std::uint8_t> uri_bytes(const std::string& uri) const;

  /// All values of an accessor of `components` numbers, normalised integers divided out. Kept until forget().
  const std::vector<float>& floats(int accessor, int components, const char* what);
  std::vector<std::uint32_t> indices(int accessor);
  /// Of an accessor, without reading it.
  std::uint64_t count(int accessor) const { return document_.accessors[accessor].count; }
  /// Called before memory is taken for `values` numbers. Throws Error when a file asks for far more than it holds.
  void spend(std::uint64_t values);
  void forget() { floats_.clear(); }

 private:
  struct Packed;
  Packed locate(int accessor);
  std::span<const std::uint8_t> buffer_bytes(int buffer);
  std::span<const std::uint8_t> strided(int view, std::uint64_t offset, std::uint64_t count,
                                        std::uint64_t element, std::uint64_t& stride, int accessor);
  template <class Visit>
  void for_each_sparse(int accessor, std::uint64_t element, Visit&& visit);
  [[noreturn]] void fail(int accessor, std::string_view what) const;

  const GltfDocument& document_;
  std::span<const std::uint8_t> binary_chunk_;
  const FileResolver& resolve_;
  std::uint64_t budget_;  ///< numbers that may still be decoded
  std::vector<std::vector<std::uint8_t>> loaded_;
  std::vector<std::unique_ptr<std::vector<float>>> floats_;
};

}  // namespace welkin

#pragma once
#include <cstdint>
#include <span>

#include <welkin/pathtrace/picture.h>

namespace welkin {

/// A 64-bit hash of everything that the samples of a picture depend on: scene, camera, environment map (nullptr: none)
/// and options. PictureOptions::samples counts only where target_error decides, so that pictures without it can be gone on
/// with to more samples. Says whether two runs are the same; no protection against intent.
std::uint64_t picture_fingerprint(const Scene& scene, const Camera& camera, const Image* environment,
                                  const PictureOptions& options);

/// The hash that is used, of bytes: for files' checksums.
std::uint64_t content_hash(std::span<const std::uint8_t> bytes, std::uint64_t seed = 0);

}  // namespace welkin

#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <welkin/realtime/technique.h>

// An environment's maps as bytes: they are made in a worker, which has a memory of its own, and sent to the page.

namespace welkin {

std::vector<std::uint8_t> pack_light(const EnvironmentData& light);

/// Of what pack_light made. The kernels and the report of the filter are not in it. Throws Error for anything else.
std::shared_ptr<const EnvironmentData> unpack_light(std::span<const std::uint8_t> bytes);

}  // namespace welkin

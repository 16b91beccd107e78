#pragma once
#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <welkin/error.h>

// Every strict prefix of a file must be refused with an Error that names the file, on one line. Each prefix lies in
// memory of exactly its size, so that the address sanitizer sees a read past its end.

namespace welkin {

using Decode = std::function<void(std::span<const std::uint8_t>)>;

/// What `decode` says about `bytes`; "(accepted)" when it does not throw. Anything but an Error escapes.
inline std::string refusal(std::span<const std::uint8_t> bytes, const Decode& decode) {
  const std::vector<std::uint8_t> exact(bytes.begin(), bytes.end());
  try {
    decode(exact);
  } catch (const Error& error) {
    return error.what();
  }
  return "(accepted)";
}

inline void expect_every_prefix_refused(std::span<const std::uint8_t> bytes, const std::string& name,
                                        const Decode& decode) {
  ASSERT_EQ(refusal(bytes, decode), "(accepted)");
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const std::string message = refusal(bytes.first(size), decode);
    ASSERT_TRUE(message.starts_with(name + ": ")) << size << " bytes: " << message;
    ASSERT_EQ(message.find('\n'), std::string::npos) << size << " bytes: " << message;
  }
}

}  // namespace welkin

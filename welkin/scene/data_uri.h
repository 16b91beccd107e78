#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace welkin {

/// "data:..."
bool is_data_uri(std::string_view uri);

/// The bytes of a data URI in base64. Throws Error(name, ...) for any other coding and for damaged base64.
std::vector<std::uint8_t> decode_data_uri(std::string_view uri, std::string_view name);

/// %20 and the like replaced by their bytes.
std::string decode_percent(std::string_view uri);

}  // namespace welkin

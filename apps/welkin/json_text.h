#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace welkin {

/// JSON text, indented by two, with U+FFFD for what is not UTF-8: names of files are any bytes, JSON is UTF-8.
inline std::string json_text(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace welkin

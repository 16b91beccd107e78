#pragma once
#include <optional>
#include <string>
#include <string_view>

#include <welkin/sh/forms/document.h>

// Private to sh/forms: the forms that are JSON objects (json, three, babylon).

namespace welkin {

/// The text of write_sh for json, three or babylon; `numbers` is empty for json.
std::string write_sh_json(const ShDocument& document, ShForm form, const ShFormNumbers& numbers);

/// The document in a JSON object; for an object that does not say its form, as read_sh.
ShDocument read_sh_json(std::string_view text, std::string_view name, std::optional<ShForm> bare_form);

}  // namespace welkin

#pragma once
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace welkin {

/// The page that explains a set: index.html beside manifest.json, complete in itself (no scripts, nothing from a
/// network). It shows preview.png (and environment.png where the manifest lists it) from its own folder, and says what
/// the manifest says; whatever the manifest lacks, or holds in another type than expected, is left out. All text is
/// escaped. Documented members: docs/ibl.md.
std::string make_report_html(const nlohmann::json& manifest);

/// Text for HTML content and quoted attributes: & < > " ' become entities, control characters spaces.
std::string escape_html(std::string_view text);

}  // namespace welkin

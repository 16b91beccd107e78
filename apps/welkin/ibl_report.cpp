#include "ibl_report.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "ibl_report_style.h"

namespace welkin {
namespace {

using Json = nlohmann::json;

// The member at `path` ("errors/energy"), or nullptr where there is none or it is null.
const Json* find(const Json& value, std::string_view path) {
  if (!value.is_object()) return nullptr;
  const std::size_t slash = path.find('/');
  const auto member = value.find(std::string(path.substr(0, slash)));
  if (member == value.end() || member->is_null()) return nullptr;
  return slash == std::string_view::npos ? &*member : find(*member, path.substr(slash + 1));
}

// An array that is not empty, or nullptr.
const Json* find_list(const Json& value, std::string_view path) {
  const Json* found = find(value, path);
  return found && found->is_array() && !found->empty() ? found : nullptr;
}

double number(const Json& value, std::string_view path, double fallback) {
  const Json* found = find(value, path);
  return found && found->is_number() ? found->get<double>() : fallback;
}

// A value as escaped text: numbers to four digits, lists with commas. Empty for objects and null.
std::string shown(const Json& value) {
  if (value.is_string()) return escape_html(value.get_ref<const std::string&>());
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_integer()) return value.dump();
  if (value.is_number()) {
    const double x = value.get<double>();
    return std::abs(x) >= 1e4 && std::abs(x) < 1e9 ? fmt::format("{:.0f}", x) : fmt::format("{:.4g}", x);
  }
  std::string text;
  if (value.is_array())
    for (const Json& item : value) text += (text.empty() ? "" : ", ") + shown(item);
  return text;
}

std::string shown(const Json& value, std::string_view path) {
  const Json* found = find(value, path);
  return found ? shown(*found) : std::string();
}

// A relative link: the leading ./ keeps a name from being read as a scheme.
std::string link_to(const std::string& name) {
  std::string link = "./";
  for (char c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '.' || c == '_' || c == '-' || c == '/';
    link += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return link;
}

std::string section(std::string_view title, const std::string& content) {
  return content.empty() ? "" : fmt::format("<section>\n<h2>{}</h2>\n{}</section>\n", title, content);
}

std::string scrolling_table(const std::string& caption, const std::string& rows) {
  const std::string label = caption.empty() ? "" : fmt::format("<caption>{}</caption>\n", caption);
  return fmt::format("<div class=\"scroll\"><table>\n{}{}</table></div>\n", label, rows);
}

struct Column {
  std::string_view path, title;
};

std::string cell(const Json& row, const Column& column) {
  const Json* value = find(row, column.path);
  if (!value) return "<td class=\"n\">&ndash;</td>";
  const std::string text = shown(*value);
  if (column.path == "name" && value->is_string())
    return fmt::format("<th scope=\"row\"><a href=\"{}\">{}</a></th>", link_to(*value), text);
  return fmt::format("<td{}>{}</td>", value->is_number() ? " class=\"n\"" : "", text);
}

// A table of an array's members; only the columns that some member has.
std::string table(const Json* rows, std::span<const Column> columns, const std::string& caption = "") {
  if (!rows) return "";
  std::vector<Column> used;
  for (const Column& column : columns)
    if (std::any_of(rows->begin(), rows->end(), [&](const Json& row) { return find(row, column.path); }))
      used.push_back(column);
  if (used.empty()) return "";
  std::string html = "<thead><tr>";
  for (const Column& column : used) html += fmt::format("<th scope=\"col\">{}</th>", column.title);
  html += "</tr></thead>\n<tbody>\n";
  for (const Json& row : *rows) {
    html += "<tr>";
    for (const Column& column : used) html += cell(row, column);
    html += "</tr>\n";
  }
  return scrolling_table(caption, html + "</tbody>\n");
}

// A table of one object: a row for each path that it has, with a unit behind the value.
struct Fact {
  std::string_view path, title, unit;
};

std::string facts(const Json& value, std::span<const Fact> list) {
  std::string rows;
  for (const Fact& fact : list) {
    const std::string text = shown(value, fact.path);
    if (!text.empty())
      rows += fmt::format("<tr><th scope=\"row\">{}</th><td>{}{}</td></tr>\n", fact.title, text, fact.unit);
  }
  return rows.empty() ? "" : scrolling_table("", "<tbody>\n" + rows + "</tbody>\n");
}

bool lists_file(const Json& manifest, std::string_view name) {
  const Json* files = find_list(manifest, "files");
  return files && std::any_of(files->begin(), files->end(), [&](const Json& file) {
           const Json* found = find(file, "name");
           return found && *found == name;
         });
}

std::string figure(std::string_view file, std::string_view alt, std::string_view caption) {
  return fmt::format(
      "<figure><a href=\"./{0}\"><img src=\"./{0}\" "
      "alt=\"{1}\"></a>\n<figcaption>{2}</figcaption></figure>\n",
      file, alt, caption);
}

std::string header(const Json& manifest) {
  const std::string source = shown(manifest, "source");
  std::string html = fmt::format("<header>\n<h1>{}</h1>\n", source.empty() ? "Image-based lighting" : source);
  std::string line = shown(manifest, "description");
  const double turned = number(manifest, "orientation/rotate_degrees", 0);
  if (turned != 0) line += fmt::format("; turned by {:g} degrees about +Y", turned);
  if (shown(manifest, "orientation/mirror") == "yes") line += "; mirrored";
  if (!line.empty()) html += fmt::format("<p class=\"faint\">{}</p>\n", line);
  return html + "</header>\n";
}

std::string pictures(const Json& manifest) {
  std::string html;
  if (lists_file(manifest, "environment.png"))
    html += figure("environment.png", "The environment as an equirectangular panorama",
                   "The environment, exposed for the eye.");
  return html + figure("preview.png",
                       "Contact sheet: the levels of the specular map as panoramas, a row of metal spheres "
                       "from mirror to "
                       "rough, a matt and a glossy red sphere, the irradiance and the DFG table",
                       "Everything here is shaded with the files below, and the lights below where there are "
                       "some, at one exposure.");
}

std::string warnings(const Json& manifest) {
  std::string items;
  if (const Json* list = find_list(manifest, "input/warnings"))
    for (const Json& warning : *list) items += fmt::format("<li>{}</li>\n", shown(warning));
  for (std::string_view kind : {"nan", "infinite", "negative"}) {
    const double count = number(manifest, fmt::format("input/faults/{}", kind), 0);
    if (count > 0)
      items += fmt::format("<li>{:.0f} {} values in the input were repaired</li>\n", count,
                           kind == "nan" ? "NaN" : kind);
  }
  return items.empty() ? "" : fmt::format("<ul class=\"warnings\">\n{}</ul>\n", items);
}

std::string input(const Json& manifest) {
  static constexpr Fact list[] = {{"input/width", "Width", " texels"},
                                  {"input/height", "Height", " texels"},
                                  {"input/mean_radiance", "Mean radiance over the sphere (R, G, B)", ""},
                                  {"input/max_radiance", "Largest radiance", ""},
                                  {"input/brightest_direction", "Towards the brightest texel (x, y, z)", ""},
                                  {"input/brightest_share", "Its share of all light", ""},
                                  {"input/irradiance_up", "Irradiance facing +Y (R, G, B)", ""},
                                  {"input/irradiance_down", "Irradiance facing -Y (R, G, B)", ""}};
  return warnings(manifest) + facts(manifest, list);
}

std::string files(const Json& manifest) {
  static constexpr Column columns[] = {{"name", "File"},
                                       {"quantity", "What it is"},
                                       {"unit", "Unit"},
                                       {"container", "Container"},
                                       {"format", "Format"},
                                       {"quality", "Quality"},
                                       {"size", "Size"},
                                       {"level_count", "Levels"},
                                       {"stored_scale", "Stored scale"},
                                       {"clipped", "Clipped values"},
                                       {"bytes", "Bytes"}};
  return table(find_list(manifest, "files"), columns, "True value = value in the file times stored scale.");
}

constexpr Column error_columns[] = {{"errors/relative_rms", "Relative RMS"},
                                    {"errors/max_over_mean", "Max over mean"},
                                    {"errors/lookup_relative_rms", "Look-up RMS"},
                                    {"errors/lookup_max_over_mean", "Look-up max"},
                                    {"errors/energy", "Energy"},
                                    {"errors/edge_step", "Edge step"}};

constexpr Column stored_columns[] = {{"stored_errors/relative_rms", "Stored RMS"},
                                     {"stored_errors/max_over_mean", "Stored max"},
                                     {"stored_errors/edge_step", "Stored edge step"},
                                     {"stored_errors/face_step", "Face step"}};

std::string levels(const Json& manifest) {
  std::vector<Column> columns{
      {"level", "Level"}, {"size", "Size"},     {"perceptual_roughness", "Perceptual roughness"},
      {"alpha", "Alpha"}, {"kernel", "Kernel"}, {"degree", "Degree"}};
  columns.insert(columns.end(), std::begin(error_columns), std::end(error_columns));
  for (const Column& column : stored_columns) columns.push_back(column);
  columns.push_back({"seconds", "Seconds"});
  const std::string formula = shown(manifest, "level_law/formula");
  std::string html;
  if (!formula.empty())
    html = fmt::format("<p>Level law {}: <code>{}</code>, with r the perceptual roughness.</p>\n",
                       shown(manifest, "level_law/name"), formula);
  return html +
         table(
             find_list(manifest, "levels"), columns,
             "Errors against the direct sum over every texel in double precision: at texel centres, and as a "
             "bilinear look-up sees them. Energy: that of the level over the map's, minus 1. Edge step: mean "
             "step "
             "across cube edges over mean step inside faces. Stored: what the file's format did to the "
             "computed level.");
}

std::string irradiance(const Json& manifest) {
  static constexpr Fact list[] = {
      {"irradiance/size", "Irradiance map", " texels a side"},
      {"irradiance/method", "Method", ""},
      {"edges/fixup", "Edge fix-up of all cubes", ""},
      {"edges/lookup", "How to look up", ""},
      {"irradiance/stored_errors/relative_rms", "Relative RMS of what the format changed", ""},
      {"irradiance/errors/relative_rms", "Relative RMS at texel centres", ""},
      {"irradiance/errors/max_over_mean", "Largest error over the mean", ""},
      {"irradiance/errors/lookup_relative_rms", "Relative RMS of a look-up", ""},
      {"irradiance/errors/lookup_max_over_mean", "Largest look-up error over the mean", ""},
      {"irradiance/errors/energy", "Energy over the map&#39;s, minus 1", ""},
      {"irradiance/errors/edge_step", "Step across edges over the step predicted there", ""},
      {"sh/degree", "Spherical harmonics up to degree", ""},
      {"sh/irradiance_mean_error", "Irradiance from nine coefficients, mean error over the largest", ""},
      {"sh/irradiance_max_error", "Irradiance from nine coefficients, largest error over the largest", ""},
      {"dfg/size", "DFG table", " texels a side"},
      {"dfg/max_error", "Largest error of the DFG table", ""}};
  return facts(manifest, list);
}

std::string lights(const Json& manifest) {
  static constexpr Column columns[] = {{"direction", "Direction (towards the light)"},
                                       {"angular_radius_degrees", "Angular radius (degrees)"},
                                       {"irradiance", "Irradiance of a surface that faces it"},
                                       {"illuminance", "Illuminance"},
                                       {"color", "Color"},
                                       {"share", "Share of the map&#39;s flux"}};
  static constexpr Fact errors[] = {
      {"lights_error/as_directions/max", "Map against set and lights, as directions: largest", ""},
      {"lights_error/as_directions/rms", "the same, RMS", ""},
      {"lights_error/as_discs/max", "as discs of their radius: largest", ""},
      {"lights_error/as_discs/rms", "the same, RMS", ""}};
  const Json* list = find(manifest, "lights");
  if (!list) return "";
  if (list->empty()) return "<p>None: nothing in this map is compact and strong enough.</p>\n";
  return "<p>These were taken out of the map, so they are in none of the files: draw them beside the set, as "
         "directional lights.</p>\n" +
         table(list, columns, "In the map&#39;s unit; errors are shares of the largest irradiance.") +
         facts(manifest, errors);
}

std::string trilinear(const Json& manifest) {
  static constexpr Fact list[] = {{"trilinear/relative_rms", "Relative RMS", ""},
                                  {"trilinear/max_over_mean", "Largest error over the mean", ""}};
  std::string html = facts(manifest, list);
  const Json* bands = find_list(manifest, "trilinear/by_roughness");
  if (!bands) return html;
  double largest = 0;
  for (const Json& band : *bands) largest = std::max(largest, band.is_number() ? band.get<double>() : 0);
  std::string rows =
      "<thead><tr><th scope=\"col\">Perceptual roughness</th><th scope=\"col\">Relative RMS</th>"
      "<th scope=\"col\" class=\"wide\">Share of the largest</th></tr></thead>\n<tbody>\n";
  for (std::size_t k = 0; k < bands->size(); ++k) {
    const Json& band = (*bands)[k];
    const double share = band.is_number() && largest > 0 ? std::max(0.0, band.get<double>()) / largest : 0;
    const double count = static_cast<double>(bands->size()), first = static_cast<double>(k);
    rows += fmt::format(
        "<tr><th scope=\"row\">{:.2g} to {:.2g}</th><td class=\"n\">{}</td>"
        "<td><span class=\"bar\" style=\"width: {:.0f}%\"></span></td></tr>\n",
        first / count, (first + 1) / count, shown(band), 100 * share);
  }
  return html + scrolling_table("Random directions and roughnesses, between texels and between levels.",
                                rows + "</tbody>\n");
}

std::string conventions(const Json& manifest) {
  const Json* list = find(manifest, "conventions");
  if (!list || !list->is_object()) return "";
  std::string rows;
  for (const auto& item : list->items()) {
    std::string title = item.key();
    std::replace(title.begin(), title.end(), '_', ' ');
    const std::string text = shown(item.value());
    if (!text.empty())
      rows += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", escape_html(title), text);
  }
  return rows.empty() ? "" : scrolling_table("", "<tbody>\n" + rows + "</tbody>\n");
}

std::string timings(const Json& manifest) {
  static constexpr Fact list[] = {{"timings/load", "Load", " s"},
                                  {"timings/environment", "Environment", " s"},
                                  {"timings/specular", "Specular", " s"},
                                  {"timings/irradiance", "Irradiance", " s"},
                                  {"timings/sh", "Spherical harmonics", " s"},
                                  {"timings/dfg", "DFG table", " s"},
                                  {"timings/verify", "Verification", " s"},
                                  {"timings/write", "Write", " s"},
                                  {"timings/total", "Total", " s"}};
  return facts(manifest, list);
}

// The file whose name begins with `stem`, or an empty object.
Json file_named(const Json& manifest, std::string_view stem) {
  if (const Json* list = find_list(manifest, "files"))
    for (const Json& file : *list)
      if (const Json* name = find(file, "name");
          name && name->is_string() && name->get_ref<const std::string&>().rfind(stem, 0) == 0)
        return file;
  return Json::object();
}

std::string glsl_level(const Json& manifest) {
  const std::string law = shown(manifest, "level_law/name");
  if (law == "quadratic") return "(levels - 1.0) * r * (2.0 - r)";
  if (law == "log2") return "log2(max(size * r * r, 1.0))";
  return "r * (levels - 1.0)";
}

// What single scattering loses, unless the table already holds it (Turquin 2019, equation 16).
constexpr const char* compensation_line =
    "  reflectance *= 1.0 + f0 * (1.0 / (dfg.x + dfg.y) - 1.0);  // light between facets\n";

bool has_compensation(const Json& manifest) {
  const Json* dfg = find(manifest, "dfg/multiple_scattering_included");
  return dfg && dfg->is_boolean() && dfg->get<bool>();
}

std::string how_to_load(const Json& manifest) {
  const Json* list = find_list(manifest, "levels");
  const Json specular = file_named(manifest, "specular"), diffuse = file_named(manifest, "irradiance");
  if (!list || specular.empty()) return "";
  return fmt::format(
      "<p>Upload the maps as they are, with linear filtering (trilinear, seamless for the cubes) and clamped "
      "edges. In GLSL ES "
      "3.00, for a surface with the unit normal n, seen from the unit direction v:</p>\n"
      "<pre><code>uniform samplerCube specular_map;    // {specular}\n"
      "uniform samplerCube irradiance_map;  // {irradiance}\n"
      "uniform sampler2D dfg_map;           // {dfg}\n\n"
      "vec3 reflected_radiance(vec3 n, vec3 v, vec3 albedo, vec3 f0, float perceptual_roughness) {{\n"
      "  float r = perceptual_roughness, levels = {levels:.1f}, size = {size:.1f};\n"
      "  float level = {level};\n"
      "  vec2 dfg = texture(dfg_map, vec2(max(dot(n, v), 0.0), r)).rg;\n"
      "  vec3 reflectance = f0 * dfg.x + dfg.y;\n"
      "{compensation}"
      "  vec3 radiance = {specular_scale:.1f} * textureLod(specular_map, reflect(-v, n), level).rgb;  // "
      "stored scale\n"
      "  vec3 irradiance = {irradiance_scale:.1f} * texture(irradiance_map, n).rgb;\n"
      "  return reflectance * radiance + (1.0 - reflectance) * albedo / 3.14159265 * irradiance;\n"
      "}}</code></pre>\n",
      fmt::arg("specular", shown(specular, "name")), fmt::arg("irradiance", shown(diffuse, "name")),
      fmt::arg("dfg", shown(file_named(manifest, "dfg"), "name")),
      fmt::arg("levels", number(manifest, "level_law/levels", static_cast<double>(list->size()))),
      fmt::arg("size", number(manifest, "level_law/size", number(specular, "size", 256))),
      fmt::arg("level", glsl_level(manifest)),
      fmt::arg("compensation", has_compensation(manifest) ? "" : compensation_line),
      fmt::arg("specular_scale", number(specular, "stored_scale", 1)),
      fmt::arg("irradiance_scale", number(diffuse, "stored_scale", 1)));
}

}  // namespace

std::string escape_html(std::string_view text) {
  std::string escaped;
  for (char c : text) {
    switch (c) {
      case '&': escaped += "&amp;"; break;
      case '<': escaped += "&lt;"; break;
      case '>': escaped += "&gt;"; break;
      case '"': escaped += "&quot;"; break;
      case '\'': escaped += "&#39;"; break;
      default: escaped += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
    }
  }
  return escaped;
}

std::string make_report_html(const nlohmann::json& manifest) {
  const std::string source = shown(manifest, "source"), generator = shown(manifest, "generator");
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{}{}</title>\n<style>{}</style>\n</head>\n<body>\n",
      source.empty() ? "" : source + " &middot; ", "image-based lighting", report_style);
  html += header(manifest) + "<main>\n" + pictures(manifest);
  html += section("Input", input(manifest));
  html += section("Lights", lights(manifest));
  html += section("Files", files(manifest));
  html += section("Levels of the specular map", levels(manifest));
  html += section("Irradiance, spherical harmonics, DFG", irradiance(manifest));
  html += section("The specular map as a renderer sees it", trilinear(manifest));
  html += section("How to load the files", how_to_load(manifest));
  html += section("Conventions", conventions(manifest));
  html += section("Timings", timings(manifest));
  html += "</main>\n";
  if (!generator.empty())
    html += fmt::format("<footer>\n<p class=\"faint\">Made by {}.</p>\n</footer>\n", generator);
  return html + "</body>\n</html>\n";
}

}  // namespace welkin

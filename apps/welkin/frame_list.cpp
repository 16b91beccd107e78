#include "frame_list.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>

#include "json_text.h"

namespace welkin {
namespace {

std::string choices_text(const Parameter& parameter) {
  if (parameter.choices.empty())
    return fmt::format("{}{:g} to {:g}, {:g}", parameter.whole ? "whole, " : "", parameter.minimum,
                       parameter.maximum, parameter.initial);
  std::string text;
  for (const std::string_view choice : parameter.choices)
    text += fmt::format("{}{}", text.empty() ? "" : " | ", choice);
  const auto initial = static_cast<std::size_t>(parameter.initial);
  return fmt::format("{}, {}", text, parameter.choices[initial]);
}

nlohmann::ordered_json parameter_json(const Parameter& parameter) {
  nlohmann::ordered_json json{{"name", parameter.name},       {"meaning", parameter.meaning},
                              {"minimum", parameter.minimum}, {"maximum", parameter.maximum},
                              {"initial", parameter.initial}, {"whole", parameter.whole}};
  if (!parameter.choices.empty())
    json["choices"] = std::vector<std::string>(parameter.choices.begin(), parameter.choices.end());
  return json;
}

nlohmann::ordered_json technique_json(const TechniqueInfo& technique) {
  auto parameters = nlohmann::ordered_json::array();
  for (const Parameter& parameter : technique.parameters) parameters.push_back(parameter_json(parameter));
  return {{"name", technique.name},
          {"summary", technique.summary},
          {"source", technique.source},
          {"truth", truth_name(technique.truth)},
          {"parameters", parameters}};
}

}  // namespace

std::string_view truth_name(Truth truth) {
  switch (truth) {
    case Truth::unshadowed: return "unshadowed";
    case Truth::direct: return "direct";
    case Truth::path: return "path";
    case Truth::ambient_occlusion: return "ambient-occlusion";
    case Truth::dynamic: return "dynamic";
  }
  return "";
}

void list_techniques(bool json) {
  if (json) {
    auto all = nlohmann::ordered_json::array();
    for (const TechniqueInfo& technique : techniques()) all.push_back(technique_json(technique));
    fmt::print("{}\n", json_text(all));
    return;
  }
  for (const TechniqueInfo& technique : techniques()) {
    fmt::print("{}\n    {}\n    {}; truth: {}\n", technique.name, technique.summary, technique.source,
               truth_name(technique.truth));
    for (const Parameter& parameter : technique.parameters)
      fmt::print("    {}: {} ({})\n", parameter.name, parameter.meaning, choices_text(parameter));
  }
}

}  // namespace welkin

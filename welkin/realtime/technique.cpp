#include <welkin/realtime/technique.h>

#include <cmath>
#include <cstdlib>

#include <welkin/error.h>
#include <welkin/realtime/techniques/technique_list.h>

namespace welkin {
namespace {

std::size_t parameter_index(const TechniqueInfo& technique, std::string_view key) {
  std::string known;
  for (std::size_t i = 0; i < technique.parameters.size(); ++i) {
    if (technique.parameters[i].name == key) return i;
    known += (i == 0 ? "" : ", ") + std::string(technique.parameters[i].name);
  }
  throw Error("technique " + std::string(technique.name) + " has no parameter " + std::string(key) + " (" +
              (known.empty() ? "it has none" : "it has: " + known) + ")");
}

float parse_value(const TechniqueInfo& technique, const Parameter& parameter, const std::string& text) {
  const std::string name = std::string(technique.name) + ":" + std::string(parameter.name);
  for (std::size_t i = 0; i < parameter.choices.size(); ++i)
    if (parameter.choices[i] == text) return static_cast<float>(i);
  char* end = nullptr;
  const float value = std::strtof(text.c_str(), &end);
  const bool number = !text.empty() && *end == '\0' && std::isfinite(value);
  const bool whole = parameter.whole || !parameter.choices.empty();
  if (number && value >= parameter.minimum && value <= parameter.maximum &&
      (!whole || value == std::floor(value)))
    return value;
  std::string wanted;
  for (const std::string_view choice : parameter.choices)
    wanted += (wanted.empty() ? "" : ", ") + std::string(choice);
  if (wanted.empty()) {
    char range[64];
    std::snprintf(range, sizeof range, "%s from %g to %g", whole ? "a whole number" : "a number",
                  static_cast<double>(parameter.minimum), static_cast<double>(parameter.maximum));
    wanted = range;
  }
  throw Error(name + "=" + text + ": must be " + wanted);
}

}  // namespace

const TechniqueInfo& find_technique(std::string_view name) {
  std::string known;
  for (const TechniqueInfo& technique : techniques()) {
    if (technique.name == name) return technique;
    known += (known.empty() ? "" : ", ") + std::string(technique.name);
  }
  throw Error("there is no technique " + std::string(name) + " (there are: " + known + ")");
}

ParameterValues initial_values(const TechniqueInfo& technique) {
  ParameterValues values;
  for (const Parameter& parameter : technique.parameters) values.push_back(parameter.initial);
  return values;
}

TechniqueChoice parse_technique(std::string_view text) {
  const auto colon = text.find(':');
  TechniqueChoice choice;
  choice.technique = &find_technique(text.substr(0, colon));
  choice.values = initial_values(*choice.technique);
  std::string_view rest = colon == std::string_view::npos ? "" : text.substr(colon + 1);
  while (!rest.empty()) {
    const auto comma = rest.find(',');
    const std::string_view pair = rest.substr(0, comma);
    rest = comma == std::string_view::npos ? "" : rest.substr(comma + 1);
    const auto equals = pair.find('=');
    if (equals == std::string_view::npos)
      throw Error(std::string(text) + ": write parameters as key=value, separated by commas");
    const std::size_t index = parameter_index(*choice.technique, pair.substr(0, equals));
    choice.values[index] = parse_value(*choice.technique, choice.technique->parameters[index],
                                       std::string(pair.substr(equals + 1)));
  }
  return choice;
}

}  // namespace welkin

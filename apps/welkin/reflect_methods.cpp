#include "reflect_methods.h"

#include <fmt/format.h>

#include <memory>

#include <welkin/error.h>

namespace welkin {

const std::vector<ReflectMethod>& reflect_methods() {
  static const std::vector<ReflectMethod> methods{};
  return methods;
}

const ReflectMethod& find_reflect_method(std::string_view name) {
  std::string choices = "brute";
  for (const ReflectMethod& method : reflect_methods()) {
    if (method.name == name) return method;
    choices += fmt::format(", {}", method.name);
  }
  throw Error(fmt::format("unknown method \"{}\"; choose one of {}, all", name, choices));
}

}  // namespace welkin

#pragma once
#include <string_view>

// Choices that the techniques with captured light have in common, in the order of their enumerations.

namespace welkin {

inline constexpr std::string_view around[] = {"none", "flares", "room", "carousel"};  ///< SurroundingsKind
inline constexpr std::string_view skies[] = {"map", "day"};  ///< DynamicLightOptions::sky

}  // namespace welkin

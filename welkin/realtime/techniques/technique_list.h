#pragma once
#include <welkin/realtime/technique.h>

// One function a technique or family: its rows of the table. technique_list.cpp puts them together.

namespace welkin {

std::span<const TechniqueInfo>
basic_techniques();  ///< basic.cpp: mirror, irradiance-map, prefiltered-ggx, ...
std::span<const TechniqueInfo> harmonic_techniques();    ///< harmonics.cpp: sh-pixel, sh-matrix
std::span<const TechniqueInfo> importance_techniques();  ///< importance.cpp: importance, filtered-importance
std::span<const TechniqueInfo>
dynamic_irradiance_techniques();  ///< dynamic_irradiance.cpp: dynamic-irradiance, dynamic-phong
std::span<const TechniqueInfo>
power_lobe_techniques();  ///< power_lobes.cpp: prefiltered-phong, fresnel-blend, lafortune
std::span<const TechniqueInfo> stretched_techniques();       ///< stretched.cpp: stretched
std::span<const TechniqueInfo> view_elevation_techniques();  ///< view_elevation.cpp: view-elevation

std::span<const TechniqueInfo> dynamic_glossy_techniques();  ///< dynamic_glossy.cpp: dynamic-glossy
std::span<const TechniqueInfo> occlusion_techniques();       ///< occlusion.cpp: ssao-sphere, gtao, ...

std::span<const TechniqueInfo> bump_supersampled_techniques();  ///< bump_supersampled.cpp
std::span<const TechniqueInfo> bump_techniques();  ///< bump.cpp: bump-naive, toksvig, lean, schilling, ...

}  // namespace welkin

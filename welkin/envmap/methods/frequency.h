#pragma once
#include <welkin/envmap/filter.h>

namespace welkin {

using FrequencyOptions = FilterOptions;

/// filter_environment for one target: exact in frequency space (Funk-Hecke), the default.
/// Artefact: none to be seen. Stated error: relative RMS 1e-4, largest 1e-3 of the map's mean.
Cube filter_frequency(const Image& radiance, const FilterTarget& target,
                      const FrequencyOptions& options = {});

}  // namespace welkin

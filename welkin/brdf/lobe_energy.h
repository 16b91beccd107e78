#pragma once
#include <vector>

#include <welkin/brdf/lobe_rings.h>

namespace welkin {

/// Shapes scaled to integral 1, with the energies of each channel by non-negative least squares, and the error that is
/// left. For LobeTarget::brdf_times_cosine each channel's energies are then scaled to sum up to that of the slice.
/// Private to welkin/brdf. view_angle is left at 0.
LobeFit with_energies(const LobeSlice& slice, const RingNodes& nodes, const std::vector<WorkingLobe>& lobes,
                      LobeTarget target);

}  // namespace welkin

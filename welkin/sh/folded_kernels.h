#pragma once
#include <welkin/sh/folded_lookup.h>

// The inner loops of folded_lookup.cpp, on texels as they lie in a Cube or a SphereMap.

namespace welkin {

/// sums[part * functions + k] += folded row * table, lane by lane; lane j of a block belongs to channel j % channels.
/// scratch holds 2 * table.blocks blocks, its padding zero.
void add_folded_rows(const FoldedTable& table, const float* texels, FloatBlock* scratch, FloatBlock* sums);

/// harmonics[lm] = sum over part and k of basis * moments[part * functions + k], lane by lane.
void harmonics_of_moments(const FoldedTable& table, const FloatBlock* moments, FloatBlock* harmonics);

/// factors[part * functions + k] = sum over the first `known` lm of basis * harmonics[lm], lane by lane.
void factors_of_harmonics(const FoldedTable& table, const FloatBlock* harmonics, int known,
                          FloatBlock* factors);

/// texels = sum over k of factors[part * functions + k] * table, lane by lane.
void write_unfolded_rows(const FoldedTable& table, const FloatBlock* factors, float* texels);

}  // namespace welkin

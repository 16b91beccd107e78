#pragma once
#include <welkin/image/codecs/bc6h/block_code.h>
#include <welkin/image/codecs/bc6h/kernels.h>

namespace welkin::bc6h {

struct Candidate {
  BlockCode code;
  float cost = 4 * forbidden;  // sum of importance * squared differences on the error scale
};

/// Gives code its best indices and returns the cost. Ends are swapped where the anchor's index asks for it; where the
/// offsets of the mode then do not fit, the anchor takes the best index that its bits allow.
float evaluate(const Targets& targets, BlockCode& code);

/// The best indices of one subset of code, the other's are left; returns the cost of that subset.
float assign_subset(const Targets& targets, BlockCode& code, int subset);

/// The anchor's highest index bit is not stored: swaps the ends where it is set, or, where that is more than the offsets
/// hold, gives the anchor the best index that is left. Returns by how much that raises the cost.
float settle_anchor(const Targets& targets, BlockCode& code, int subset);

/// Swaps the ends of a subset and turns its indices round: the same colours.
void swap_ends(BlockCode& code, int subset);

/// For fixed indices, the best codes within +-radius for both ends of each channel of one subset.
void best_pairs(const Targets& targets, BlockCode& code, int subset, int radius);

/// Moves the ends to the least-squares lines for the candidate's indices and takes the best indices again, while that
/// lowers the cost; `rounds` times at most.
void refit(const Targets& targets, Candidate& candidate, int rounds);

/// For fixed indices, tries all pairs of end codes within +-radius for each channel of each subset, then takes the
/// best indices again; `rounds` times at most, while that lowers the cost.
void refine_pairs(const Targets& targets, Candidate& candidate, int radius, int rounds);

/// Tries every single end code +-1 with the best indices for it, until none lowers the cost; `rounds` times at most.
void refine_single(const Targets& targets, Candidate& candidate, int rounds);

/// The members of a subset of code.
const Lanes& members(const BlockCode& code, int subset);

}  // namespace welkin::bc6h

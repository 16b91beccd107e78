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

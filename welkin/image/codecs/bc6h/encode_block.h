#pragma once
#include <welkin/image/codecs/bc6h/bc6h.h>
#include <welkin/image/codecs/bc6h/error_scale.h>
#include <welkin/image/codecs/bc6h/search.h>

namespace welkin::bc6h {

/// The best code that the search of this speed finds; see encode_bc6h_block.
Candidate encode(const Targets& targets, Bc6hSpeed speed);

/// The same for halves with the scale that linear_above asks for (see bc6h.h). Blocks with nothing above it are measured
/// by the logarithm alone. For the others the search on the linear scale, whose least squares is easily caught by its
/// steepness, begins once more from what the logarithm finds.
Candidate encode(const int halves[48], const Bc6hOptions& options, const ErrorScale& linear);

/// A line through one subset before quantisation: principal axis, then `rounds` times least squares for the indices that
/// it gives, while that lowers the cost (0 rounds: one step, unseen). swap: whether the anchor is nearer to the second end.
/// Returns the cost.
float fit_line(const Targets& targets, const Lanes& member, int levels, int anchor, int rounds, Line& line,
               bool& swap);

}  // namespace welkin::bc6h

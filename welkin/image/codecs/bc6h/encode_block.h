#pragma once
#include <welkin/image/codecs/bc6h/search.h>

namespace welkin::bc6h {

/// The best code that the search of this speed finds; see encode_bc6h_block.
Candidate encode(const Targets& targets, Bc6hSpeed speed);

/// A line through one subset before quantisation: principal axis, then `rounds` times least squares for the indices that
/// it gives, while that lowers the cost (0 rounds: one step, unseen). swap: whether the anchor is nearer to the second end.
/// Returns the cost.
float fit_line(const Targets& targets, const Lanes& member, int levels, int anchor, int rounds, Line& line,
               bool& swap);

}  // namespace welkin::bc6h

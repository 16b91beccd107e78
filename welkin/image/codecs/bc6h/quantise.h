#pragma once
#include <array>

#include <welkin/image/codecs/bc6h/block_code.h>
#include <welkin/image/codecs/bc6h/kernels.h>

namespace welkin::bc6h {

/// The largest magnitude of an endpoint code whose colour is not above `limit` (a half's magnitude).
int largest_code(int limit, int bits, bool is_signed);

/// The endpoint code nearest to a position, of magnitude `most` at most; never negative unless signed.
int quantise(float position, int bits, int most, bool is_signed);

/// The codes of both lines in code.mode (lines[1] only for two subsets), each the nearest one, none above
/// targets.limit. The ends of each line are swapped where swap[subset] says so. In transformed modes the offsets are
/// then clamped to what fits. Returns whether none had to be.
bool quantise_lines(const Targets& targets, const std::array<Line, 2>& lines, const std::array<bool, 2>& swap,
                    BlockCode& code);

/// The two ends of a subset on the 16-bit scale.
Ends ends_of(const BlockCode& code, int subset, bool is_signed);

/// A line's ends rounded to that scale.
Ends rounded(const Line& line, bool is_signed);

}  // namespace welkin::bc6h

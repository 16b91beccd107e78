#pragma once
#include <array>
#include <cstdint>

#include <welkin/image/codecs/bc6h/layout.h>
#include <welkin/image/codecs/bc6h/targets.h>

// The inner loops of the encoder, built for several instruction sets (parallel/target_clones.h).

namespace welkin::bc6h {

inline constexpr float forbidden = 1e15f;  // cost of a texel that can only be brighter than its block

/// Positions (unquantised endpoint codes, or rounded lines) of the two ends of one subset.
struct Ends {
  std::array<int, 3> first{}, second{};
};

/// The same between the integers.
struct Line {
  std::array<float, 3> first{}, second{};
};

/// For every texel the entry of the palette of 8 or 16 colours that is nearest on the error scale among those that
/// are not brighter than targets.limit. Returns the sum of importance * squared distance over texels with member 1
/// (member: 1 or 0). Indices are written for all lanes.
float assign(const Targets& targets, const Lanes& member, const Ends& ends, int levels, IntLanes& indices);

/// The line through the weighted mean of a subset along its principal axis, cut to the extent of its texels; weighted
/// as small errors on the error scale are.
Line principal_line(const Targets& targets, const Lanes& member);

/// The line that minimises the weighted squared error for given indices (per channel 2 x 2 normal equations);
/// `fallback` where the texels share one index.
Line least_squares(const Targets& targets, const Lanes& member, const IntLanes& indices, int levels,
                   const Line& fallback);

/// The error that lines through the two subsets of each partition would leave, estimated from second moments: what is
/// off the principal axes, plus what rounding to 8 levels leaves on them. Returns the estimate of one subset with 16
/// levels.
float rank_partitions(const Targets& targets, std::array<float, partition_count>& estimates);

/// Texels of one subset with the same index, per index: for fixed indices a channel's error is
/// sum over k of count[k] (level of palette entry k - mean[k])^2, plus a constant.
struct IndexStatistics {
  Lanes count, mean;
};
IndexStatistics index_statistics(const Lanes& level, const Lanes& member, const IntLanes& indices);

/// That sum for the ends (first, second) of one channel; `forbidden` and more when an entry in use exceeds `limit`.
float channel_cost(const float* scale, const IndexStatistics& statistics, int first, int second, int levels,
                   int limit, bool is_signed);

/// 1 for the texels of subset `subset` of a partition, else 0.
const Lanes& member_of(int partition, int subset);
/// 1 for all.
const Lanes& all_members();

}  // namespace welkin::bc6h

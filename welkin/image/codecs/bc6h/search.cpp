#include <welkin/image/codecs/bc6h/search.h>

#include <algorithm>
#include <cstdlib>

#include <welkin/image/codecs/bc6h/quantise.h>

namespace welkin::bc6h {
namespace {

const Mode& mode_of(const BlockCode& code) { return modes[static_cast<std::size_t>(code.mode)]; }

float texel_cost(const Targets& targets, const Ends& ends, int weight, int texel) {
  float cost = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const int half = half_of_position(interpolate(ends.first[c], ends.second[c], weight), targets.is_signed);
    const float d = targets.scale[half] - targets.level[c][texel];
    cost += std::abs(half) > targets.limit[c] ? forbidden : d * d;
  }
  return cost * targets.importance[texel];
}

IntLanes index_lanes(const BlockCode& code) {
  int indices[texel_count];
  for (int t = 0; t < texel_count; ++t) indices[t] = code.indices[static_cast<std::size_t>(t)];
  return load(indices);
}

bool channel_fits(const BlockCode& code, std::size_t c) {
  const Mode& mode = mode_of(code);
  if (!mode.transformed) return true;
  const int reach = 1 << (mode.delta_bits[c] - 1);
  for (std::size_t e = 1; e < static_cast<std::size_t>(2 * mode.subsets); ++e) {
    const int offset = code.endpoints[e][c] - code.endpoints[0][c];
    if (offset < -reach || offset >= reach) return false;
  }
  return true;
}

struct CodeRange {
  int low, high;
};

CodeRange code_range(const BlockCode& code, bool is_signed) {
  const int bits = mode_of(code).endpoint_bits;
  const int most = (1 << (is_signed ? bits - 1 : bits)) - 1;
  return {is_signed ? -most : 0, most};
}

// The best pair of codes for one channel of one subset with its indices as they are.
void best_pair(const Targets& targets, BlockCode& code, int subset, std::size_t c, int radius) {
  const Mode& mode = mode_of(code);
  const IndexStatistics statistics =
      index_statistics(targets.level[c], members(code, subset) * targets.importance, index_lanes(code));
  const auto e = static_cast<std::size_t>(2 * subset);
  const int first = code.endpoints[e][c], second = code.endpoints[e + 1][c];
  const CodeRange range = code_range(code, targets.is_signed);
  std::array<int, 2> best = {first, second};
  float best_cost = 8 * forbidden;
  for (int a = std::max(range.low, first - radius); a <= std::min(range.high, first + radius); ++a) {
    for (int b = std::max(range.low, second - radius); b <= std::min(range.high, second + radius); ++b) {
      code.endpoints[e][c] = a, code.endpoints[e + 1][c] = b;
      if (!channel_fits(code, c)) continue;
      const float cost =
          channel_cost(targets.scale, statistics, unquantise(a, mode.endpoint_bits, targets.is_signed),
                       unquantise(b, mode.endpoint_bits, targets.is_signed), mode.levels(), targets.limit[c],
                       targets.is_signed);
      if (cost < best_cost) best_cost = cost, best = {a, b};
    }
  }
  code.endpoints[e][c] = best[0], code.endpoints[e + 1][c] = best[1];
}

bool accept_if_better(const Targets& targets, BlockCode& code, Candidate& candidate) {
  const float cost = evaluate(targets, code);
  if (!(cost < candidate.cost)) return false;
  candidate = {code, cost};
  return true;
}

}  // namespace

const Lanes& members(const BlockCode& code, int subset) {
  return mode_of(code).subsets == 1 ? all_members() : member_of(code.partition, subset);
}

void swap_ends(BlockCode& code, int subset) {
  const auto e = static_cast<std::size_t>(2 * subset);
  std::swap(code.endpoints[e], code.endpoints[e + 1]);
  const int last = mode_of(code).levels() - 1;
  for (int t = 0; t < texel_count; ++t) {
    auto& index = code.indices[static_cast<std::size_t>(t)];
    if (subset_of(code, t) == subset) index = static_cast<std::uint8_t>(last - index);
  }
}

float settle_anchor(const Targets& targets, BlockCode& code, int subset) {
  const Mode& mode = mode_of(code);
  const int anchor = anchor_of(code, subset), half = mode.levels() / 2;
  auto& index = code.indices[static_cast<std::size_t>(anchor)];
  if (index < half) return 0;
  swap_ends(code, subset);
  if (offsets_fit(code)) return 0;
  swap_ends(code, subset);
  const Ends ends = ends_of(code, subset, targets.is_signed);
  const int* weights = mode.subsets == 2 ? weights3.data() : weights4.data();
  const float before = texel_cost(targets, ends, weights[index], anchor);
  float best = 4 * forbidden;
  for (int k = 0; k < half; ++k) {
    const float cost = texel_cost(targets, ends, weights[k], anchor);
    if (cost < best) best = cost, index = static_cast<std::uint8_t>(k);
  }
  return best - before;
}

float assign_subset(const Targets& targets, BlockCode& code, int subset) {
  IntLanes lanes;
  int indices[texel_count];
  const float cost = assign(targets, members(code, subset), ends_of(code, subset, targets.is_signed),
                            mode_of(code).levels(), lanes);
  store(lanes, indices);
  for (int t = 0; t < texel_count; ++t) {
    if (subset_of(code, t) == subset)
      code.indices[static_cast<std::size_t>(t)] = static_cast<std::uint8_t>(indices[t]);
  }
  return cost;
}

void best_pairs(const Targets& targets, BlockCode& code, int subset, int radius) {
  for (std::size_t c = 0; c < 3; ++c) best_pair(targets, code, subset, c, radius);
}

float evaluate(const Targets& targets, BlockCode& code) {
  const Mode& mode = mode_of(code);
  float cost = 0;
  for (int s = 0; s < mode.subsets; ++s) cost += assign_subset(targets, code, s);
  for (int s = 0; s < mode.subsets; ++s) cost += settle_anchor(targets, code, s);
  return cost;
}

void refit(const Targets& targets, Candidate& candidate, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    BlockCode code = candidate.code;
    const Mode& mode = mode_of(code);
    const IntLanes indices = index_lanes(code);
    std::array<Line, 2> lines;
    for (int s = 0; s < mode.subsets; ++s) {
      const Ends ends = ends_of(code, s, targets.is_signed);
      Line fallback;
      for (std::size_t c = 0; c < 3; ++c) {
        fallback.first[c] = static_cast<float>(ends.first[c]);
        fallback.second[c] = static_cast<float>(ends.second[c]);
      }
      lines[static_cast<std::size_t>(s)] =
          least_squares(targets, members(code, s), indices, mode.levels(), fallback);
    }
    quantise_lines(targets, lines, {false, false}, code);
    if (!accept_if_better(targets, code, candidate)) return;
  }
}

void refine_pairs(const Targets& targets, Candidate& candidate, int radius, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    BlockCode code = candidate.code;
    for (int s = 0; s < mode_of(code).subsets; ++s) best_pairs(targets, code, s, radius);
    if (!accept_if_better(targets, code, candidate)) return;
  }
}

void refine_single(const Targets& targets, Candidate& candidate, int rounds) {
  const CodeRange range = code_range(candidate.code, targets.is_signed);
  for (int round = 0; round < rounds; ++round) {
    bool better = false;
    for (std::size_t i = 0; i < static_cast<std::size_t>(12 * mode_of(candidate.code).subsets); ++i) {
      BlockCode code = candidate.code;
      int& value = code.endpoints[i / 6][i / 2 % 3];
      value += i % 2 == 0 ? 1 : -1;
      if (value < range.low || value > range.high || !channel_fits(code, i / 2 % 3)) continue;
      better = accept_if_better(targets, code, candidate) || better;
    }
    if (!better) return;
  }
}

}  // namespace welkin::bc6h

#include <welkin/image/codecs/bc6h/edge_pair.h>

#include <algorithm>

#include <welkin/image/codecs/bc6h/encode_block.h>
#include <welkin/image/codecs/bc6h/quantise.h>

// Four of the 32 partitions split one side of the block off: the left column is the first subset of partition 2, the top
// row of 14; the right column is the second subset of 1, the bottom row of 15. So both blocks can give their side a
// subset of its own, and its colours agree when both use ends of the same bits and codes. What is left to each block
// is the mode (of those bits), and the line through its other twelve texels, near enough for the mode's offsets.

namespace welkin::bc6h {
namespace {

constexpr std::array<int, 4> partition_of_side = {2, 1, 14, 15};
constexpr std::array<int, 4> subset_of_side = {0, 1, 0, 1};
constexpr std::array<int, 6> endpoint_bits = {11, 10, 9, 8, 7, 6};

struct Edge {
  int bits = 0;
  std::array<std::array<int, 3>, 2> ends{};  // codes
  std::array<int, 4> indices{};              // in the order of EdgeBlock::texels
  float cost = 0;                            // in one block
};

struct Rest {
  Line line;
  bool swap = false;
};

const Lanes& edge_members(const EdgeBlock& block) {
  return member_of(partition_of_side[static_cast<std::size_t>(block.side)],
                   subset_of_side[static_cast<std::size_t>(block.side)]);
}

Ends unquantised(const Edge& edge, bool is_signed) {
  Ends ends;
  for (std::size_t c = 0; c < 3; ++c) {
    ends.first[c] = unquantise(edge.ends[0][c], edge.bits, is_signed);
    ends.second[c] = unquantise(edge.ends[1][c], edge.bits, is_signed);
  }
  return ends;
}

float take_indices(const EdgeBlock& block, Edge& edge, IntLanes& lanes) {
  edge.cost =
      assign(block.targets, edge_members(block), unquantised(edge, block.targets.is_signed), 8, lanes);
  for (std::size_t i = 0; i < 4; ++i) edge.indices[i] = lanes[block.texels[i]];
  return edge.cost;
}

// All pairs of codes next to the present ones, for the indices as they are.
void refine_edge(const EdgeBlock& block, const IntLanes& lanes, Edge& edge) {
  const bool is_signed = block.targets.is_signed;
  const int most = (1 << (is_signed ? edge.bits - 1 : edge.bits)) - 1, least = is_signed ? -most : 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const IndexStatistics statistics =
        index_statistics(block.targets.level[c], edge_members(block) * block.targets.importance, lanes);
    const int first = edge.ends[0][c], second = edge.ends[1][c];
    float best = 8 * forbidden;
    for (int a = std::max(least, first - 1); a <= std::min(most, first + 1); ++a) {
      for (int b = std::max(least, second - 1); b <= std::min(most, second + 1); ++b) {
        const float cost =
            channel_cost(block.targets.scale, statistics, unquantise(a, edge.bits, is_signed),
                         unquantise(b, edge.bits, is_signed), 8, block.targets.limit[c], is_signed);
        if (cost < best) best = cost, edge.ends[0][c] = a, edge.ends[1][c] = b;
      }
    }
  }
}

// block.targets.limit holds for both blocks here.
Edge fit_edge(const EdgeBlock& block, const Line& line, int bits) {
  Edge edge;
  edge.bits = bits;
  for (std::size_t c = 0; c < 3; ++c) {
    const int most = largest_code(block.targets.limit[c], bits, block.targets.is_signed);
    edge.ends[0][c] = quantise(line.first[c], bits, most, block.targets.is_signed);
    edge.ends[1][c] = quantise(line.second[c], bits, most, block.targets.is_signed);
  }
  IntLanes lanes;
  take_indices(block, edge, lanes);
  Edge refined = edge;
  refine_edge(block, lanes, refined);
  return take_indices(block, refined, lanes) < edge.cost ? refined : edge;
}

void put_edge(const EdgeBlock& block, const Edge& edge, BlockCode& code) {
  const int subset = subset_of_side[static_cast<std::size_t>(block.side)];
  const auto e = static_cast<std::size_t>(2 * subset);
  code.endpoints[e] = edge.ends[0], code.endpoints[e + 1] = edge.ends[1];
  for (std::size_t i = 0; i < 4; ++i) {
    code.indices[static_cast<std::size_t>(block.texels[i])] = static_cast<std::uint8_t>(edge.indices[i]);
  }
  if (code.indices[static_cast<std::size_t>(anchor_of(code, subset))] >= 4) swap_ends(code, subset);
}

// Codes of the other line within reach of the edge's. False when the edge's own ends are too far apart for the mode.
bool put_rest(const EdgeBlock& block, const Rest& rest, BlockCode& code) {
  const Mode& mode = modes[static_cast<std::size_t>(code.mode)];
  const bool is_signed = block.targets.is_signed,
             edge_first = subset_of_side[static_cast<std::size_t>(block.side)] == 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const int most = largest_code(block.targets.limit[c], mode.endpoint_bits, is_signed);
    const int reach = mode.transformed ? 1 << (mode.delta_bits[c] - 1) : 1 << 20;
    int first =
        quantise(rest.swap ? rest.line.second[c] : rest.line.first[c], mode.endpoint_bits, most, is_signed);
    int second =
        quantise(rest.swap ? rest.line.first[c] : rest.line.second[c], mode.endpoint_bits, most, is_signed);
    auto& e = code.endpoints;
    if (edge_first) {
      const int low = e[0][c] - reach, high = e[0][c] + reach - 1;
      e[2][c] = std::clamp(first, low, high), e[3][c] = std::clamp(second, low, high);
    } else {
      const int low = std::max(e[2][c], e[3][c]) - reach + 1, high = std::min(e[2][c], e[3][c]) + reach;
      if (low > high) return false;
      first = std::clamp(first, low, high);
      e[0][c] = first, e[1][c] = std::clamp(second, first - reach, first + reach - 1);
    }
  }
  return offsets_fit(code);
}

// The cost of the twelve texels; a few rounds of better ends for them.
float settle_rest(const EdgeBlock& block, BlockCode& code) {
  const int subset = 1 - subset_of_side[static_cast<std::size_t>(block.side)];
  float cost = assign_subset(block.targets, code, subset) + settle_anchor(block.targets, code, subset);
  for (int round = 0; round < 2; ++round) {
    BlockCode next = code;
    best_pairs(block.targets, next, subset, 1);
    const float next_cost =
        assign_subset(block.targets, next, subset) + settle_anchor(block.targets, next, subset);
    if (!(next_cost < cost)) break;
    code = next, cost = next_cost;
  }
  return cost;
}

Candidate complete(const EdgeBlock& block, const Edge& edge, const Rest& rest) {
  Candidate best;
  for (int m = 0; m < mode_count; ++m) {
    const Mode& mode = modes[static_cast<std::size_t>(m)];
    if (mode.subsets != 2 || mode.endpoint_bits != edge.bits) continue;
    Candidate candidate;
    candidate.code.mode = m;
    candidate.code.partition = partition_of_side[static_cast<std::size_t>(block.side)];
    put_edge(block, edge, candidate.code);
    if (!put_rest(block, rest, candidate.code)) continue;
    candidate.cost = edge.cost + settle_rest(block, candidate.code);
    if (candidate.cost < best.cost) best = candidate;
  }
  return best;
}

Rest fit_rest(const EdgeBlock& block) {
  const auto side = static_cast<std::size_t>(block.side);
  const int subset = 1 - subset_of_side[side];
  const int anchor = subset == 0 ? 0 : second_anchors[static_cast<std::size_t>(partition_of_side[side])];
  Rest rest;
  fit_line(block.targets, member_of(partition_of_side[side], subset), 8, anchor, 2, rest.line, rest.swap);
  return rest;
}

}  // namespace

// Mode 30 stores all ends as they are, so with 6 bits both blocks can always be completed.
std::array<BlockCode, 2> encode_edge_pair(const std::array<EdgeBlock, 2>& blocks) {
  EdgeBlock shared = blocks[0];
  for (std::size_t c = 0; c < 3; ++c) {
    shared.targets.limit[c] = std::min(blocks[0].targets.limit[c], blocks[1].targets.limit[c]);
  }
  Line line;
  bool swap = false;
  fit_line(shared.targets, edge_members(shared), 8, shared.texels[0], 2, line, swap);
  const Rest rest_a = fit_rest(blocks[0]), rest_b = fit_rest(blocks[1]);
  std::array<BlockCode, 2> best{};
  float best_cost = 16 * forbidden;
  for (const int bits : endpoint_bits) {
    const Edge edge = fit_edge(shared, line, bits);
    const Candidate a = complete(blocks[0], edge, rest_a), b = complete(blocks[1], edge, rest_b);
    if (a.cost + b.cost < best_cost) best_cost = a.cost + b.cost, best = {a.code, b.code};
  }
  return best;
}

}  // namespace welkin::bc6h

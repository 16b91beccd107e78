#include <welkin/image/codecs/bc6h/encode_block.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include <welkin/image/codecs/bc6h/quantise.h>
#include <welkin/image/half.h>

namespace welkin::bc6h {
namespace {

/// How far each speed goes.
struct Effort {
  float enough;      // a cost that ends the search
  int partitions;    // tried in earnest, best estimate first,
  float hope;        // while their estimates are below this times the best cost,
  float slack;       // in all modes when their lines' cost is below this times the best cost
  int line_rounds;   // of least squares before quantisation
  bool all_modes;    // or only the finest that holds the ends
  int refined;       // candidates refined
  int refit_rounds;  // see refit
  int radius, pair_rounds;
  int single_rounds;  // for the best candidate
};

constexpr float unlimited = 1e30f;

// enough = 3e-6 is 48 (2.5e-4)^2: 0.025 % of a bright texel.

constexpr Effort effort_of(Bc6hSpeed speed) {
  if (speed == Bc6hSpeed::fast) return {3e-6f, 1, 0.5f, unlimited, 0, false, 1, 1, 0, 0, 0};
  if (speed == Bc6hSpeed::normal) return {0, 6, 1, 1, 1, true, 2, 2, 1, 2, 0};
  return {0, 32, unlimited, 1.1f, 2, true, 8, 2, 1, 4, 4};
}

// From the finest to the one that holds any ends.
constexpr std::array<int, 4> one_subset_modes = {13, 12, 11, 10};
constexpr std::array<int, 10> two_subset_modes = {2, 3, 4, 0, 5, 6, 7, 8, 1, 9};

struct Lines {
  std::array<Line, 2> lines;
  std::array<bool, 2> swap{};  // by the anchors' indices
  float cost = 0;              // before quantisation
};

Lines fit_lines(const Targets& targets, int subsets, int partition, int rounds) {
  Lines result;
  for (int s = 0; s < subsets; ++s) {
    const auto i = static_cast<std::size_t>(s);
    const int anchor = s == 0 ? 0 : second_anchors[static_cast<std::size_t>(partition)];
    const Lanes& member = subsets == 1 ? all_members() : member_of(partition, s);
    result.cost +=
        fit_line(targets, member, subsets == 1 ? 16 : 8, anchor, rounds, result.lines[i], result.swap[i]);
  }
  return result;
}

/// The cheapest candidates so far, cheapest first.
class Shortlist {
 public:
  explicit Shortlist(int size) : size_(static_cast<std::size_t>(size)) { entries_.reserve(size_ + 1); }
  float worst() const { return entries_.size() < size_ ? 4 * forbidden : entries_.back().cost; }
  void offer(const Candidate& candidate) {
    if (!(candidate.cost < worst())) return;
    const auto place =
        std::upper_bound(entries_.begin(), entries_.end(), candidate,
                         [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
    entries_.insert(place, candidate);
    if (entries_.size() > size_) entries_.pop_back();
  }
  std::vector<Candidate>& entries() { return entries_; }
  const Candidate& best() const { return entries_.front(); }

 private:
  std::size_t size_;
  std::vector<Candidate> entries_;
};

template <std::size_t count>
void try_modes(const Targets& targets, const Lines& fit, int partition, const std::array<int, count>& order,
               bool all, Shortlist& list) {
  for (int mode : order) {
    Candidate candidate;
    candidate.code.mode = mode;
    candidate.code.partition = partition;
    const bool fits = quantise_lines(targets, fit.lines, fit.swap, candidate.code);
    if (!fits && !all) continue;
    candidate.cost = evaluate(targets, candidate.code);
    list.offer(candidate);
    if (fits && !all) return;
  }
}

// The `count` partitions of the lowest estimates come first, in order.
std::array<int, partition_count> by_estimate(const std::array<float, partition_count>& estimates, int count) {
  std::array<int, partition_count> order{};
  std::iota(order.begin(), order.end(), 0);
  std::partial_sort(order.begin(), order.begin() + count, order.end(), [&](int a, int b) {
    const float ea = estimates[static_cast<std::size_t>(a)], eb = estimates[static_cast<std::size_t>(b)];
    return ea < eb || (ea == eb && a < b);
  });
  return order;
}

void try_partitions(const Targets& targets, const Effort& effort, Shortlist& list) {
  std::array<float, partition_count> estimates{};
  rank_partitions(targets, estimates);
  const std::array<int, partition_count> order = by_estimate(estimates, effort.partitions);
  for (int i = 0; i < effort.partitions; ++i) {
    const int partition = order[static_cast<std::size_t>(i)];
    if (estimates[static_cast<std::size_t>(partition)] > effort.hope * list.best().cost) break;
    const Lines fit = fit_lines(targets, 2, partition, effort.line_rounds);
    if (effort.line_rounds > 0 && fit.cost > effort.slack * list.best().cost) continue;
    try_modes(targets, fit, partition, two_subset_modes, effort.all_modes, list);
  }
}

}  // namespace

float fit_line(const Targets& targets, const Lanes& member, int levels, int anchor, int rounds, Line& line,
               bool& swap) {
  line = principal_line(targets, member);
  IntLanes indices;
  float cost = assign(targets, member, rounded(line, targets.is_signed), levels, indices);
  if (rounds == 0) line = least_squares(targets, member, indices, levels, line);
  for (int round = 0; round < rounds; ++round) {
    const Line next = least_squares(targets, member, indices, levels, line);
    IntLanes next_indices;
    const float next_cost = assign(targets, member, rounded(next, targets.is_signed), levels, next_indices);
    if (next_cost >= cost) break;
    cost = next_cost, line = next, indices = next_indices;
  }
  swap = indices[anchor] >= levels / 2;
  return cost;
}

Candidate encode(const Targets& targets, Bc6hSpeed speed) {
  const Effort effort = effort_of(speed);
  Shortlist list(effort.refined);
  const Lines fit = fit_lines(targets, 1, 0, effort.line_rounds);
  try_modes(targets, fit, 0, one_subset_modes, effort.all_modes, list);
  if (list.best().cost <= effort.enough) return list.best();
  try_partitions(targets, effort, list);
  Candidate best;
  for (Candidate& candidate : list.entries()) {
    refit(targets, candidate, effort.refit_rounds);
    if (effort.pair_rounds > 0) refine_pairs(targets, candidate, effort.radius, effort.pair_rounds);
    if (candidate.cost < best.cost) best = candidate;
  }
  refine_single(targets, best, effort.single_rounds);
  return best;
}

Candidate encode(const int halves[48], const Bc6hOptions& options, const ErrorScale& linear) {
  const auto logarithmic = error_scale();
  const Targets plain = make_targets(halves, equal_importance, options.is_signed, logarithmic->values());
  const Candidate by_logarithm = encode(plain, options.speed);
  const int brightest = *std::max_element(plain.limit.begin(), plain.limit.end());
  if (!(options.linear_above > 0) ||
      static_cast<double>(float_from_half(static_cast<std::uint16_t>(brightest))) <= options.linear_above)
    return by_logarithm;
  const Targets targets = make_targets(halves, equal_importance, options.is_signed, linear.values());
  const Effort effort = effort_of(options.speed);
  Candidate other = by_logarithm;
  other.cost = evaluate(targets, other.code);
  refit(targets, other, effort.refit_rounds);
  if (effort.pair_rounds > 0) refine_pairs(targets, other, effort.radius, effort.pair_rounds);
  refine_single(targets, other, std::max(1, effort.single_rounds));
  const Candidate direct = encode(targets, options.speed);
  return direct.cost < other.cost ? direct : other;
}

}  // namespace welkin::bc6h

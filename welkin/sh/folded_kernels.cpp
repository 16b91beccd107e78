#include <welkin/sh/folded_kernels.h>

#include <algorithm>
#include <cstring>

#include <welkin/parallel/target_clones.h>

#define WELKIN_INLINE inline __attribute__((always_inline))

namespace welkin {
namespace {

// A block is three of these. Compilers split them into what the machine has.
using Lanes = float __attribute__((vector_size(64)));
constexpr int lane_count = 16, vectors = FloatBlock::size / lane_count, block_floats = FloatBlock::size;

WELKIN_INLINE Lanes load(const float* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}
WELKIN_INLINE void store(float* to, const Lanes& lanes) { std::memcpy(to, &lanes, sizeof lanes); }

// Where the two rows of a pair begin: y and size - 1 - y of a cube's face, or row y of the left and the right disc.
// The middle row of an odd face is paired with itself.
struct Pair {
  std::size_t first, second;
};

WELKIN_INLINE Pair row_pair(const FoldedTable& table, int part, int row) {
  const std::size_t floats = table.row_floats;
  if (table.shape.mapping == Mapping::cube) {
    const std::size_t size = table.shape.width, top = part * size;
    return {(top + row) * floats, (top + size - 1 - row) * floats};
  }
  return {2 * row * floats, (2 * static_cast<std::size_t>(row) + 1) * floats};
}

// even = p + q, odd = p - q. The last block's padding stays zero, as it was in scratch from the start.
WELKIN_INLINE void fold(const float* p, const float* q, int floats, FloatBlock* even, FloatBlock* odd) {
  const int whole = floats / block_floats;
  for (int block = 0; block < whole; ++block) {
    for (int i = 0; i < vectors; ++i) {
      const int at = block * block_floats + i * lane_count;
      const Lanes a = load(p + at), b = load(q + at);
      store(&even[block].lanes[i * lane_count], a + b);
      store(&odd[block].lanes[i * lane_count], a - b);
    }
  }
  for (int i = whole * block_floats; i < floats; ++i) {
    even[whole].lanes[i - whole * block_floats] = p[i] + q[i];
    odd[whole].lanes[i - whole * block_floats] = p[i] - q[i];
  }
}

// `Count` functions at once, so that a block of the row is loaded once for all of them and their sums stay in
// registers along the row.
template <int Count>
WELKIN_INLINE void dot_group(const FloatBlock* row, int blocks, const FloatBlock* table, int stride,
                             FloatBlock* sums) {
  Lanes sum[Count][vectors];
  for (int k = 0; k < Count; ++k)
    for (int i = 0; i < vectors; ++i) sum[k][i] = load(&sums[k].lanes[i * lane_count]);
  for (int block = 0; block < blocks; ++block, table += stride) {
    for (int i = 0; i < vectors; ++i) {
      const Lanes value = load(&row[block].lanes[i * lane_count]);
      for (int k = 0; k < Count; ++k) sum[k][i] += value * load(&table[k].lanes[i * lane_count]);
    }
  }
  for (int k = 0; k < Count; ++k)
    for (int i = 0; i < vectors; ++i) store(&sums[k].lanes[i * lane_count], sum[k][i]);
}

WELKIN_INLINE void dot_rows(const FloatBlock* row, int blocks, const FloatBlock* table, int stride, int count,
                            FloatBlock* sums) {
  int k = 0;
  for (; k + 6 <= count; k += 6) dot_group<6>(row, blocks, table + k, stride, sums + k);
  for (; k + 3 <= count; k += 3) dot_group<3>(row, blocks, table + k, stride, sums + k);
  for (; k < count; ++k) dot_group<1>(row, blocks, table + k, stride, sums + k);
}

// Three vectors: a block in registers.
struct Registers {
  Lanes lanes[vectors]{};

  WELKIN_INLINE void add(float factor, const FloatBlock& block) {
    for (int i = 0; i < vectors; ++i) lanes[i] += factor * load(&block.lanes[i * lane_count]);
  }
  WELKIN_INLINE void add_product(const FloatBlock& a, const FloatBlock& b) {
    for (int i = 0; i < vectors; ++i)
      lanes[i] += load(&a.lanes[i * lane_count]) * load(&b.lanes[i * lane_count]);
  }
  WELKIN_INLINE void store_to(float* to) const {
    for (int i = 0; i < vectors; ++i) store(to + i * lane_count, lanes[i]);
  }
};

// The first `count` numbers of a block that may be a row's last.
WELKIN_INLINE void store_part(const Registers& block, float* to, int count) {
  if (count >= block_floats) return block.store_to(to);
  FloatBlock whole;
  block.store_to(whole.lanes.data());
  std::copy_n(whole.lanes.data(), count, to);
}

}  // namespace

// Rows outside, faces inside: a row of the table stays in the nearest cache for all six faces.
WELKIN_TARGET_CLONES
void add_folded_rows(const FoldedTable& table, const float* texels, FloatBlock* scratch, FloatBlock* sums) {
  const int functions = table.functions();
  FloatBlock *even = scratch, *odd = scratch + table.blocks;
  for (int row = 0; row < table.rows; ++row) {
    const FloatBlock* values = table.values.data() + static_cast<std::size_t>(row) * table.blocks * functions;
    for (int part = 0; part < table.parts; ++part) {
      const Pair pair = row_pair(table, part, row);
      fold(texels + pair.first, texels + pair.second, table.row_floats, even, odd);
      FloatBlock* sum = sums + part * functions;
      dot_rows(even, table.blocks, values, functions, table.even, sum);
      dot_rows(odd, table.blocks, values + table.even, functions, table.odd, sum + table.even);
    }
  }
}

WELKIN_TARGET_CLONES
void harmonics_of_moments(const FoldedTable& table, const FloatBlock* moments, FloatBlock* harmonics) {
  const int functions = table.functions(), all = table.parts * functions;
  const float* basis = table.basis.data();
  for (int lm = 0; lm < functions; ++lm) {
    Registers sum;
    for (int k = 0; k < all; ++k) sum.add(*basis++, moments[k]);
    sum.store_to(harmonics[lm].lanes.data());
  }
}

WELKIN_TARGET_CLONES
void factors_of_harmonics(const FoldedTable& table, const FloatBlock* harmonics, int known,
                          FloatBlock* factors) {
  const int functions = table.functions(), all = table.parts * functions;
  for (int k = 0; k < all; ++k) {
    Registers sum;
    for (int lm = 0; lm < known; ++lm)
      sum.add(table.basis[static_cast<std::size_t>(lm) * all + k], harmonics[lm]);
    sum.store_to(factors[k].lanes.data());
  }
}

WELKIN_TARGET_CLONES
void write_unfolded_rows(const FoldedTable& table, const FloatBlock* factors, float* texels) {
  const int functions = table.functions();
  for (int row = 0; row < table.rows; ++row) {
    for (int part = 0; part < table.parts; ++part) {
      const Pair pair = row_pair(table, part, row);
      const FloatBlock* values =
          table.values.data() + static_cast<std::size_t>(row) * table.blocks * functions;
      const FloatBlock* factor = factors + part * functions;
      for (int block = 0; block < table.blocks; ++block, values += functions) {
        Registers even, odd, first, second;
        for (int k = 0; k < table.even; ++k) even.add_product(factor[k], values[k]);
        for (int k = table.even; k < functions; ++k) odd.add_product(factor[k], values[k]);
        for (int i = 0; i < vectors; ++i) {
          first.lanes[i] = even.lanes[i] + odd.lanes[i];
          second.lanes[i] = even.lanes[i] - odd.lanes[i];
        }
        const int at = block * block_floats, count = table.row_floats - at;
        store_part(first, texels + pair.first + at, count);
        store_part(second, texels + pair.second + at, count);
      }
    }
  }
}

}  // namespace welkin

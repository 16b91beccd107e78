#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include <welkin/sh/lookup.h>

// The look-up tables of lookup.h for every frame: projection to coefficients and back in microseconds, on one core,
// with the same results to float rounding (relative error about 1e-6 of the largest coefficient or texel).
//
// A small table serves all faces. On every face of a cube, Y_lm is a combination of the same (L + 1)^2 functions
//   P_a(s) P_b(t) / r^p,  r^2 = 1 + s^2 + t^2,  p = L or L - 1,  a + b <= p
// (the derivation is in folded_lookup.cpp), so faces are reduced to these moments by one table, and the moments to
// coefficients by one small matrix per face. Half of the table is left out because b even or odd says what
// exchanging the rows t and -t does: rows are added and subtracted first ("folded"), and each function meets only one
// of the two. The discs of a dual paraboloid fold onto each other in the same way, by l + m even or odd.

namespace welkin {

/// 48 numbers: whole pixels of 1, 2, 3 or 4 interleaved channels, and whole vector registers.
struct alignas(64) FloatBlock {
  static constexpr int size = 48;
  std::array<float, size> lanes{};
};

/// Functions tabulated over folded rows, each value repeated for every channel so that interleaved rows are used as
/// they are: values[(row * blocks + block) * functions() + function], even functions before odd ones, rows padded
/// with zeros.
struct FoldedTable {
  MapShape shape;
  int max_degree = 0;
  int channels = 3;
  int parts = 0;       ///< 6 faces of a cube, 1 pair of discs
  int rows = 0;        ///< pairs of rows in a part
  int row_floats = 0;  ///< numbers in a row of a part: channels * size
  int blocks = 0;      ///< FloatBlocks in a row
  int even = 0, odd = 0;
  std::vector<FloatBlock> values;
  /// basis[(lm * parts + part) * functions() + k]: Y_lm on a part = sum over k of this times function k.
  std::vector<float> basis;

  int functions() const { return even + odd; }
};

struct ShProjectionTable {
  FoldedTable folded;
};
struct ShSynthesisTable {
  FoldedTable folded;
};

/// For cubes and dual paraboloids (other mappings throw Error), degrees 0 .. max_lookup_degree, 1 to 4 channels.
/// 64 x 64 x 6 RGB at degree 2 takes 216 KiB.
ShProjectionTable make_sh_projection_table(MapShape shape, int max_degree = 2, int channels = 3,
                                           TexelRule rule = TexelRule::centre);
ShSynthesisTable make_sh_synthesis_table(MapShape shape, int max_degree = 2, int channels = 3);

/// For a cube of `size` texels along an edge.
ShProjectionTable make_sh_projection_table(int cube_size, int max_degree = 2, int channels = 3,
                                           TexelRule rule = TexelRule::centre);
ShSynthesisTable make_sh_synthesis_table(int cube_size, int max_degree = 2, int channels = 3);

/// Coefficients of the radiance, as project_map gives them; `out` is overwritten and its memory used again. Runs on the
/// calling thread. Throws Error unless shape and channels are those of the table.
void project(const ShProjectionTable& table, const Cube& radiance, ShCoefficients& out);
void project(const ShProjectionTable& table, const SphereMap& radiance, ShCoefficients& out);

/// The function at all texel centres, as synthesize of lookup.h; `out` gets the table's size (its memory is used
/// again). The coefficients must have the table's channels (else throws Error); degrees that they lack count as 0,
/// degrees above the table's are left out.
void synthesize(const ShSynthesisTable& table, const ShCoefficients& coefficients, Cube& out);
void synthesize(const ShSynthesisTable& table, const ShCoefficients& coefficients, SphereMap& out);

}  // namespace welkin

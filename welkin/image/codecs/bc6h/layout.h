#pragma once
#include <array>
#include <cstdint>
#include <string_view>

// The tables of BC6H, after Khronos Data Format Specification 1.3, section 20.2 (and 20.1 for what BC7 shares).

namespace welkin::bc6h {

inline constexpr int mode_count = 14;
inline constexpr int partition_count = 32;
inline constexpr int texel_count = 16;

/// One of the 14 modes. Endpoints 0 and 1 belong to the first subset, 2 and 3 to the second. `transformed`:
/// endpoints 1 to 3 are stored as two's complement offsets of delta_bits from endpoint 0.
struct Mode {
  int number;  // what the lowest 2 or 5 bits of the block hold
  int number_bits;
  int subsets;
  bool transformed;
  int endpoint_bits;
  std::array<int, 3> delta_bits;  // r g b; equal to endpoint_bits where not transformed
  std::string_view layout;        // the bits after the mode number: channel, endpoint, first and last bit

  constexpr int index_bits() const { return subsets == 2 ? 3 : 4; }
  constexpr int levels() const { return 1 << index_bits(); }
};

inline constexpr std::array<Mode, mode_count> modes = {{
    {0,
     2,
     2,
     true,
     10,
     {5, 5, 5},
     "g2:4 b2:4 b3:4 r0:9-0 g0:9-0 b0:9-0 r1:4-0 g3:4 g2:3-0 g1:4-0 b3:0 g3:3-0 b1:4-0 b3:1 b2:3-0 "
     "r2:4-0 b3:2 r3:4-0 b3:3"},
    {1,
     2,
     2,
     true,
     7,
     {6, 6, 6},
     "g2:5 g3:4 g3:5 r0:6-0 b3:0 b3:1 b2:4 g0:6-0 b2:5 b3:2 g2:4 b0:6-0 b3:3 b3:5 b3:4 r1:5-0 g2:3-0 "
     "g1:5-0 g3:3-0 b1:5-0 b2:3-0 r2:5-0 r3:5-0"},
    {2,
     5,
     2,
     true,
     11,
     {5, 4, 4},
     "r0:9-0 g0:9-0 b0:9-0 r1:4-0 r0:10 g2:3-0 g1:3-0 g0:10 b3:0 g3:3-0 b1:3-0 b0:10 b3:1 b2:3-0 "
     "r2:4-0 b3:2 r3:4-0 b3:3"},
    {6,
     5,
     2,
     true,
     11,
     {4, 5, 4},
     "r0:9-0 g0:9-0 b0:9-0 r1:3-0 r0:10 g3:4 g2:3-0 g1:4-0 g0:10 g3:3-0 b1:3-0 b0:10 b3:1 b2:3-0 "
     "r2:3-0 b3:0 b3:2 r3:3-0 g2:4 b3:3"},
    {10,
     5,
     2,
     true,
     11,
     {4, 4, 5},
     "r0:9-0 g0:9-0 b0:9-0 r1:3-0 r0:10 b2:4 g2:3-0 g1:3-0 g0:10 b3:0 g3:3-0 b1:4-0 b0:10 b2:3-0 "
     "r2:3-0 b3:1 b3:2 r3:3-0 b3:4 b3:3"},
    {14,
     5,
     2,
     true,
     9,
     {5, 5, 5},
     "r0:8-0 b2:4 g0:8-0 g2:4 b0:8-0 b3:4 r1:4-0 g3:4 g2:3-0 g1:4-0 b3:0 g3:3-0 b1:4-0 b3:1 b2:3-0 "
     "r2:4-0 b3:2 r3:4-0 b3:3"},
    {18,
     5,
     2,
     true,
     8,
     {6, 5, 5},
     "r0:7-0 g3:4 b2:4 g0:7-0 b3:2 g2:4 b0:7-0 b3:3 b3:4 r1:5-0 g2:3-0 g1:4-0 b3:0 g3:3-0 b1:4-0 b3:1 "
     "b2:3-0 r2:5-0 r3:5-0"},
    {22,
     5,
     2,
     true,
     8,
     {5, 6, 5},
     "r0:7-0 b3:0 b2:4 g0:7-0 g2:5 g2:4 b0:7-0 g3:5 b3:4 r1:4-0 g3:4 g2:3-0 g1:5-0 g3:3-0 b1:4-0 b3:1 "
     "b2:3-0 r2:4-0 b3:2 r3:4-0 b3:3"},
    {26,
     5,
     2,
     true,
     8,
     {5, 5, 6},
     "r0:7-0 b3:1 b2:4 g0:7-0 b2:5 g2:4 b0:7-0 b3:5 b3:4 r1:4-0 g3:4 g2:3-0 g1:4-0 b3:0 g3:3-0 b1:5-0 "
     "b2:3-0 r2:4-0 b3:2 r3:4-0 b3:3"},
    {30,
     5,
     2,
     false,
     6,
     {6, 6, 6},
     "r0:5-0 g3:4 b3:0 b3:1 b2:4 g0:5-0 g2:5 b2:5 b3:2 g2:4 b0:5-0 g3:5 b3:3 b3:5 b3:4 r1:5-0 g2:3-0 "
     "g1:5-0 g3:3-0 b1:5-0 b2:3-0 r2:5-0 r3:5-0"},
    {3, 5, 1, false, 10, {10, 10, 10}, "r0:9-0 g0:9-0 b0:9-0 r1:9-0 g1:9-0 b1:9-0"},
    {7, 5, 1, true, 11, {9, 9, 9}, "r0:9-0 g0:9-0 b0:9-0 r1:8-0 r0:10 g1:8-0 g0:10 b1:8-0 b0:10"},
    {11, 5, 1, true, 12, {8, 8, 8}, "r0:9-0 g0:9-0 b0:9-0 r1:7-0 r0:10-11 g1:7-0 g0:10-11 b1:7-0 b0:10-11"},
    {15, 5, 1, true, 16, {4, 4, 4}, "r0:9-0 g0:9-0 b0:9-0 r1:3-0 r0:10-15 g1:3-0 g0:10-15 b1:3-0 b0:10-15"},
}};

/// Where one bit of a block goes: bit `bit` of endpoint `endpoint` of channel `channel`.
struct BitPlace {
  std::uint8_t channel, endpoint, bit;
};

/// The places of all endpoint bits of a mode in the order of the block, from the bit after the mode number on.
struct BitPlaces {
  std::array<BitPlace, 75> places{};
  int count = 0;
};

// Reads "r0:9-0 ...": the block holds bits 0 to 9 there, lowest first; "10-15" means highest first.
constexpr BitPlaces parse_layout(std::string_view text) {
  BitPlaces result;
  std::size_t at = 0;
  const auto number = [&] {
    int value = 0;
    for (; at < text.size() && text[at] >= '0' && text[at] <= '9'; ++at)
      value = 10 * value + (text[at] - '0');
    return value;
  };
  while (at < text.size()) {
    const int channel = text[at] == 'r' ? 0 : (text[at] == 'g' ? 1 : 2);
    const int endpoint = text[at + 1] - '0';
    at += 3;
    const int high = number();
    int low = high;
    if (at < text.size() && text[at] == '-') ++at, low = number();
    const int step = low <= high ? 1 : -1;
    for (int bit = low; bit != high + step; bit += step) {
      result.places[static_cast<std::size_t>(result.count++)] = {static_cast<std::uint8_t>(channel),
                                                                 static_cast<std::uint8_t>(endpoint),
                                                                 static_cast<std::uint8_t>(bit)};
    }
    if (at < text.size()) ++at;
  }
  return result;
}

constexpr std::array<BitPlaces, mode_count> all_bit_places() {
  std::array<BitPlaces, mode_count> all{};
  for (std::size_t i = 0; i < modes.size(); ++i) all[i] = parse_layout(modes[i].layout);
  return all;
}

inline constexpr std::array<BitPlaces, mode_count> bit_places = all_bit_places();

/// Bit t of partitions[p]: whether texel t (row by row) belongs to the second subset.
inline constexpr std::array<std::uint16_t, partition_count> partitions = {
    0xcccc, 0x8888, 0xeeee, 0xecc8, 0xc880, 0xfeec, 0xfec8, 0xec80, 0xc800, 0xffec, 0xfe80,
    0xe800, 0xffe8, 0xff00, 0xfff0, 0xf000, 0xf710, 0x008e, 0x7100, 0x08ce, 0x008c, 0x7310,
    0x3100, 0x8cce, 0x088c, 0x3110, 0x6666, 0x366c, 0x17e8, 0x0ff0, 0x718e, 0x399c};

/// The texel of the second subset whose highest index bit is 0 and not stored; in the first subset it is texel 0.
inline constexpr std::array<std::uint8_t, partition_count> second_anchors = {
    15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15,
    15, 2,  8,  2,  2,  8,  8,  15, 2,  8,  2,  2,  8,  8,  2,  2};

/// Interpolation weights of the second endpoint, of 64.
inline constexpr std::array<int, 8> weights3 = {0, 9, 18, 27, 37, 46, 55, 64};
inline constexpr std::array<int, 16> weights4 = {0, 4, 9, 13, 17, 21, 26, 30, 34, 38, 43, 47, 51, 55, 60, 64};

/// An endpoint code (two's complement when is_signed) on the 16-bit scale where colours are interpolated: unsigned
/// 0 to 0xffff, signed -0x8000 to 0x7fff.
constexpr int unquantise(int code, int bits, bool is_signed) {
  if (!is_signed) {
    if (bits >= 15) return code;
    if (code == 0) return 0;
    if (code == (1 << bits) - 1) return 0xffff;
    return ((code << 15) + 0x4000) >> (bits - 1);
  }
  if (bits >= 16) return code;
  const int magnitude = code < 0 ? -code : code;
  if (magnitude == 0) return 0;
  const int value = magnitude >= (1 << (bits - 1)) - 1 ? 0x7fff : ((magnitude << 15) + 0x4000) >> (bits - 1);
  return code < 0 ? -value : value;
}

constexpr int interpolate(int e0, int e1, int weight) { return ((64 - weight) * e0 + weight * e1 + 32) >> 6; }

/// A position on that scale as the magnitude bits of a half, negative for a negative one: unsigned (i 31) >> 6, signed
/// (|i| 31) >> 5.
constexpr int half_of_position(int position, bool is_signed) {
  const int magnitude = ((position < 0 ? -position : position) * 31) >> (is_signed ? 5 : 6);
  return position < 0 ? -magnitude : magnitude;
}

}  // namespace welkin::bc6h

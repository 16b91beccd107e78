#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <welkin/image/codecs/bc6h/bc6h.h>

// A second decoder for BC6H, written for the tests from the other form in which the Khronos Data Format Specification
// 1.3 gives the format: bit by bit (tables of the lower and upper bits), partitions as pictures, weights and steps by
// their formulas. Slow and plain.

namespace welkin {

struct ReferenceMode {
  int number;
  const char*
      bits;  // of the block after the mode number, lowest first: channel, endpoint, bit of the endpoint
};

inline const std::array<ReferenceMode, 14> reference_modes = {{
    {0,
     "g24 b24 b34 r00 r01 r02 r03 r04 r05 r06 r07 r08 r09 g00 g01 g02 g03 g04 g05 g06 g07 g08 g09 "
     "b00 b01 b02 b03 b04 b05 b06 b07 b08 b09 r10 r11 r12 r13 r14 g34 g20 g21 g22 g23 g10 g11 g12 "
     "g13 g14 b30 g30 g31 g32 g33 b10 b11 b12 b13 b14 b31 b20 b21 b22 b23 r20 r21 r22 r23 r24 b32 "
     "r30 r31 r32 r33 r34 b33"},
    {1,
     "g25 g34 g35 r00 r01 r02 r03 r04 r05 r06 b30 b31 b24 g00 g01 g02 g03 g04 g05 g06 b25 b32 g24 "
     "b00 b01 b02 b03 b04 b05 b06 b33 b35 b34 r10 r11 r12 r13 r14 r15 g20 g21 g22 g23 g10 g11 g12 "
     "g13 g14 g15 g30 g31 g32 g33 b10 b11 b12 b13 b14 b15 b20 b21 b22 b23 r20 r21 r22 r23 r24 r25 "
     "r30 r31 r32 r33 r34 r35"},
    {2,
     "r00 r01 r02 r03 r04 r05 r06 r07 r08 r09 g00 g01 g02 g03 g04 g05 g06 g07 g08 g09 b00 b01 b02 "
     "b03 b04 b05 b06 b07 b08 b09 r10 r11 r12 r13 r14 r010 g20 g21 g22 g23 g10 g11 g12 g13 g010 "
     "b30 g30 g31 g32 g33 b10 b11 b12 b13 b010 b31 b20 b21 b22 b23 r20 r21 r22 r23 r24 b32 r30 r31 "
     "r32 r33 r34 b33"},
    {6,
     "r00 r01 r02 r03 r04 r05 r06 r07 r08 r09 g00 g01 g02 g03 g04 g05 g06 g07 g08 g09 b00 b01 b02 "
     "b03 b04 b05 b06 b07 b08 b09 r10 r11 r12 r13 r010 g34 g20 g21 g22 g23 g10 g11 g12 g13 g14 "
     "g010 g30 g31 g32 g33 b10 b11 b12 b13 b010 b31 b20 b21 b22 b23 r20 r21 r22 r23 b30 b32 r30 "
     "r31 r32 r33 g24 b33"},
    {10,
     "r00 r01 r02 r03 r04 r05 r06 r07 r08 r09 g00 g01 g02 g03 g04 g05 g06 g07 g08 g09 b00 b01 b02 "
     "b03 b04 b05 b06 b07 b08 b09 r10 r11 r12 r13 r010 b24 g20 g21 g22 g23 g10 g11 g12 g13 g010 "
     "b30 g30 g31 g32 g33 b10 b11 b12 b13 b14 b010 b20 b21 b22 b23 r20 r21 r22 r23 b31 b32 r30 r31 "
     "r32 r33 b34 b33"},
    {14,
     "r00 r01 r02 r03 r04 r05 r06 r07 r08 b24 g00 g01 g02 g03 g04 g05 g06 g07 g08 g24 b00 b01 b02 "
     "b03 b04 b05 b06 b07 b08 b34 r10 r11 r12 r13 r14 g34 g20 g21 g22 g23 g10 g11 g12 g13 g14 b30 "
     "g30 g31 g32 g33 b10 b11 b12 b13 b14 b31 b20 b21 b22 b23 r20 r21 r22 r23 r24 b32 r30 r31 r32 "
     "r33 r34 b33"},
    {18,
     "r00 r01 r02 r03 r04 r05 r06 r07 g34 b24 g00 g01 g02 g03 g04 g05 g06 g07 b32 g24 b00 b01 b02 "
     "b03 b04 b05 b06 b07 b33 b34 r10 r11 r12 r13 r14 r15 g20 g21 g22 g23 g10 g11 g12 g13 g14 b30 "
     "g30 g31 g32 g33 b10 b11 b12 b13 b14 b31 b20 b21 b22 b23 r20 r21 r22 r23 r24 r25 r30 r31 r32 "
     "r33 r34 r35"},
    {22,
     "r00 r01 r02 r03 r04 r05 r06 r07 b30 b24 g00 g01 g02 g03 g04 g05 g06 g07 g25 g24 b00 b01 b02 "
     "b03 b04 b05 b06 b07 g35 b34 r10 r11 r12 r13 r14 g34 g20 g21 g22 g23 g10 g11 g12 g13 g14 g15 "
     "g30 g31 g32 g33 b10 b11 b12 b13 b14 b31 b20 b21 b22 b23 r20 r21 r22 r23 r24 b32 r30 r31 r32 "
     "r33 r34 b33"},
    {26,
     "r00 r01 r02 r03 r04 r05 r06 r07 b31 b24 g00 g01 g02 g03 g04 g05 g06 g07 b25 g24 b00 b01 b02 "
     "b03 b04 b05 b06 b07 b35 b34 r10 r11 r12 r13 r14 g34 g20 g21 g22 g23 g10 g11 g12 g13 g14 b30 "
     "g30 g31 g32 g33 b10 b11 b12 b13 b14 b15 b20 b21 b22 b23 r20 r21 r22 r23 r24 b32 r30 r31 r32 "
     "r33 r34 b33"},
    {30,
     "r00 r01 r02 r03 r04 r05 g34 b30 b31 b24 g00 g01 g02 g03 g04 g05 g25 b25 b32 g24 b00 b01 b02 "
     "b03 b04 b05 g35 b33 b35 b34 r10 r11 r12 r13 r14 r15 g20 g21 g22 g23 g10 g11 g12 g13 g14 g15 "
     "g30 g31 g32 g33 b10 b11 b12 b13 b14 b15 b20 b21 b22 b23 r20 r21 r22 r23 r24 r25 r30 r31 r32 "
     "r33 r34 r35"},
    {3,
     "r00 r01 r02 r03 r04 r05 r06 r07 r08 r09 g00 g01 g02 g03 g04 g05 g06 g07 g08 g09 b00 b01 b02 "
     "b03 b04 b05 b06 b07 b08 b09 r10 r11 r12 r13 r14 r15 r16 r17 r18 r19 g10 g11 g12 g13 g14 g15 "
     "g16 g17 g18 g19 b10 b11 b12 b13 b14 b15 b16 b17 b18 b19"},
    {7,
     "r00 r01 r02 r03 r04 r05 r06 r07 r08 r09 g00 g01 g02 g03 g04 g05 g06 g07 g08 g09 b00 b01 b02 "
     "b03 b04 b05 b06 b07 b08 b09 r10 r11 r12 r13 r14 r15 r16 r17 r18 r010 g10 g11 g12 g13 g14 g15 "
     "g16 g17 g18 g010 b10 b11 b12 b13 b14 b15 b16 b17 b18 b010"},
    {11,
     "r00 r01 r02 r03 r04 r05 r06 r07 r08 r09 g00 g01 g02 g03 g04 g05 g06 g07 g08 g09 b00 b01 b02 "
     "b03 b04 b05 b06 b07 b08 b09 r10 r11 r12 r13 r14 r15 r16 r17 r011 r010 g10 g11 g12 g13 g14 "
     "g15 g16 g17 g011 g010 b10 b11 b12 b13 b14 b15 b16 b17 b011 b010"},
    {15,
     "r00 r01 r02 r03 r04 r05 r06 r07 r08 r09 g00 g01 g02 g03 g04 g05 g06 g07 g08 g09 b00 b01 b02 "
     "b03 b04 b05 b06 b07 b08 b09 r10 r11 r12 r13 r015 r014 r013 r012 r011 r010 g10 g11 g12 g13 "
     "g015 g014 g013 g012 g011 g010 b10 b11 b12 b13 b015 b014 b013 b012 b011 b010"},
}};

struct ReferenceFacts {
  int endpoint_bits;
  std::array<int, 3> delta_bits;  // 0: not transformed
};

/// In the order of reference_modes.
inline const std::array<ReferenceFacts, 14> reference_facts = {{{10, {5, 5, 5}},
                                                                {7, {6, 6, 6}},
                                                                {11, {5, 4, 4}},
                                                                {11, {4, 5, 4}},
                                                                {11, {4, 4, 5}},
                                                                {9, {5, 5, 5}},
                                                                {8, {6, 5, 5}},
                                                                {8, {5, 6, 5}},
                                                                {8, {5, 5, 6}},
                                                                {6, {0, 0, 0}},
                                                                {10, {0, 0, 0}},
                                                                {11, {9, 9, 9}},
                                                                {12, {8, 8, 8}},
                                                                {16, {4, 4, 4}}}};

inline const std::array<const char*, 32> reference_partitions = {
    "0011 0011 0011 0011", "0001 0001 0001 0001", "0111 0111 0111 0111", "0001 0011 0011 0111",
    "0000 0001 0001 0011", "0011 0111 0111 1111", "0001 0011 0111 1111", "0000 0001 0011 0111",
    "0000 0000 0001 0011", "0011 0111 1111 1111", "0000 0001 0111 1111", "0000 0000 0001 0111",
    "0001 0111 1111 1111", "0000 0000 1111 1111", "0000 1111 1111 1111", "0000 0000 0000 1111",
    "0000 1000 1110 1111", "0111 0001 0000 0000", "0000 0000 1000 1110", "0111 0011 0001 0000",
    "0011 0001 0000 0000", "0000 1000 1100 1110", "0000 0000 1000 1100", "0111 0011 0011 0001",
    "0011 0001 0001 0000", "0000 1000 1000 1100", "0110 0110 0110 0110", "0011 0110 0110 1100",
    "0001 0111 1110 1000", "0000 1111 1111 0000", "0111 0001 1000 1110", "0011 1001 1001 1100",
};

inline const std::array<int, 32> reference_anchors = {15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15,
                                                      15, 15, 15, 15, 15, 15, 2,  8,  2,  2,  8,
                                                      8,  15, 2,  8,  2,  2,  8,  8,  2,  2};

inline int reference_bit(const Bc6hBlock& block, int at) { return (block.at(at / 8) >> (at % 8)) & 1; }

inline int reference_bits(const Bc6hBlock& block, int at, int count) {
  int value = 0;
  for (int i = 0; i < count; ++i) value |= reference_bit(block, at + i) << i;
  return value;
}

inline std::int64_t reference_sign_extend(std::int64_t value, int bits) {
  value &= (std::int64_t{1} << bits) - 1;
  return value >= std::int64_t{1} << (bits - 1) ? value - (std::int64_t{1} << bits) : value;
}

inline std::int64_t reference_unquantise(std::int64_t x, int bits, bool is_signed) {
  if (!is_signed) {
    if (bits >= 15) return x;
    if (x == 0) return 0;
    return x == (1 << bits) - 1 ? 0xffff : ((x << 15) + 0x4000) >> (bits - 1);
  }
  if (bits >= 16) return x;
  if (x < 0) return -reference_unquantise(-x, bits, true);
  if (x == 0) return 0;
  return x >= (1 << (bits - 1)) - 1 ? 0x7fff : ((x << 15) + 0x4000) >> (bits - 1);
}

/// The 16 texels; all 0 for a reserved mode.
inline std::array<std::uint16_t, 48> reference_decode(const Bc6hBlock& block, bool is_signed) {
  std::array<std::uint16_t, 48> halves{};
  const int low = reference_bits(block, 0, 2), number = low < 2 ? low : reference_bits(block, 0, 5);
  int m = -1;
  for (int i = 0; i < 14; ++i) m = reference_modes.at(i).number == number ? i : m;
  if (m < 0) return halves;
  const ReferenceFacts& facts = reference_facts.at(m);
  std::int64_t value[3][4] = {};
  int at = low < 2 ? 2 : 5;
  const std::string text = std::string(reference_modes.at(m).bits) + " ";
  for (std::size_t begin = 0; begin < text.size(); begin = text.find(' ', begin) + 1) {
    const int channel = text[begin] == 'r' ? 0 : (text[begin] == 'g' ? 1 : 2);
    const int bit = std::stoi(text.substr(begin + 2));
    value[channel][text[begin + 1] - '0'] |= std::int64_t{reference_bit(block, at++)} << bit;
  }
  const bool two = m < 10;
  const int partition = two ? reference_bits(block, at, 5) : 0;
  at += two ? 5 : 0;
  for (int c = 0; c < 3; ++c) {
    const bool transformed = facts.delta_bits.at(c) > 0;
    if (is_signed) value[c][0] = reference_sign_extend(value[c][0], facts.endpoint_bits);
    for (int e = 1; e < 4; ++e) {
      if (transformed) {
        const std::int64_t offset = reference_sign_extend(value[c][e], facts.delta_bits.at(c));
        value[c][e] = (value[c][0] + offset) & ((1 << facts.endpoint_bits) - 1);
      }
      if (is_signed) value[c][e] = reference_sign_extend(value[c][e], facts.endpoint_bits);
    }
    for (int e = 0; e < 4; ++e)
      value[c][e] = reference_unquantise(value[c][e], facts.endpoint_bits, is_signed);
  }
  std::string picture;
  for (const char* p = reference_partitions.at(partition); *p != 0; ++p)
    picture += *p == ' ' ? "" : std::string(1, *p);
  for (int t = 0; t < 16; ++t) {
    const bool anchor = t == 0 || (two && t == reference_anchors.at(partition));
    const int count = (two ? 3 : 4) - (anchor ? 1 : 0);
    const int index = reference_bits(block, at, count);
    at += count;
    const int weight = two ? index * 9 + (index >> 2) : (index << 2) + (index >> 2) + ((index >> 1) & 1);
    const int first = two && picture.at(t) == '1' ? 2 : 0;
    for (int c = 0; c < 3; ++c) {
      const std::int64_t i = ((64 - weight) * value[c][first] + weight * value[c][first + 1] + 32) >> 6;
      const std::int64_t out =
          is_signed ? (i < 0 ? (((-i) * 31) >> 5) | 0x8000 : (i * 31) >> 5) : (i * 31) >> 6;
      halves.at(3 * t + c) = static_cast<std::uint16_t>(out);
    }
  }
  return halves;
}

}  // namespace welkin

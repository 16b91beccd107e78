// Low-discrepancy numbers for each pixel: the first two dimensions of Sobol's sequence, its order and its digits scrambled
// by Owen's method (Burley 2020), each use of each pixel with a scrambling of its own. Whole numbers of 32 bits.

uint mixed_bits(uint v) {  // O'Neill 2014, PCG-RXS-M-XS
  v = v * 747796405u + 2891336453u;
  v = ((v >> ((v >> 28u) + 4u)) ^ v) * 277803737u;
  return (v >> 22u) ^ v;
}

uint reversed_bits(uint v) {
  v = (v << 16u) | (v >> 16u);
  v = ((v & 0x00ff00ffu) << 8u) | ((v >> 8u) & 0x00ff00ffu);
  v = ((v & 0x0f0f0f0fu) << 4u) | ((v >> 4u) & 0x0f0f0f0fu);
  v = ((v & 0x33333333u) << 2u) | ((v >> 2u) & 0x33333333u);
  return ((v & 0x55555555u) << 1u) | ((v >> 1u) & 0x55555555u);
}

// Laine & Karras 2011: every bit is flipped or not by the bits below it: a nested scrambling of the reversed number.
uint scrambled_from_below(uint v, uint seed) {
  v += seed;
  v ^= v * 0x6c50b47cu;
  v ^= v * 0xb82f1e52u;
  v ^= v * 0xc7afe638u;
  return v ^ (v * 0x8d22f6e6u);
}

// The second dimension's matrix is Pascal's triangle modulo 2: bit k is the sum of the index' bits j whose digits contain
// those of k (Lucas), a sum over supersets in five steps.
uint pascal_sum(uint v) {
  v ^= (v >> 16u) & 0x0000ffffu;
  v ^= (v >> 8u) & 0x00ff00ffu;
  v ^= (v >> 4u) & 0x0f0f0f0fu;
  v ^= (v >> 2u) & 0x33333333u;
  return v ^ ((v >> 1u) & 0x55555555u);
}

// 24 bits: in [0, 1).
float unit_number(uint bits) { return float(bits >> 8u) * (1.0 / 16777216.0); }

uint shuffled_index(uint index, uint seed) { return reversed_bits(scrambled_from_below(reversed_bits(index), seed)); }

// Sample `index` of a stream of its own for each seed.
vec2 sample_pair(uint index, uint seed) {
  uint at = shuffled_index(index, seed);
  return vec2(unit_number(reversed_bits(scrambled_from_below(at, mixed_bits(seed + 1u)))),
              unit_number(reversed_bits(scrambled_from_below(pascal_sum(at), mixed_bits(seed + 2u)))));
}

float sample_number(uint index, uint seed) {
  return unit_number(reversed_bits(scrambled_from_below(shuffled_index(index, seed), mixed_bits(seed + 1u))));
}

uint pixel_seed(ivec2 pixel) { return mixed_bits(uint(pixel.x) + mixed_bits(uint(pixel.y))); }

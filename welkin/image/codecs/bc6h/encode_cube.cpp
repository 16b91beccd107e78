#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <cstring>
#include <vector>

#include <welkin/image/codecs/bc6h/bc6h.h>
#include <welkin/image/codecs/bc6h/block_code.h>
#include <welkin/image/codecs/bc6h/cube_edges.h>
#include <welkin/image/codecs/bc6h/edge_pair.h>
#include <welkin/image/codecs/bc6h/encode_block.h>
#include <welkin/image/codecs/bc6h/error_scale.h>
#include <welkin/parallel/parallel_for.h>

namespace welkin {
namespace bc6h {
namespace {

constexpr float towards_others = 16;  // importance of a shared texel in a block that cannot be split
constexpr int turns = 4;

class CubeCoder {
 public:
  CubeCoder(const Cube& cube, float factor, const Bc6hOptions& options)
      : size_(cube.size),
        across_((cube.size + 3) / 4),
        options_(options),
        scale_(error_scale(options.linear_above)) {
    halves_.resize(static_cast<std::size_t>(6) * size_ * size_ * 3);
    for (std::size_t t = 0; t < halves_.size() / 3; ++t) {
      round_to_halves(cube.texels.data() + t * static_cast<std::size_t>(cube.channels), factor,
                      options.is_signed, halves_.data() + 3 * t, clipped_);
    }
    share_texels();
    codes_.resize(static_cast<std::size_t>(6) * across_ * across_);
  }

  void encode_apart() {
    parallel_for(codes_.size(), 64, [&](std::size_t begin, std::size_t end) {
      for (std::size_t b = begin; b < end; ++b) {
        int halves[48];
        gather(b, halves);
        codes_[b] = encode(halves, options_, *scale_).code;
      }
    });
  }

  // Along the edges, without the blocks in the corners.
  void encode_pairs() {
    if (size_ % 4 != 0 || across_ < 3) return;
    const auto pieces = static_cast<std::size_t>(across_ - 2);
    parallel_for(6 * side_count * pieces, 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const auto face = static_cast<int>(i / pieces / side_count),
                   side = static_cast<int>(i / pieces % side_count);
        if (across_edge(size_, face, side, 0).face > face)
          encode_pair(face, side, static_cast<int>(i % pieces) + 1);
      }
    });
  }

  // What is left, block after block: its shared texels are asked to be what the other faces have there by now.
  void approach() {
    const std::vector<std::size_t> blocks = unsplit_blocks();
    for (int turn = 0; turn < turns; ++turn) {
      for (const std::size_t b : blocks) {
        const Targets targets = targets_towards_others(b);
        const Candidate candidate = encode(targets, options_.speed);
        if (candidate.cost < cost_of(targets, codes_[b])) codes_[b] = candidate.code;
      }
    }
  }

  std::size_t write(std::span<std::uint8_t> out) const {
    for (std::size_t b = 0; b < codes_.size(); ++b) {
      const Bc6hBlock block = pack(codes_[b]);
      std::memcpy(out.data() + 16 * b, block.data(), 16);
    }
    return clipped_;
  }

 private:
  std::size_t block_of(CubeTexel t) const {
    return (static_cast<std::size_t>(t.face) * across_ + t.y / 4) * across_ + t.x / 4;
  }
  std::size_t place(CubeTexel t) const {
    return ((static_cast<std::size_t>(t.face) * size_ + t.y) * size_ + t.x) * 3;
  }
  static int local(CubeTexel t) { return 4 * (t.y % 4) + t.x % 4; }

  // The texels of other faces that meet a texel: none, one, or two in the corners.
  std::vector<CubeTexel> others(CubeTexel t) const {
    std::vector<CubeTexel> found;
    if (t.x == 0) found.push_back(across_edge(size_, t.face, 0, t.y));
    if (t.x == size_ - 1) found.push_back(across_edge(size_, t.face, 1, t.y));
    if (t.y == 0) found.push_back(across_edge(size_, t.face, 2, t.x));
    if (t.y == size_ - 1) found.push_back(across_edge(size_, t.face, 3, t.x));
    return found;
  }

  // Shared texels get the mean of their halves. (A face of one texel has all four others: it is left as it is.)
  void share_texels() {
    if (size_ < 2) return;
    const std::vector<int> before = halves_;
    for_each_shared([&](CubeTexel t, const std::vector<CubeTexel>& meeting) {
      for (std::size_t c = 0; c < 3; ++c) {
        int sum = before[place(t) + c];
        for (const CubeTexel& other : meeting) sum += before[place(other) + c];
        halves_[place(t) + c] = sum / (static_cast<int>(meeting.size()) + 1);
      }
    });
  }

  template <class Visit>
  void for_each_shared(const Visit& visit) const {
    for (int face = 0; face < 6; ++face) {
      for (int y = 0; y < size_; ++y) {
        const bool whole_row = y == 0 || y == size_ - 1;
        for (int x = 0; x < size_; x += whole_row ? 1 : size_ - 1) visit({face, x, y}, others({face, x, y}));
      }
    }
  }

  CubeTexel texel_of(std::size_t block, int t) const {
    const auto across = static_cast<std::size_t>(across_);
    const auto face = static_cast<int>(block / across / across);
    return {face, std::min(4 * static_cast<int>(block % across) + t % 4, size_ - 1),
            std::min(4 * static_cast<int>(block / across % across) + t / 4, size_ - 1)};
  }

  void gather(std::size_t block, int halves[48]) const {
    for (int t = 0; t < texel_count; ++t) {
      const std::size_t from = place(texel_of(block, t));
      for (int c = 0; c < 3; ++c) halves[3 * t + c] = halves_[from + static_cast<std::size_t>(c)];
    }
  }

  Targets targets_of(std::size_t block) const {
    int halves[48];
    gather(block, halves);
    return make_targets(halves, equal_importance, options_.is_signed, scale_->values());
  }

  void encode_pair(int face, int side, int piece) {
    std::array<EdgeBlock, 2> pair;
    std::array<std::size_t, 2> blocks{};
    for (int i = 0; i < 4; ++i) {
      const CubeTexel a = on_side(size_, face, side, 4 * piece + i),
                      b = across_edge(size_, face, side, 4 * piece + i);
      pair[0].texels[static_cast<std::size_t>(i)] = local(a),
      pair[1].texels[static_cast<std::size_t>(i)] = local(b);
      blocks = {block_of(a), block_of(b)};
      pair[1].side = side_towards(b, face, size_);
    }
    pair[0].side = side;
    for (std::size_t k = 0; k < 2; ++k) pair[k].targets = targets_of(blocks[k]);
    const std::array<BlockCode, 2> codes = encode_edge_pair(pair);
    for (std::size_t k = 0; k < 2; ++k) codes_[blocks[k]] = codes[k];
  }

  // Blocks with shared texels that encode_pairs does not reach, in order.
  std::vector<std::size_t> unsplit_blocks() const {
    std::vector<std::size_t> blocks;
    const bool paired = size_ % 4 == 0 && across_ >= 3;
    if (size_ < 2) return blocks;
    for_each_shared([&](CubeTexel t, const std::vector<CubeTexel>&) {
      const bool corner = (t.x < 4 || t.x >= size_ - 4) && (t.y < 4 || t.y >= size_ - 4);
      if (!paired || corner) blocks.push_back(block_of(t));
    });
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    return blocks;
  }

  int decoded(CubeTexel t, int channel) const {
    std::uint16_t halves[48];
    const BlockCode& code = codes_[block_of(t)];
    decode(code, options_.is_signed, halves);
    const int half = halves[3 * local(t) + channel];
    return (half & 0x8000) != 0 ? -(half & 0x7fff) : half;
  }

  Targets targets_towards_others(std::size_t block) const {
    int halves[48];
    float importance[16];
    gather(block, halves);
    const std::array<int, 3> limit =
        make_targets(halves, equal_importance, options_.is_signed, scale_->values()).limit;
    for (int t = 0; t < texel_count; ++t) {
      const std::vector<CubeTexel> meeting = others(texel_of(block, t));
      importance[t] = meeting.empty() ? 1 : towards_others;
      for (int c = 0; c < 3 && !meeting.empty(); ++c) {
        int sum = 0;
        for (const CubeTexel& other : meeting) sum += decoded(other, c);
        halves[3 * t + c] = sum / static_cast<int>(meeting.size());
      }
    }
    Targets targets = make_targets(halves, importance, options_.is_signed, scale_->values());
    targets.limit = limit;
    return targets;
  }

  float cost_of(const Targets& targets, const BlockCode& code) const {
    std::uint16_t halves[48];
    decode(code, options_.is_signed, halves);
    float cost = 0;
    for (int i = 0; i < 48; ++i) {
      const int half = (halves[i] & 0x8000) != 0 ? -(halves[i] & 0x7fff) : halves[i];
      const float d = targets.scale[half] - targets.level[static_cast<std::size_t>(i % 3)][i / 3];
      cost += targets.importance[i / 3] * d * d;
    }
    return cost;
  }

  int size_, across_;
  Bc6hOptions options_;
  std::shared_ptr<const ErrorScale> scale_;
  std::size_t clipped_ = 0;
  std::vector<int> halves_;
  std::vector<BlockCode> codes_;
};

}  // namespace
}  // namespace bc6h

std::size_t encode_bc6h_cube(const Cube& cube, float factor, const Bc6hOptions& options, bool shared_edges,
                             std::span<std::uint8_t> out) {
  const std::size_t face_bytes = bc6h_bytes(cube.size, cube.size);
  assert(out.size() == 6 * face_bytes);
  if (shared_edges) {
    bc6h::CubeCoder coder(cube, factor, options);
    coder.encode_apart();
    coder.encode_pairs();
    coder.approach();
    return coder.write(out);
  }
  const std::size_t face_values = cube.texels.size() / 6;
  std::size_t clipped = 0;
  for (std::size_t face = 0; face < 6; ++face) {
    clipped +=
        encode_bc6h(std::span(cube.texels).subspan(face * face_values, face_values), cube.size, cube.size,
                    cube.channels, factor, options, out.subspan(face * face_bytes, face_bytes));
  }
  return clipped;
}

}  // namespace welkin

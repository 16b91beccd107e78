#pragma once
#include <cstddef>
#include <vector>

#include <welkin/sh/batch_fft.h>

namespace welkin {

/// The Fourier coefficients F_m of all rows of a map, between the FFTs along its rows and those along its columns: private
/// to welkin/sh. Rows come in pairs, mirror images of each other, the middle row of an odd height twice. Of `lanes` row
/// pairs, a channel and an order, at() holds: the real parts in the north, the imaginary ones, and both in the south.
struct RowOrders {
  static constexpr int lanes = BatchFft::batch_lanes;
  static constexpr int size = 4 * lanes;
  static constexpr int orders_at_once = 2 * lanes;  // a task of the column FFTs: as many even as odd ones
  int height = 0, pairs = 0, blocks = 0, channels = 0;
  int orders = 0;  // max_degree + 1, padded to whole tasks

  RowOrders(int map_height, int channel_count, int max_degree)
      : height(map_height),
        pairs((map_height + 1) / 2),
        blocks((pairs + lanes - 1) / lanes),
        channels(channel_count),
        orders((max_degree / orders_at_once + 1) * orders_at_once),
        data_(static_cast<std::size_t>(blocks) * channels * orders * 4) {}

  double* at(int block, int channel, int m) {
    return data_[((static_cast<std::size_t>(block) * channels + channel) * orders + m) * 4].values;
  }

  /// Tasks of the column FFTs: each is one channel of orders first, first + 2, ... first + 2 (lanes - 1).
  struct Task {
    int channel = 0, first = 0;
  };
  int tasks() const { return orders / lanes * channels; }
  Task task(int i) const { return {i / 2 % channels, i / (2 * channels) * orders_at_once + i % 2}; }

 private:
  std::vector<EightDoubles> data_;
};

}  // namespace welkin

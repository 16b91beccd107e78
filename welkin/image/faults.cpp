#include <welkin/image/faults.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <welkin/error.h>
#include <welkin/parallel/parallel_for.h>

namespace welkin {
namespace {

constexpr std::size_t values_per_chunk = 1 << 16;

struct Survey {
  PixelFaults faults;
  float largest_finite = 0;
};

Survey survey(std::span<const float> values) {
  const auto partials = parallel_partials<Survey>(
      values.size(), values_per_chunk, [&](Survey& part, std::size_t begin, std::size_t end) {
        for (float value : values.subspan(begin, end - begin)) {
          if (std::isnan(value)) {
            ++part.faults.nan;
          } else if (std::isinf(value)) {
            ++part.faults.infinite;
          } else {
            part.faults.negative += value < 0 ? 1 : 0;
            part.largest_finite = std::max(part.largest_finite, value);
          }
        }
      });
  Survey total;
  for (const Survey& part : partials) {
    total.faults.nan += part.faults.nan;
    total.faults.infinite += part.faults.infinite;
    total.faults.negative += part.faults.negative;
    total.largest_finite = std::max(total.largest_finite, part.largest_finite);
  }
  return total;
}

}  // namespace

PixelFaults count_faults(std::span<const float> values) { return survey(values).faults; }

PixelFaults repair_faults(std::span<float> values, FaultPolicy policy, std::string_view name) {
  const Survey found = survey(values);
  if (found.faults.total() == 0 || policy == FaultPolicy::keep) return found.faults;
  if (policy == FaultPolicy::refuse) {
    throw Error(name, fmt::format("has {} NaN, {} infinite and {} negative values", found.faults.nan,
                                  found.faults.infinite, found.faults.negative));
  }
  parallel_for(values.size(), values_per_chunk, [&](std::size_t begin, std::size_t end) {
    for (float& value : values.subspan(begin, end - begin)) {
      if (std::isnan(value) || value < 0) value = 0;
      if (std::isinf(value)) value = found.largest_finite;
    }
  });
  return found.faults;
}

}  // namespace welkin

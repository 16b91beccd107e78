#include <welkin/envmap/methods/frequency.h>

#include <utility>

namespace welkin {

Cube filter_frequency(const Image& radiance, const FilterTarget& target, const FrequencyOptions& options) {
  return std::move(filter_environment(radiance, std::span(&target, 1), options).front());
}

}  // namespace welkin

#include <welkin/parallel/parallel_for.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <stdexcept>

namespace welkin {
namespace {

TEST(ParallelFor, VisitsEveryIndexOnce) {
  for (int threads : {1, 2, 8}) {
    set_thread_count(threads);
    std::vector<int> visits(1003);
    parallel_for(visits.size(), 10, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) ++visits[i];
    });
    for (int count : visits) ASSERT_EQ(count, 1);
  }
  set_thread_count(0);
}

TEST(ParallelFor, RethrowsWhatABodyThrows) {
  set_thread_count(2);
  EXPECT_THROW(parallel_for(100, 1,
                            [](std::size_t begin, std::size_t) {
                              if (begin == 37) throw std::runtime_error("37");
                            }),
               std::runtime_error);
  set_thread_count(0);
}

// Sums of floats depend on their order, so equal bits mean that the order is fixed.
TEST(ParallelPartials, SumsAreBitIdenticalOnAnyNumberOfThreads) {
  const auto harmonic_sum = [] {
    const auto partials =
        parallel_partials<float>(100'000, 64, [](float& sum, std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i) sum += 1 / std::sqrt(static_cast<float>(i + 1));
        });
    return std::accumulate(partials.begin(), partials.end(), 0.0f);
  };
  set_thread_count(1);
  const float expected = harmonic_sum();
  for (int threads : {2, 8}) {
    set_thread_count(threads);
    EXPECT_EQ(harmonic_sum(), expected);
  }
  set_thread_count(0);
}

}  // namespace
}  // namespace welkin

#include <welkin/image/faults.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <welkin/error.h>

namespace welkin {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
const float not_a_number = std::numeric_limits<float>::quiet_NaN();
const std::vector<float> faulty{1, not_a_number, -2, infinity, 7, -infinity, -0.0f, not_a_number, 0};

TEST(Faults, AreCountedByKind) {
  const PixelFaults faults = count_faults(faulty);
  EXPECT_EQ(faults.nan, 2u);
  EXPECT_EQ(faults.infinite, 2u);
  EXPECT_EQ(faults.negative, 1u);
  EXPECT_EQ(faults.total(), 5u);
}

// More values than one chunk has, so that the counts of several are added.
TEST(Faults, AreCountedInLargeImages) {
  std::vector<float> values(200'000, 1.0f);
  for (std::size_t i = 0; i < values.size(); i += 1000) values[i] = -1;
  EXPECT_EQ(count_faults(values).negative, 200u);
}

TEST(Faults, AreRepaired) {
  std::vector<float> values = faulty;
  EXPECT_EQ(repair_faults(values, FaultPolicy::repair, "a.hdr").total(), 5u);
  EXPECT_EQ(values, (std::vector<float>{1, 0, 0, 7, 7, 0, 0, 0, 0}));
}

TEST(Faults, InfinityAloneBecomesBlack) {
  std::vector<float> values{infinity, infinity};
  repair_faults(values, FaultPolicy::repair, "a.hdr");
  EXPECT_EQ(values, (std::vector<float>{0, 0}));
}

TEST(Faults, AreRefusedWithTheirCounts) {
  std::vector<float> values = faulty;
  std::string message;
  try {
    repair_faults(values, FaultPolicy::refuse, "a.hdr");
  } catch (const Error& error) {
    message = error.what();
  }
  EXPECT_EQ(message, "a.hdr: has 2 NaN, 2 infinite and 1 negative values");
  EXPECT_EQ(values[2], -2);
}

TEST(Faults, AreKept) {
  std::vector<float> values = faulty;
  EXPECT_EQ(repair_faults(values, FaultPolicy::keep, "a.hdr").total(), 5u);
  EXPECT_EQ(values[2], -2);
}

TEST(Faults, ACleanImagePassesEveryPolicy) {
  std::vector<float> values{0, 1, 2};
  EXPECT_EQ(repair_faults(values, FaultPolicy::refuse, "a.hdr").total(), 0u);
}

}  // namespace
}  // namespace welkin

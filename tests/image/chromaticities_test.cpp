#include <welkin/image/codecs/chromaticities.h>

#include <gtest/gtest.h>

namespace welkin {
namespace {

// IEC 61966-2-1 (sRGB), to its four digits.
TEST(Chromaticities, Rec709ToXyzIsTheStandardMatrix) {
  const ColourMatrix expected{0.4124, 0.3576, 0.1805, 0.2126, 0.7152, 0.0722, 0.0193, 0.1192, 0.9505};
  const ColourMatrix m = rgb_to_xyz({});
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(m[i], expected[i], 5e-5) << i;
}

// Whites are mapped onto each other by construction; 1e-6 is float rounding. ACES: SMPTE ST 2065-1.
TEST(Chromaticities, WhiteStaysWhite) {
  const Chromaticities aces{{0.7347, 0.2653}, {0, 1}, {0.0001, -0.077}, {0.32168, 0.33767}};
  float white[3] = {1, 1, 1};
  transform_colour(rgb_to_rec709(aces), white);
  for (float value : white) EXPECT_NEAR(value, 1, 1e-6);
}

TEST(Chromaticities, Rec709IsTheIdentity) {
  const ColourMatrix m = rgb_to_rec709({});
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(m[i], i % 4 == 0 ? 1 : 0, 1e-12);
}

TEST(Chromaticities, ImpossibleSpacesGiveZero) {
  EXPECT_EQ(rgb_to_rec709({{0.3, 0.3}, {0.3, 0.3}, {0.3, 0.3}, {0.3, 0.3}}), ColourMatrix{});
  EXPECT_EQ(rgb_to_rec709({{0.64, 0}, {0.3, 0.6}, {0.15, 0.06}, {0.3127, 0.3290}}), ColourMatrix{});
}

}  // namespace
}  // namespace welkin

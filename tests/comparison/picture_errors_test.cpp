#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <welkin/comparison/difference_picture.h>
#include <welkin/comparison/picture_errors.h>
#include <welkin/error.h>

namespace welkin {
namespace {

// 4 x 2 pixels: the first column shows nothing, the second an edge, the others surfaces; the truth is 2 everywhere.
TruthPicture gray_truth() {
  TruthPicture truth{Image(4, 2, 3), Image(4, 2, 3), Image(4, 2, 1)};
  std::fill(truth.radiance.pixels.begin(), truth.radiance.pixels.end(), 2.0f);
  for (int y = 0; y < 2; ++y) {
    const float coverage[] = {0, 0.5f, 1, 1};
    std::copy_n(coverage, 4, truth.coverage.at(0, y));
  }
  return truth;
}

Image picture_of(const TruthPicture& truth, float radiance) {
  Image picture(truth.radiance.width, truth.radiance.height, 4);
  for (std::size_t i = 0; i < truth.coverage.pixels.size(); ++i)
    for (std::size_t c = 0; c < 4; ++c)
      picture.pixels[4 * i + c] = c < 3 ? radiance : truth.coverage.pixels[i];
  return picture;
}

TEST(PictureErrors, AreRelativeToTheTruthAndLeaveEdgesOut) {
  const TruthPicture truth = gray_truth();
  Image picture = picture_of(truth, 2);
  picture.at(0, 0)[0] = 100;   // background: does not count
  picture.at(1, 0)[0] = 5;     // an edge: counts apart
  picture.at(2, 0)[1] = 2.5f;  // +0.5
  picture.at(3, 1)[2] = 1;     // -1
  const PictureErrors e = compare_with_truth(picture, truth);
  EXPECT_EQ(e.pixels, 4u);
  EXPECT_EQ(e.edge_pixels, 2u);
  EXPECT_DOUBLE_EQ(e.truth_mean, 2);
  EXPECT_DOUBLE_EQ(e.mean_absolute, 1.5 / 12 / 2);
  EXPECT_DOUBLE_EQ(e.bias, -0.5 / 12 / 2);
  EXPECT_DOUBLE_EQ(e.rms, std::sqrt(1.25 / 12) / 2);
  EXPECT_DOUBLE_EQ(e.largest, 0.5);
  EXPECT_DOUBLE_EQ(e.edge_mean_absolute, 3.0 / 6 / 2);
  EXPECT_GT(e.flip, 0);
}

TEST(PictureErrors, OfTheTruthItselfAreZero) {
  const TruthPicture truth = gray_truth();
  const PictureErrors e = compare_with_truth(picture_of(truth, 2), truth);
  EXPECT_EQ(e.mean_absolute + e.rms + e.p99 + e.largest + e.edge_mean_absolute, 0);
  EXPECT_EQ(e.flip, 0);
}

TEST(PictureErrors, OtherSizesAndPicturesWithoutSurfacesAreRefused) {
  TruthPicture truth = gray_truth();
  EXPECT_THROW(compare_with_truth(Image(4, 3, 4), truth), Error);
  Image picture = picture_of(truth, 1);
  for (std::size_t i = 3; i < picture.pixels.size(); i += 4) picture.pixels[i] = 0;
  EXPECT_THROW(compare_with_truth(picture, truth), Error);
}

// Too bright is warm, too dark is blue, exact is black, and what is not compared is gray.
TEST(DifferencePicture, SaysTheSign) {
  const TruthPicture truth = gray_truth();
  Image picture = picture_of(truth, 2);
  for (int c = 0; c < 3; ++c) picture.at(2, 0)[c] = 3, picture.at(3, 0)[c] = 1;
  const ByteImage shown = difference_picture(picture, truth, 1);
  EXPECT_EQ(shown.at(0, 0)[0], shown.at(0, 0)[2]);
  EXPECT_GT(shown.at(0, 0)[0], 0);
  EXPECT_GT(shown.at(2, 0)[0], shown.at(2, 0)[2]);
  EXPECT_LT(shown.at(3, 0)[0], shown.at(3, 0)[2]);
  EXPECT_EQ(int{shown.at(2, 1)[0]} + shown.at(2, 1)[1] + shown.at(2, 1)[2], 0);
}

}  // namespace
}  // namespace welkin

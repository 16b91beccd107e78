#include <welkin/geometry/frame.h>

#include <gtest/gtest.h>

#include <vector>

namespace welkin {
namespace {

void expect_orthonormal(const LocalFrame& frame) {
  EXPECT_NEAR(dot(frame.tangent, frame.tangent), 1, 1e-6);
  EXPECT_NEAR(dot(frame.bitangent, frame.bitangent), 1, 1e-6);
  EXPECT_NEAR(dot(frame.tangent, frame.bitangent), 0, 1e-6);
  EXPECT_NEAR(dot(cross(frame.tangent, frame.bitangent), frame.normal), 1, 1e-6);
}

TEST(LocalFrame, IsOrthonormalAndRightHanded) {
  for (Vec3f normal :
       std::vector<Vec3f>{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}, {1, 2, -3}, {1e-4f, 0, -1}}) {
    expect_orthonormal(make_frame(normalized(normal)));
    expect_orthonormal(make_frame(normalized(normal), {0.3f, -2, 0.1f}));
  }
}

TEST(LocalFrame, KeepsTheTangentWhereItCan) {
  EXPECT_NEAR(make_frame({0, 0, 1}, {3, 0, 5}).tangent.x, 1, 1e-6);
  expect_orthonormal(make_frame({0, 1, 0}, {0, 7, 0}));
  expect_orthonormal(make_frame({0, 1, 0}, {NAN, 0, 0}));
}

TEST(LocalFrame, ThereAndBack) {
  const LocalFrame frame = make_frame(normalized({1, -2, 0.5f}));
  const Vec3f back = frame.to_local(frame.to_world({0.2f, -0.4f, 0.6f}));
  EXPECT_NEAR(back.x, 0.2f, 1e-6);
  EXPECT_NEAR(back.y, -0.4f, 1e-6);
  EXPECT_NEAR(back.z, 0.6f, 1e-6);
}

}  // namespace
}  // namespace welkin

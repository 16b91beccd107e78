#include <welkin/sphere/cube_layout.h>

#include <gtest/gtest.h>

#include <numeric>

#include <welkin/error.h>
#include <welkin/sphere/cube.h>
#include <welkin/sphere/labelled_map.h>

namespace welkin {
namespace {

Cube numbered_cube(int size) {
  Cube cube(size, 3);
  std::iota(cube.texels.begin(), cube.texels.end(), 1.0f);
  return cube;
}

TEST(CubeLayout, EveryLayoutGivesTheSameTexelsBack) {
  for (const char* name : {"hcross", "vcross", "hstrip", "vstrip"}) {
    const CubeLayout layout = cube_layout_from_name(name).value();
    EXPECT_EQ(cube_layout_name(layout), name);
    const Cube cube = numbered_cube(5);
    const Image flat = cube_to_layout(cube, layout);
    EXPECT_EQ(cube_from_layout(flat, layout).texels, cube.texels);
    const FlatContent guess = guess_flat_content(flat.width, flat.height).value();
    EXPECT_EQ(guess.mapping, Mapping::cube);
    EXPECT_EQ(guess.layout, layout);
  }
  EXPECT_EQ(cube_from_faces(cube_faces(numbered_cube(3))).texels, numbered_cube(3).texels);
}

// Direction of each texel kept in the texel itself: in a cross, texels beside each other, also across the joints of
// faces, look in nearly the same direction. The widest step inside a 32 x 32 face is 2/32; across an edge it is less.
TEST(CubeLayout, FacesThatTouchInACrossTouchOnTheCube) {
  constexpr int size = 32;
  Cube cube(size, 3);
  for (int face = 0; face < 6; ++face) {
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const Vec3 d = cube_texel_direction(size, face, x, y);
        float* texel = cube.at(face, x, y);
        texel[0] = static_cast<float>(d.x), texel[1] = static_cast<float>(d.y),
        texel[2] = static_cast<float>(d.z);
      }
    }
  }
  for (CubeLayout layout : {CubeLayout::horizontal_cross, CubeLayout::vertical_cross}) {
    const Image flat = cube_to_layout(cube, layout);
    const auto direction = [&](int x, int y) {
      return Vec3{flat.at(x, y)[0], flat.at(x, y)[1], flat.at(x, y)[2]};
    };
    // Along the middle row and column of the cross, joints included: the cells (., 1) and (1, .).
    for (int x = 0; x + 1 < flat.width; ++x) {
      EXPECT_LT(length(direction(x + 1, size + 7) - direction(x, size + 7)), 2.0 / size);
    }
    for (int y = 0; y + 1 < flat.height; ++y) {
      EXPECT_LT(length(direction(size + 7, y + 1) - direction(size + 7, y)), 2.0 / size);
    }
  }
}

// +Y stands above +Z and -Y below it in both crosses; the label of the middle texel says which face it is.
TEST(CubeLayout, CrossesHaveTheirFacesInPlace) {
  Cube cube(4, 1);
  for (int face = 0; face < 6; ++face) std::fill_n(cube.at(face, 0, 0), 16, static_cast<float>(face));
  const Image h = cube_to_layout(cube, CubeLayout::horizontal_cross);
  EXPECT_EQ(h.at(4, 0)[0], 2);
  EXPECT_EQ(h.at(0, 4)[0], 1);
  EXPECT_EQ(h.at(4, 4)[0], 4);
  EXPECT_EQ(h.at(8, 4)[0], 0);
  EXPECT_EQ(h.at(12, 4)[0], 5);
  EXPECT_EQ(h.at(4, 8)[0], 3);
  const Image v = cube_to_layout(cube, CubeLayout::vertical_cross);
  EXPECT_EQ(v.at(4, 12)[0], 5);
  EXPECT_EQ(v.at(4, 8)[0], 3);
  const Cube numbered = numbered_cube(4);
  const Image turned = cube_to_layout(numbered, CubeLayout::vertical_cross);
  EXPECT_EQ(turned.at(4, 12)[0], numbered.at(5, 3, 3)[0]);  // -Z upside down
}

TEST(CubeLayout, GuessesByProportion) {
  EXPECT_EQ(guess_flat_content(1024, 512).value().mapping, Mapping::equirectangular);
  EXPECT_FALSE(guess_flat_content(1024, 512).value().layout.has_value());
  EXPECT_FALSE(guess_flat_content(512, 512).has_value());
  EXPECT_FALSE(guess_flat_content(1024, 500).has_value());
  EXPECT_FALSE(guess_flat_content(0, 0).has_value());
  EXPECT_THROW(cube_from_layout(Image(8, 8), CubeLayout::horizontal_cross), Error);
  EXPECT_THROW(cube_from_faces(std::vector<Image>(5, Image(2, 2))), Error);
  std::vector<Image> unequal(6, Image(2, 2));
  unequal[3] = Image(3, 3);
  EXPECT_THROW(cube_from_faces(unequal), Error);
}

TEST(CubeLayout, NamesSixFiles) {
  EXPECT_EQ(face_file_names("a.b/sky_%s.hdr", FaceNames::short_signs)[1], "a.b/sky_nx.hdr");
  EXPECT_EQ(face_file_names("a.b/sky.hdr", FaceNames::long_signs)[2], "a.b/sky_posy.hdr");
  EXPECT_EQ(face_file_names("a.b/sky", FaceNames::digits)[5], "a.b/sky_5");
}

}  // namespace
}  // namespace welkin

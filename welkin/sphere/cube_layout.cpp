#include <welkin/sphere/cube_layout.h>

#include <algorithm>
#include <cstdint>

#include <welkin/error.h>

namespace welkin {
namespace {

// Where the faces lie, in units of the face size.
struct LayoutPlan {
  int columns, rows;
  std::array<std::array<int, 2>, 6> cell;  // column, row of each face
  bool back_turned;                        // -Z upside down
};

LayoutPlan plan_of(CubeLayout layout) {
  switch (layout) {
    case CubeLayout::horizontal_cross:
      return {4, 3, {{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}}}, false};
    case CubeLayout::vertical_cross: return {3, 4, {{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {1, 3}}}, true};
    case CubeLayout::horizontal_strip:
      return {6, 1, {{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}}}, false};
    default: return {1, 6, {{{0, 0}, {0, 1}, {0, 2}, {0, 3}, {0, 4}, {0, 5}}}, false};
  }
}

// Calls move(face, x, y, image_x, image_y) for every texel.
template <class Move>
void for_each_texel(CubeLayout layout, int size, Move&& move) {
  const LayoutPlan plan = plan_of(layout);
  for (int face = 0; face < 6; ++face) {
    const auto cell = plan.cell[static_cast<std::size_t>(face)];
    const bool turned = plan.back_turned && face == 5;
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const int in_x = turned ? size - 1 - x : x, in_y = turned ? size - 1 - y : y;
        move(face, x, y, cell[0] * size + in_x, cell[1] * size + in_y);
      }
    }
  }
}

constexpr CubeLayout all_layouts[] = {CubeLayout::horizontal_cross, CubeLayout::vertical_cross,
                                      CubeLayout::horizontal_strip, CubeLayout::vertical_strip};

bool fits(CubeLayout layout, int width, int height) {
  const LayoutPlan plan = plan_of(layout);
  return width > 0 && width % plan.columns == 0 &&
         std::int64_t{width} * plan.rows == std::int64_t{height} * plan.columns;
}

}  // namespace

std::string_view cube_layout_name(CubeLayout layout) {
  constexpr std::string_view names[] = {"hcross", "vcross", "hstrip", "vstrip"};
  return names[static_cast<int>(layout)];
}

std::optional<CubeLayout> cube_layout_from_name(std::string_view name) {
  for (CubeLayout layout : all_layouts) {
    if (name == cube_layout_name(layout)) return layout;
  }
  return std::nullopt;
}

Image cube_to_layout(const Cube& cube, CubeLayout layout) {
  const LayoutPlan plan = plan_of(layout);
  Image image(plan.columns * cube.size, plan.rows * cube.size, cube.channels);
  for_each_texel(layout, cube.size, [&](int face, int x, int y, int image_x, int image_y) {
    std::copy_n(cube.at(face, x, y), cube.channels, image.at(image_x, image_y));
  });
  return image;
}

Cube cube_from_layout(const Image& image, CubeLayout layout) {
  const LayoutPlan plan = plan_of(layout);
  if (!fits(layout, image.width, image.height)) {
    throw Error("a cube as " + std::string(cube_layout_name(layout)) + " is " + std::to_string(plan.columns) +
                ":" + std::to_string(plan.rows) + ", not " + std::to_string(image.width) + " x " +
                std::to_string(image.height));
  }
  Cube cube(image.width / plan.columns, image.channels);
  for_each_texel(layout, cube.size, [&](int face, int x, int y, int image_x, int image_y) {
    std::copy_n(image.at(image_x, image_y), image.channels, cube.at(face, x, y));
  });
  return cube;
}

std::array<Image, 6> cube_faces(const Cube& cube) {
  std::array<Image, 6> faces;
  for (int face = 0; face < 6; ++face) {
    Image image(cube.size, cube.size, cube.channels);
    std::copy_n(cube.at(face, 0, 0), image.pixels.size(), image.pixels.begin());
    faces[static_cast<std::size_t>(face)] = std::move(image);
  }
  return faces;
}

Cube cube_from_faces(std::span<const Image> faces) {
  if (faces.size() != 6) throw Error("a cube has six faces, not " + std::to_string(faces.size()));
  for (const Image& face : faces) {
    if (face.empty() || face.width != face.height || face.width != faces[0].width ||
        face.channels != faces[0].channels) {
      throw Error("the six faces of a cube must be squares of one size, not " + std::to_string(face.width) +
                  " x " + std::to_string(face.height) + " beside " + std::to_string(faces[0].width) + " x " +
                  std::to_string(faces[0].height));
    }
  }
  Cube cube(faces[0].width, faces[0].channels);
  for (int face = 0; face < 6; ++face) {
    std::copy(faces[face].pixels.begin(), faces[face].pixels.end(), cube.at(face, 0, 0));
  }
  return cube;
}

std::optional<FlatContent> guess_flat_content(int width, int height) {
  if (width > 0 && height > 0 && width == std::int64_t{2} * height) {
    return FlatContent{Mapping::equirectangular, std::nullopt};
  }
  for (CubeLayout layout : all_layouts) {
    if (fits(layout, width, height)) return FlatContent{Mapping::cube, layout};
  }
  return std::nullopt;
}

std::array<std::string, 6> face_names(FaceNames style) {
  if (style == FaceNames::digits) return {"0", "1", "2", "3", "4", "5"};
  if (style == FaceNames::short_signs) return {"px", "nx", "py", "ny", "pz", "nz"};
  return {"posx", "negx", "posy", "negy", "posz", "negz"};
}

std::array<std::string, 6> face_file_names(const std::string& pattern, FaceNames style) {
  std::string full = pattern;
  if (pattern.find("%s") == std::string::npos) {
    const std::size_t slash = pattern.find_last_of("/\\");
    const std::size_t dot = pattern.find_last_of('.');
    const bool has_extension = dot != std::string::npos && (slash == std::string::npos || dot > slash);
    full.insert(has_extension ? dot : pattern.size(), "_%s");
  }
  const std::size_t place = full.rfind("%s");
  std::array<std::string, 6> names = face_names(style);
  for (std::string& name : names) name = full.substr(0, place) + name + full.substr(place + 2);
  return names;
}

}  // namespace welkin

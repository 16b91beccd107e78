#pragma once
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <welkin/image/image.h>
#include <welkin/sphere/mapping.h>

// Cubes as flat pictures and as six files. Nothing is filtered: texels are moved, bit for bit.
//
//   horizontal_cross 4N x 3N      vertical_cross 3N x 4N     horizontal_strip 6N x N   +X -X +Y -Y +Z -Z
//      .  +Y  .  .                   .  +Y  .                vertical_strip   N x 6N   the same from the top
//     -X  +Z +X -Z                  -X  +Z +X
//      .  -Y  .  .                   .  -Y  .
//                                    .  -Z  .   (-Z turned by 180 degrees, so that it continues -Y)
//
// Neighbours in a cross are neighbours on the cube. The empty corners are black and ignored when read.

namespace welkin {

enum class CubeLayout { horizontal_cross, vertical_cross, horizontal_strip, vertical_strip };

/// "hcross", "vcross", "hstrip", "vstrip".
std::string_view cube_layout_name(CubeLayout layout);
std::optional<CubeLayout> cube_layout_from_name(std::string_view name);

Image cube_to_layout(const Cube& cube, CubeLayout layout);

/// Throws Error when the image has not the proportion of the layout.
Cube cube_from_layout(const Image& image, CubeLayout layout);

/// The six faces as images, and back; throws Error unless they are six equal squares.
std::array<Image, 6> cube_faces(const Cube& cube);
Cube cube_from_faces(std::span<const Image> faces);

/// What a flat picture can be by its proportion alone.
struct FlatContent {
  Mapping mapping = Mapping::equirectangular;
  std::optional<CubeLayout> layout;  ///< set exactly when mapping is cube
};

/// 2:1 is equirectangular, 4:3, 3:4, 6:1 and 1:6 are cubes. Nothing for other proportions and for 1:1, which may be
/// octahedral or a mirror ball: ask the user. (A dual paraboloid is 2:1 too and has to be named.)
std::optional<FlatContent> guess_flat_content(int width, int height);

/// How six files are told apart.
enum class FaceNames { short_signs, long_signs, digits };

/// px nx py ny pz nz; posx negx posy negy posz negz; 0 1 2 3 4 5.
std::array<std::string, 6> face_names(FaceNames style);

/// The names of six files: `pattern` with its %s replaced by each face's name, "sky_%s.hdr" -> "sky_px.hdr" ...; a
/// pattern without %s gets "_" and the name before its extension. The folder part is left alone.
std::array<std::string, 6> face_file_names(const std::string& pattern, FaceNames style);

}  // namespace welkin

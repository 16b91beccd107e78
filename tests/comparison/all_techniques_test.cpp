#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <welkin/comparison/picture_errors.h>
#include <welkin/realtime/gl/headless_context.h>
#include "tests/comparison/small_renderer.h"

// What holds of every technique, whoever wrote it.

namespace welkin {
namespace {

constexpr int several_frames = 3;

Image draw_frames(Renderer& renderer, int frames) {
  for (int i = 0; i < frames; ++i) renderer.draw();
  return renderer.read_picture();
}

Image picture_of(const TechniqueInfo& technique) {
  SmallRenderer small(40, 30);
  small.renderer.set_technique(technique, initial_values(technique));
  return draw_frames(small.renderer, several_frames);
}

TEST(AllTechniques, DrawSurfacesAndTheSameBytesTwiceAndLeaveNothing) {
  const HeadlessContext context;
  for (const TechniqueInfo& technique : techniques()) {
    SCOPED_TRACE(technique.name);
    const Image first = picture_of(technique), second = picture_of(technique);
    EXPECT_TRUE(first.pixels == second.pixels);
    double sum = 0, surface = 0;
    for (std::size_t i = 0; i < first.pixels.size(); i += 4) {
      ASSERT_TRUE(std::isfinite(first.pixels[i] + first.pixels[i + 1] + first.pixels[i + 2])) << i / 4;
      surface += first.pixels[i + 3] == 1;
      if (first.pixels[i + 3] == 1) sum += double{first.pixels[i + 1]};
    }
    EXPECT_GT(surface, 300);         // of 1200 pixels
    EXPECT_GT(sum / surface, 0.02);  // not black: the sky's mean is about 0.5
    for (const int living : living_gl_objects()) EXPECT_EQ(living, 0);
  }
}

// A technique that was used before leaves no trace in the picture of the next.
TEST(AllTechniques, DoNotDependOnTheOneBefore) {
  const HeadlessContext context;
  SmallRenderer small(40, 30);
  const TechniqueInfo& first = techniques()[0];
  small.renderer.set_technique(first, initial_values(first));
  const Image before = draw_frames(small.renderer, 1);
  for (const TechniqueInfo& technique : techniques()) {
    small.renderer.set_technique(technique, initial_values(technique));
    draw_frames(small.renderer, 2);
    small.renderer.set_technique(first, initial_values(first));
    EXPECT_TRUE(draw_frames(small.renderer, 1).pixels == before.pixels) << technique.name;
  }
}

/// How near its truth a technique comes on a scene, and why not nearer.
struct Tolerance {
  const char* technique;  ///< with values
  const char* scene;
  int supersample, frames;
  double mean_absolute;  ///< at most, share of the truth's mean
  const char* cause;
};
constexpr Tolerance tolerances[] = {
    {"mirror", "spheres", 4, 1, 0.02, "bilinear look-ups in a cube against boxes of the equirectangular map"},
    {"irradiance-map", "spheres", 4, 1, 0.01, "noise of the truth; 32 texels along an edge"},
    {"prefiltered-ggx", "spheres", 4, 1, 0.05, "one lobe about the mirrored view, the same for all views"},
    {"sh-pixel", "spheres", 4, 1, 0.02, "degree 2"},
    {"sh-matrix", "spheres", 4, 1, 0.02, "degree 2"},
};

PictureErrors measure(const Tolerance& row) {
  const TechniqueChoice choice = parse_technique(row.technique);
  constexpr PictureSize size{48, 36};
  SmallRenderer small(size.width * row.supersample, size.height * row.supersample, row.scene);
  small.renderer.set_technique(*choice.technique, choice.values);
  const Image picture = mean_of_blocks(draw_frames(small.renderer, row.frames), row.supersample);
  TruthOptions options;
  options.samples = 64;
  return compare_with_truth(picture, render_truth(small.renderer, *small_light(), size, options));
}

TEST(AllTechniques, AreAsNearTheirTruthAsIsKnownOfThem) {
  const HeadlessContext context;
  for (const TechniqueInfo& technique : techniques()) {
    const auto row = std::find_if(std::begin(tolerances), std::end(tolerances), [&](const Tolerance& t) {
      return parse_technique(t.technique).technique == &technique;
    });
    ASSERT_NE(row, std::end(tolerances)) << technique.name << " needs a row with its tolerance";
    const PictureErrors errors = measure(*row);
    EXPECT_LE(errors.mean_absolute, row->mean_absolute) << row->technique << ": " << row->cause;
    EXPECT_GT(errors.pixels, 300u) << row->technique;
    RecordProperty(std::string(technique.name), std::to_string(errors.mean_absolute));
  }
}

}  // namespace
}  // namespace welkin

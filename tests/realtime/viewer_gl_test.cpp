#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <welkin/image/tonemap.h>
#include <welkin/realtime/gl/headless_context.h>
#include <welkin/realtime/viewer/exposure_meter.h>
#include <welkin/realtime/viewer/viewer.h>
#include <welkin/scene/built_in.h>

// The viewer with a context: what it draws, compares and shows.

namespace welkin {
namespace {

std::shared_ptr<const EnvironmentData> sky_light() {
  static const std::shared_ptr<const EnvironmentData> light = [] {
    Image sky(64, 32);
    for (int y = 0; y < sky.height; ++y)
      for (int x = 0; x < sky.width; ++x) {
        const float warm = x > 30 && x < 36 && y > 6 && y < 10 ? 20.0f : 0.4f;
        const float up = y < 16 ? 1.0f : 0.3f;
        std::copy_n(std::array<float, 3>{warm * up, 0.8f * warm * up, up}.data(), 3, sky.at(x, y));
      }
    IblOptions options;
    options.size = 32;
    options.irradiance_size = 16;
    options.dfg_size = 32;
    return make_environment_data(std::move(sky), options);
  }();
  return light;
}

void expect_nothing_left() {
  for (const int living : living_gl_objects()) EXPECT_EQ(living, 0);
  EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
}

void fill(Viewer& viewer, int width, int height) {
  viewer.set_scene(make_built_in_scene("spheres"));
  viewer.set_environment(sky_light());
  viewer.resize(width, height);
}

int largest_difference(const ByteImage& a, const ByteImage& b) {
  EXPECT_EQ(a.pixels.size(), b.pixels.size());
  int largest = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    largest = std::max(largest, std::abs(int{a.pixels[i]} - int{b.pixels[i]}));
  return largest;
}

Image three_channels(const Image& image) {
  Image rgb(image.width, image.height);
  for (std::size_t i = 0; i < image.pixels.size() / 4; ++i)
    std::copy_n(&image.pixels[4 * i], 3, &rgb.pixels[3 * i]);
  return rgb;
}

// Every curve against tonemap.h over 20 stops, every exposure, coloured and gray: the shader works in floats and the other by a
// table of bytes that may round a value near the middle of two to the other one, so one step.
TEST(ToneMapping, ShaderAndLibraryAgreeOverARamp) {
  const HeadlessContext context;
  {
    Image ramp(256, 4, 3);
    for (int x = 0; x < ramp.width; ++x) {
      const float v = std::exp2(static_cast<float>(x) / 12.8f - 14);
      const float tints[4][3] = {{1, 1, 1}, {1, 0.2f, 0.05f}, {0, 1, 0.5f}, {0.3f, 0, 4}};
      for (int y = 0; y < 4; ++y)
        for (int c = 0; c < 3; ++c) ramp.at(x, y)[c] = v * tints[y][c];
    }
    Viewer viewer({TexelFormat::rgba32f, TexelFormat::rgba16f});
    fill(viewer, ramp.width, ramp.height);
    viewer.state.comparison = Comparison::reference;
    viewer.state.automatic_exposure = false;
    viewer.draw();
    viewer.set_truth(ramp, viewer.view_number());
    ASSERT_TRUE(viewer.has_truth());
    for (const ToneCurve curve : {ToneCurve::clamp, ToneCurve::reinhard, ToneCurve::filmic}) {
      for (const float ev : {-3.0f, 0.0f, 2.5f}) {
        viewer.state.curve = curve;
        viewer.state.exposure_ev = ev;
        viewer.state.white = 4;
        const ByteImage expected = tone_map(ramp, {ev, curve, 4});
        EXPECT_LE(largest_difference(viewer.screenshot(), expected), 1)
            << static_cast<int>(curve) << " " << ev;
        EXPECT_GT(*std::max_element(expected.pixels.begin(), expected.pixels.end()), 200);
      }
    }
  }
  expect_nothing_left();
}

TEST(ToneMapping, NaNIsBlackAndInfinityWhite) {
  const HeadlessContext context;
  {
    Image odd(4, 1);
    const float values[4] = {NAN, INFINITY, -1, 3e38f};
    for (int x = 0; x < 4; ++x) std::fill_n(odd.at(x, 0), 3, values[x]);
    Viewer viewer({TexelFormat::rgba32f, TexelFormat::rgba16f});
    fill(viewer, 4, 1);
    viewer.state.comparison = Comparison::reference;
    viewer.draw();
    viewer.set_truth(odd, viewer.view_number());
    for (const ToneCurve curve : {ToneCurve::clamp, ToneCurve::reinhard, ToneCurve::filmic}) {
      viewer.state.curve = curve;
      const ByteImage shown = viewer.screenshot();
      const int expected[4] = {0, 255, 0, 255};
      for (int x = 0; x < 4; ++x) EXPECT_EQ(shown.at(x, 0)[1], expected[x]) << x << static_cast<int>(curve);
    }
  }
  expect_nothing_left();
}

// Up to 512 pixels every one counts, so both are the same sum, in float and in double. Half-float pictures: as read back.
TEST(ExposureMeter, FindsTheExposureOfTheLibrary) {
  const HeadlessContext context;
  {
    Viewer viewer;
    fill(viewer, 250, 131);
    viewer.draw();
    ExposureMeter meter;
    const Image picture = three_channels(viewer.renderer().read_picture());
    EXPECT_NEAR(meter.measure(viewer.renderer().picture()), automatic_exposure_ev(picture), 1e-4);
    EXPECT_NEAR(viewer.exposure_ev(), automatic_exposure_ev(picture), 1e-4);
    viewer.state.exposure_ev = 1.5f;
    EXPECT_NEAR(viewer.exposure_ev(), 1.5 + automatic_exposure_ev(picture), 1e-4);
    viewer.state.automatic_exposure = false;
    EXPECT_FLOAT_EQ(viewer.exposure_ev(), 1.5f);
  }
  expect_nothing_left();
}

// A rectangle of the picture's size shows what the library makes of the floats, the right way up.
TEST(Viewer, ScreenshotIsThePictureToneMapped) {
  const HeadlessContext context;
  {
    Viewer viewer;
    fill(viewer, 97, 61);
    viewer.draw();
    const Image picture = three_channels(viewer.renderer().read_picture());
    const ByteImage expected = tone_map(picture, {viewer.exposure_ev(), ToneCurve::filmic, 16});
    EXPECT_LE(largest_difference(viewer.screenshot(), expected), 1);
  }
  expect_nothing_left();
}

TEST(Viewer, ATechniqueAgainstItselfDiffersByNothingAndAgainstAnotherByTheirImages) {
  const HeadlessContext context;
  {
    Viewer viewer({TexelFormat::rgba32f, TexelFormat::rgba16f});
    fill(viewer, 64, 48);
    viewer.state.comparison = Comparison::difference;
    viewer.state.reference = ReferenceKind::technique;
    viewer.state.reference_technique = parse_technique("prefiltered-ggx");
    viewer.draw();
    ASSERT_TRUE(viewer.numbers().has_value());
    EXPECT_GT(viewer.numbers()->pixels, 500u);
    EXPECT_EQ(viewer.numbers()->largest, 0);
    viewer.state.reference_technique = parse_technique("mirror");
    EXPECT_TRUE(viewer.needs_draw());
    viewer.draw();
    const Image picture = viewer.renderer().read_picture();
    Viewer other({TexelFormat::rgba32f, TexelFormat::rgba16f});
    fill(other, 64, 48);
    other.state.technique = parse_technique("mirror");
    other.draw();
    const DifferenceNumbers expected = measure_difference(picture, other.renderer().read_picture());
    EXPECT_GT(expected.rms, 0.01);
    ASSERT_TRUE(viewer.numbers().has_value());
    EXPECT_DOUBLE_EQ(viewer.numbers()->rms, expected.rms);
    EXPECT_DOUBLE_EQ(viewer.difference_scale(), nice_scale(expected.p99));
    EXPECT_FALSE(viewer.needs_draw());
  }
  expect_nothing_left();
}

// Colours of a known difference: the picture minus itself plus a step.
TEST(Viewer, DifferencesHaveTheColoursOfTheLegend) {
  const HeadlessContext context;
  {
    Viewer viewer({TexelFormat::rgba32f, TexelFormat::rgba16f});
    fill(viewer, 48, 32);
    viewer.draw();
    Image truth = viewer.renderer().read_picture();
    for (std::size_t i = 0; i < truth.pixels.size(); i += 4)
      for (std::size_t c = 0; c < 3; ++c) truth.pixels[i + c] += 0.25f;
    viewer.set_truth(truth, viewer.view_number());
    viewer.state.difference_scale = 1;
    const std::pair<Comparison, Rgb> cases[] = {
        {Comparison::signed_difference, false_color(signed_colors(), 0.375f)},
        {Comparison::difference, false_color(size_colors(), 0.25f)}};
    for (const auto& [comparison, color] : cases) {
      viewer.state.comparison = comparison;
      const ByteImage shown = viewer.screenshot();
      int surface = 0;
      for (int i = 0; i < 48 * 32; ++i) {
        if (truth.pixels[4 * static_cast<std::size_t>(i) + 3] < 1) continue;
        ++surface;
        const std::uint8_t* pixel = &shown.pixels[3 * static_cast<std::size_t>(i)];
        EXPECT_NEAR(pixel[0], 255 * color.r, 1);
        EXPECT_NEAR(pixel[1], 255 * color.g, 1);
        EXPECT_NEAR(pixel[2], 255 * color.b, 1);
      }
      EXPECT_GT(surface, 300);
    }
    viewer.draw();
    ASSERT_TRUE(viewer.numbers().has_value());
    EXPECT_NEAR(viewer.numbers()->mean, -0.25, 1e-6);
    EXPECT_NEAR(viewer.numbers()->p99, 0.25, 1e-5);  // of values up to about 20, in floats
  }
  expect_nothing_left();
}

TEST(Viewer, TheSplitShowsThePictureLeftAndTheReferenceRight) {
  const HeadlessContext context;
  {
    Viewer viewer;
    fill(viewer, 64, 40);
    viewer.draw();
    const ByteImage picture = viewer.screenshot();
    viewer.set_truth(Image(64, 40), viewer.view_number());  // black
    viewer.state.comparison = Comparison::split;
    viewer.state.split = 0.25f;
    const ByteImage shown = viewer.screenshot();
    for (int y = 0; y < 40; ++y) {
      EXPECT_EQ(shown.at(3, y)[0], picture.at(3, y)[0]);
      EXPECT_EQ(shown.at(14, y)[2], picture.at(14, y)[2]);
      EXPECT_EQ(shown.at(18, y)[1], 0);
      EXPECT_EQ(shown.at(63, y)[0], 0);
    }
  }
  expect_nothing_left();
}

TEST(Viewer, ATruthGoesWithItsView) {
  const HeadlessContext context;
  {
    Viewer viewer;
    fill(viewer, 16, 16);
    viewer.draw();
    const unsigned view = viewer.view_number();
    viewer.state.exposure_ev = 2;  // how it is shown does not count
    viewer.draw();
    EXPECT_EQ(viewer.view_number(), view);
    viewer.set_truth(Image(16, 16), view);
    EXPECT_TRUE(viewer.has_truth());
    orbit(viewer.state.camera, {0.1f, 0});
    EXPECT_TRUE(viewer.needs_draw());
    viewer.draw();
    EXPECT_FALSE(viewer.has_truth());
    EXPECT_NE(viewer.view_number(), view);
    viewer.set_truth(Image(16, 16), view);  // arrives too late
    EXPECT_FALSE(viewer.has_truth());
    EXPECT_FALSE(viewer.needs_draw());
  }
  expect_nothing_left();
}

TEST(Viewer, RefusesSizesThatCannotBe) {
  const HeadlessContext context;
  {
    Viewer viewer;
    fill(viewer, 1, 1);
    viewer.draw();
    EXPECT_EQ(viewer.screenshot().pixels.size(), 3u);
    for (const auto& [width, height] : {std::pair{4097, 10}, {10, 100000}, {0, 5}, {-3, 5}}) {
      try {
        viewer.resize(width, height);
        ADD_FAILURE() << width;
      } catch (const std::exception& error) {
        EXPECT_NE(std::string(error.what()).find("4096"), std::string::npos);
      }
    }
    viewer.draw();
    EXPECT_EQ(viewer.screenshot().width, 1);
    viewer.show(0, {0, 0, 0, 0});  // a window that is minimised
  }
  expect_nothing_left();
}

TEST(Viewer, ValuesOutsideTheirRangeAreBroughtIn) {
  const HeadlessContext context;
  {
    Viewer viewer;
    fill(viewer, 8, 8);
    viewer.state.technique = {&find_technique("irradiance-map"), {1, 2, 3}};  // which has no parameters
    viewer.draw();
    EXPECT_TRUE(viewer.state.technique.values.empty());
  }
  expect_nothing_left();
}

}  // namespace
}  // namespace welkin

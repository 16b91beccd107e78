#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <ibl_preview.h>
#include <ibl_report.h>
#include <picture.h>

#include <welkin/envmap/ibl.h>
#include <welkin/envmap/sky/sky.h>
#include <welkin/image/tonemap.h>
#include <welkin/sphere/equirect.h>

namespace welkin {
namespace {

using Json = nlohmann::json;

// Why a page is not well formed, or nothing: every element but the void ones is closed, in the order of opening.
std::string fault_of(const std::string& page) {
  static const std::set<std::string> void_elements{"!DOCTYPE", "meta", "img"};
  std::vector<std::string> open;
  for (std::size_t at = page.find('<'); at != std::string::npos; at = page.find('<', at + 1)) {
    const std::size_t end = page.find('>', at);
    if (end == std::string::npos) return "a tag never ends";
    const bool closing = page[at + 1] == '/';
    const std::size_t first = at + (closing ? 2 : 1);
    const std::string tag = page.substr(first, page.find_first_of(" >", first) - first);
    if (closing && (open.empty() || open.back() != tag)) return "</" + tag + "> closes nothing";
    if (closing) open.pop_back();
    if (!closing && void_elements.count(tag) == 0) open.push_back(tag);
  }
  return open.empty() ? "" : "<" + open.back() + "> stays open";
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

// A manifest with every member that the page knows.
Json full_manifest() {
  return Json::parse(R"json({
    "generator": "welkin 0.1.0", "source": "park.hdr", "description": "equirectangular 1024 x 512",
    "orientation": {"rotate_degrees": 90, "mirror": true},
    "input": {"width": 1024, "height": 512, "mean_radiance": [0.5, 0.25, 0.125], "max_radiance": 69120.25,
      "brightest_direction": [0.7, 0.5, 0.5], "irradiance_up": [1, 2, 3], "irradiance_down": [4, 5, 6],
      "faults": {"nan": 3, "infinite": 0, "negative": 2}, "warnings": ["8 bits only"]},
    "conventions": {"frame": "right-handed", "stored_scale": "times"},
    "level_law": {"name": "quadratic", "formula": "level = (levels - 1) * r * (2 - r)"},
    "files": [
      {"name": "specular.ktx2", "quantity": "prefiltered radiance", "unit": "W/(sr m^2)", "container": "ktx2",
       "format": "rgba16f", "size": 256, "level_count": 2, "stored_scale": 4, "clipped": 0},
      {"name": "irradiance.ktx2", "stored_scale": 2}, {"name": "environment.png", "format": "png"}],
    "levels": [
      {"level": 0, "size": 256, "perceptual_roughness": 0, "alpha": 0, "kernel": "mirror"},
      {"level": 1, "size": 128, "perceptual_roughness": 1, "alpha": 1, "kernel": "ggx alpha 1", "seconds": 0.125,
       "degree": 42, "errors": {"relative_rms": 1.25e-5, "max_over_mean": 2e-4, "energy": 3e-7, "edge_step": 1.01,
       "lookup_relative_rms": 0.0015, "lookup_max_over_mean": 0.02}}],
    "irradiance": {"size": 64, "method": "frequency", "errors": {"relative_rms": 6e-6}},
    "sh": {"degree": 2, "irradiance_mean_error": 0.01, "irradiance_max_error": 0.05},
    "trilinear": {"relative_rms": 0.0031, "max_over_mean": 0.07, "by_roughness": [1, 2, 3, 4, 5, 6, 7, 8, 9, 10]},
    "dfg": {"size": 128, "max_error": 1e-5}, "timings": {
  "load" : 0.1, "verify" : 2.5, "total" : 3
}
})json");
}

// A set of an environment, small enough for tests.
IblSet small_set(const Image& radiance, LevelLaw law = LevelLaw::linear) {
  IblOptions options;
  options.size = 32;
  options.levels = 4;
  options.law = law;
  options.irradiance_size = 8;
  options.dfg_size = 32;
  return make_ibl(radiance, options);
}

Image constant_map(float red, float green, float blue) {
  Image map(64, 32);
  for (std::size_t i = 0; i < map.pixels.size(); i += 3)
    map.pixels[i] = red, map.pixels[i + 1] = green, map.pixels[i + 2] = blue;
  return map;
}

// Light from a disc of 30 degrees about `centre`, before a dim rest.
Image one_sided_map(Vec3 centre) {
  Image map(64, 32);
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const Vec3 direction = equirect_direction({(x + 0.5) / map.width, (y + 0.5) / map.height});
      std::fill_n(map.at(x, y), 3, dot(direction, centre) > std::cos(std::numbers::pi / 12) ? 20.0f : 0.05f);
    }
  return map;
}

int brightness(const std::uint8_t* pixel) { return pixel[0] + pixel[1] + pixel[2]; }

struct Offset {
  double x = 0, y = 0;
};

// The mean position of the brightest pixels of a sphere, from its centre, in radii, rightwards and upwards.
Offset highlight_of(const ByteImage& sheet, const PreviewSphere& sphere) {
  std::vector<Offset> inside;
  std::vector<int> values;
  for (int y = 0; y < sheet.height; ++y)
    for (int x = 0; x < sheet.width; ++x) {
      const Offset offset{(x + 0.5 - sphere.x) / sphere.radius, (sphere.y - y - 0.5) / sphere.radius};
      if (std::hypot(offset.x, offset.y) > 0.95) continue;
      inside.push_back(offset);
      values.push_back(brightness(sheet.at(x, y)));
    }
  const int brightest = *std::max_element(values.begin(), values.end());
  Offset sum;
  int count = 0;
  for (std::size_t i = 0; i < inside.size(); ++i)
    if (values[i] >= brightest - 3) sum.x += inside[i].x, sum.y += inside[i].y, ++count;
  return {sum.x / count, sum.y / count};
}

TEST(EscapeHtml, EveryCharacterThatMeansSomething) {
  EXPECT_EQ(escape_html("<b>.hdr"), "&lt;b&gt;.hdr");
  EXPECT_EQ(escape_html("a & \"b\" 'c'\n"), "a &amp; &quot;b&quot; &#39;c&#39; ");
  EXPECT_EQ(escape_html("caf\xc3\xa9.hdr"), "caf\xc3\xa9.hdr");
}

TEST(Report, FullManifestMakesAWholePage) {
  const std::string page = make_report_html(full_manifest());
  EXPECT_EQ(fault_of(page), "");
  for (const char* text : {"park.hdr",
                           "turned by 90 degrees",
                           "mirrored",
                           "0.5, 0.25, 0.125",
                           "<td>69120</td>",
                           "3 NaN values",
                           "2 negative values",
                           "8 bits only",
                           "right-handed",
                           "prefiltered radiance",
                           "1.25e-05",
                           "0.0015",
                           "1.01",
                           "ggx alpha 1",
                           "0.0031",
                           "0.9 to 1",
                           "2.5 s",
                           "welkin 0.1.0",
                           "src=\"./preview.png\"",
                           "src=\"./environment.png\"",
                           "href=\"./specular.ktx2\""})
    EXPECT_NE(page.find(text), std::string::npos) << text;
  EXPECT_EQ(count_of(page, "<img "), count_of(page, " alt=\""));
}

TEST(Report, SnippetAppliesLawAndScales) {
  const std::string page = make_report_html(full_manifest());
  EXPECT_NE(page.find("levels = 2.0, size = 256.0"), std::string::npos);
  EXPECT_NE(page.find("level = (levels - 1.0) * r * (2.0 - r);"), std::string::npos);
  EXPECT_NE(page.find("4.0 * textureLod(specular_map"), std::string::npos);
  EXPECT_NE(page.find("2.0 * texture(irradiance_map"), std::string::npos);
}

TEST(Report, NothingIsFetchedAndNothingRuns) {
  const std::string page = make_report_html(full_manifest());
  for (const char* text : {"<script", "http:", "https:", "<link", "@import", "url("})
    EXPECT_EQ(page.find(text), std::string::npos) << text;
}

TEST(Report, TextOfTheInputIsEscapedEverywhere) {
  const std::string bad = "<b>\"&'.hdr";
  Json manifest = full_manifest();
  manifest["source"] = manifest["description"] = manifest["generator"] = bad;
  manifest["input"]["warnings"] = {bad};
  manifest["conventions"] = {{bad, bad}};
  manifest["level_law"] = {{"name", bad}, {"formula", bad}};
  manifest["files"][0]["name"] = "specular" + bad;
  for (const char* member : {"quantity", "unit", "container", "format"}) manifest["files"][0][member] = bad;
  manifest["levels"][1]["kernel"] = manifest["irradiance"]["method"] = bad;
  const std::string page = make_report_html(manifest);
  EXPECT_EQ(page.find("<b>"), std::string::npos);
  EXPECT_EQ(page.find("\"&'"), std::string::npos);
  EXPECT_NE(page.find("<h1>&lt;b&gt;&quot;&amp;&#39;.hdr</h1>"), std::string::npos);
  EXPECT_NE(page.find("href=\"./specular%3Cb%3E%22%26%27.hdr\""), std::string::npos);
  EXPECT_EQ(fault_of(page), "");
}

TEST(Report, WithoutAnythingItIsStillAPage) {
  for (const char* text : {"{}", "[]", "null", "7"}) {
    const std::string page = make_report_html(Json::parse(text));
    EXPECT_EQ(fault_of(page), "") << text;
    EXPECT_EQ(page.find("<table"), std::string::npos) << text;
    EXPECT_NE(page.find("./preview.png"), std::string::npos) << text;
    EXPECT_EQ(page.find("environment.png"), std::string::npos) << text;
  }
}

// Members of an unexpected type are left out: each member in turn is replaced by values of every type.
TEST(Report, MembersOfAnyTypeMakeAPage) {
  const Json flat = full_manifest().flatten();
  for (const auto& item : flat.items())
    for (const char* value :
         {"null", "\"text\"", "-3", "2.5", "true", "[]", "{}", "[1, null, \"a\"]", "{\"a\": []}"}) {
      for (Json::json_pointer at(item.key()); !at.empty(); at = at.parent_pointer()) {
        Json manifest = full_manifest();
        manifest[at] = Json::parse(value);
        EXPECT_EQ(fault_of(make_report_html(manifest)), "") << at.to_string() << " = " << value;
      }
    }
}

TEST(Report, OnlyTheColumnsThatTheManifestHas) {
  Json manifest = full_manifest();
  EXPECT_NE(make_report_html(manifest).find("Relative RMS</th>"), std::string::npos);
  manifest["levels"][1].erase("errors");
  manifest.erase("trilinear");
  manifest.erase("irradiance");
  const std::string page = make_report_html(manifest);
  EXPECT_EQ(page.find("Relative RMS</th>"), std::string::npos);
  EXPECT_NE(page.find("Perceptual roughness</th>"), std::string::npos);
}

TEST(Picture, TextIsDrawnWhereItIsSaidAndCutAtTheEdge) {
  ByteImage image(40, 20);
  EXPECT_EQ(draw_text(image, 2, 3, 2, "1", {255, 200, 100}), 14);
  EXPECT_EQ(text_width("1", 2), 10);
  EXPECT_EQ(text_width("", 2), 0);
  EXPECT_EQ(image.at(2 + 2 * 2, 3)[1], 200);  // the tip of the 1 is the third of five dots
  EXPECT_EQ(image.at(2, 3)[0], 0);
  EXPECT_EQ(image.at(2 + 2 * 2, 3 + 2 * text_height - 1)[2], 100);
  EXPECT_EQ(image.at(2 + 2 * 2, 3 + 2 * text_height)[2], 0);
  draw_text(image, 35, -5, 2, "WW", {255, 255, 255});  // would write outside
  EXPECT_EQ(image.pixels.size(), 40u * 20u * 3u);
}

TEST(Picture, BlitCutsAtEveryEdge) {
  ByteImage source(3, 3);
  for (int i = 0; i < 9; ++i) source.pixels[3 * i] = static_cast<std::uint8_t>(i + 1);
  ByteImage target(4, 4);
  blit(source, target, -1, -2);
  EXPECT_EQ(target.at(0, 0)[0], 8);
  EXPECT_EQ(target.at(1, 0)[0], 9);
  EXPECT_EQ(target.at(2, 0)[0], 0);
  EXPECT_EQ(target.at(0, 1)[0], 0);
  blit(source, target, 2, 3);
  EXPECT_EQ(target.at(2, 3)[0], 1);
  EXPECT_EQ(target.at(3, 3)[0], 2);
  blit(source, target, 9, -9);  // wholly outside
  EXPECT_EQ(target.at(3, 0)[0], 0);
}

TEST(Picture, ShrinkTakesRoundedMeans) {
  ByteImage source(4, 2, 1);
  source.pixels = {0, 1, 10, 20, 1, 1, 30, 41};
  const ByteImage result = shrink(source, 2);
  ASSERT_EQ(result.pixels.size(), 2u);
  EXPECT_EQ(result.pixels[0], 1);   // 0.75
  EXPECT_EQ(result.pixels[1], 25);  // 25.25
}

TEST(Preview, KnowsTheLawFromTheLevels) {
  for (LevelLaw law : {LevelLaw::linear, LevelLaw::quadratic, LevelLaw::logarithmic})
    EXPECT_EQ(level_law_of(small_set(constant_map(1, 1, 1), law)), law);
}

TEST(Preview, IsAsWideAsSaidAndHoldsItsSpheres) {
  const IblSet set = small_set(constant_map(1, 1, 1));
  const ByteImage sheet = make_preview(set);
  EXPECT_EQ(sheet.width, 1280);
  EXPECT_EQ(sheet.channels, 3);
  EXPECT_EQ(sheet.pixels.size(), std::size_t{3} * sheet.width * sheet.height);
  const std::vector<PreviewSphere> spheres = preview_spheres(set);
  ASSERT_EQ(spheres.size(), 11u);
  for (const PreviewSphere& sphere : spheres) {
    EXPECT_GE(sphere.x - sphere.radius, 0);
    EXPECT_LE(sphere.x + sphere.radius, sheet.width);
    EXPECT_GE(sphere.y - sphere.radius, 0);
    EXPECT_LE(sphere.y + sphere.radius, sheet.height);
  }
}

// What a sphere reflects of a constant environment, in closed form but for the table.
Image constant_reflection(const IblSet& set, const PreviewSphere& sphere, double cos_view,
                          const float* radiance) {
  const PreviewMaterial& m = sphere.material;
  const DfgValue dfg = m.glossy ? look_up_dfg(set.dfg, cos_view, m.perceptual_roughness) : DfgValue{};
  Image pixel(1, 1);
  for (int c = 0; c < 3; ++c) {
    const double reflectance = m.f0[c] * dfg.scale + dfg.bias;
    pixel.pixels[c] = static_cast<float>(radiance[c] * (reflectance + m.albedo[c] * (1 - reflectance)));
  }
  return pixel;
}

// Energy: a constant environment L gives L (F0 scale + bias) and albedo L. One byte is the rounding of the table of
// tone_map and of the mean of four samples.
TEST(Preview, ConstantEnvironmentGivesTheReflectanceOfTheTable) {
  const float radiance[] = {0.5f, 1.0f, 2.0f};
  const IblSet set = small_set(constant_map(radiance[0], radiance[1], radiance[2]));
  const ByteImage sheet = make_preview(set);
  ToneMapOptions tone = preview_tone(set);
  for (const PreviewSphere& sphere : preview_spheres(set))
    for (double offset : {0.0, 0.3, -0.6}) {
      const int x = static_cast<int>(sphere.x + offset * sphere.radius), y = static_cast<int>(sphere.y);
      const double d = std::hypot(x + 0.5 - sphere.x, y + 0.5 - sphere.y) / sphere.radius;
      const ByteImage expected =
          tone_map(constant_reflection(set, sphere, std::sqrt(1 - d * d), radiance), tone);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(sheet.at(x, y)[c], expected.pixels[c], 1)
            << sphere.material.perceptual_roughness << " " << offset;
    }
}

// A light that was taken out of the set: the matt sphere gets albedo/pi times its irradiance where it faces it, and
// nothing on the other side.
TEST(Preview, LightsBesideTheSetLightTheSpheres) {
  const float radiance[] = {0.5f, 1.0f, 2.0f};
  const IblSet set = small_set(constant_map(radiance[0], radiance[1], radiance[2]));
  DirectionalLight light;
  light.direction = {1, 0, 0};
  light.irradiance = {6, 3, 1.5};
  const ByteImage sheet = make_preview(set, {&light, 1});
  const ToneMapOptions tone = preview_tone(set, {&light, 1});
  const PreviewSphere matt = preview_spheres(set)[9];
  for (double offset : {0.8, 0.3, -0.5}) {
    const int x = static_cast<int>(matt.x + offset * matt.radius), y = static_cast<int>(matt.y);
    const double cosine = std::max(0.0, (x + 0.5 - matt.x) / matt.radius);
    Image pixel(1, 1);
    for (int c = 0; c < 3; ++c)
      pixel.pixels[c] = static_cast<float>(
          0.8 * (static_cast<double>(radiance[c]) + cosine * light.irradiance[c] / std::numbers::pi));
    const ByteImage expected = tone_map(pixel, tone);
    // The irradiance cube is small: its interpolation is a per cent off.
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sheet.at(x, y)[c], expected.pixels[c], 3) << offset;
  }
  // A glossy sphere has its highlight half way between light and camera.
  const PreviewSphere metal = preview_spheres(set)[2];
  const int x = static_cast<int>(metal.x + std::sqrt(0.5) * metal.radius), y = static_cast<int>(metal.y);
  EXPECT_GT(sheet.at(x, y)[0], sheet.at(static_cast<int>(metal.x), y)[0] + 40);
}

// The camera stands at +Z: a mirror sphere shows a light from direction d where its normal is half way between d and
// +Z. The lobe of a rough metal and the table shift it a little; the disc of the light and the texels (32 a face) are
// some 0.05 radii.
TEST(Preview, HighlightLiesWhereTheLightIs) {
  for (const Vec3 light : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0.6, -0.64, 0.48}}) {
    const IblSet set = small_set(one_sided_map(light));
    const ByteImage sheet = make_preview(set);
    const Vec3 half = normalized(light + Vec3{0, 0, 1});
    const PreviewSphere mirror = preview_spheres(set).front();
    const Offset found = highlight_of(sheet, mirror);
    EXPECT_NEAR(found.x, half.x, 0.08);
    EXPECT_NEAR(found.y, half.y, 0.08);
    const PreviewSphere plastic = preview_spheres(set).back();
    const Offset spot = highlight_of(sheet, plastic);
    EXPECT_NEAR(spot.x, half.x, 0.12);
    EXPECT_NEAR(spot.y, half.y, 0.12);
  }
}

// A matt sphere is brightest where it faces the light.
TEST(Preview, MattSphereFacesTheLight) {
  const IblSet set = small_set(one_sided_map({0.6, 0, 0.8}));
  const ByteImage sheet = make_preview(set);
  const Offset found = highlight_of(sheet, preview_spheres(set)[9]);
  EXPECT_NEAR(found.x, 0.6, 0.1);  // cosine: flat at its top
  EXPECT_NEAR(found.y, 0, 0.1);
}

// Behind the spheres the camera looks along -Z with +X on the right: light from there is in the middle of the tile.
TEST(Preview, BackgroundLooksAlongMinusZ) {
  const IblSet set = small_set(one_sided_map(normalized({0.45, 0, -0.9})));
  const ByteImage sheet = make_preview(set);
  const PreviewSphere matt = preview_spheres(set)[9];
  const int y = static_cast<int>(matt.y), gap = static_cast<int>(matt.radius + 12);
  const int left = brightness(sheet.at(static_cast<int>(matt.x) - gap, y));
  const int right = brightness(sheet.at(static_cast<int>(matt.x) + gap, y));
  EXPECT_GT(right, left + 100);  // 20 against 0.05
}

// However small the sun, what it lights stays visible.
TEST(Preview, OneBrightTexelDoesNotTurnAllElseBlack) {
  Image map = constant_map(0.2f, 0.2f, 0.2f);
  std::fill_n(map.at(40, 10), 3, 2e5f);
  const IblSet set = small_set(map);
  const ByteImage sheet = make_preview(set);
  const PreviewSphere matt = preview_spheres(set)[9];
  EXPECT_GT(brightness(sheet.at(static_cast<int>(matt.x), static_cast<int>(matt.y))), 3 * 40);
}

}  // namespace
}  // namespace welkin

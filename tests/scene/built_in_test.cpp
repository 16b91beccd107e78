#include <welkin/scene/built_in.h>

#include <gtest/gtest.h>

#include <set>
#include <string>

#include <welkin/error.h>
#include <welkin/scene/gltf.h>
#include <welkin/scene/gltf_write.h>

namespace welkin {
namespace {

std::string error_of(std::string_view name) {
  try {
    make_built_in_scene(name);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(BuiltInScenes, AreFramedNamedAndWhole) {
  ASSERT_FALSE(built_in_scenes().empty());
  for (const BuiltInScene& entry : built_in_scenes()) {
    const Scene scene = make_built_in_scene(entry.name);
    EXPECT_EQ(scene.source, entry.name);
    EXPECT_FALSE(entry.description.empty());
    EXPECT_EQ(scene.cameras.size(), 1u) << entry.name;
    EXPECT_TRUE(scene_bounds(scene)) << entry.name;
    EXPECT_TRUE(scene.warnings.empty()) << entry.name;
    std::set<std::string> names;
    for (const Material& material : scene.materials) names.insert(material.name);
    EXPECT_EQ(names.size(), scene.materials.size()) << entry.name << ": names are missing or repeated";
    EXPECT_FALSE(names.contains("")) << entry.name;
  }
}

TEST(BuiltInScenes, SpheresTakesItsColumns) {
  const Scene scene = make_built_in_scene("spheres:alphas=0/0.25");
  ASSERT_EQ(scene.spheres.size(), 4u);
  EXPECT_EQ(scene.materials[scene.spheres[0].material].name, "metal mirror");
  EXPECT_EQ(scene.materials[scene.spheres[3].material].name, "plastic 0.25");
  EXPECT_FLOAT_EQ(scene.materials[scene.spheres[3].material].perceptual_roughness, 0.5f);
  EXPECT_LT(scene.spheres[0].centre.x, scene.spheres[1].centre.x);
  EXPECT_GT(scene.spheres[0].centre.y, scene.spheres[2].centre.y);
  EXPECT_FLOAT_EQ(*scene.cameras[0].width_over_height, 1);
}

TEST(BuiltInScenes, SphereRestsOnThePlane) {
  const Scene scene = make_built_in_scene("plane:radius=0.5");
  EXPECT_EQ(scene.spheres[0].centre.y, 0.5f);
  EXPECT_EQ(scene.spheres[0].radius, 0.5f);
  EXPECT_EQ(scene_bounds(scene)->low.y, 0);
}

// Through GLB and back: spheres are meshes then, and their polygons lie inside them by 1 - cos(pi / 256) = 8e-5.
TEST(BuiltInScenes, ComeBackFromGlb) {
  for (const char* name : {"plane", "box", "shader-ball", "spheres:alphas=0.5"}) {
    const Scene scene = make_built_in_scene(name);
    const Scene back = decode_gltf(encode_glb(scene), "back", {});
    EXPECT_EQ(back.instances.size(), scene.instances.size() + scene.spheres.size()) << name;
    EXPECT_EQ(back.materials.size(), scene.materials.size()) << name;
    EXPECT_EQ(back.warnings.size(), 0u) << name;
    ASSERT_EQ(back.cameras.size(), 1u) << name;
    EXPECT_EQ(back.cameras[0].orthographic_height, scene.cameras[0].orthographic_height) << name;
    EXPECT_NEAR(back.cameras[0].to_world.origin.z, scene.cameras[0].to_world.origin.z, 1e-6f) << name;
    EXPECT_NEAR(scene_bounds(back)->high.x, scene_bounds(scene)->high.x, 1e-4f) << name;
    EXPECT_NEAR(scene_bounds(back)->high.y, scene_bounds(scene)->high.y, 1e-4f) << name;
  }
}

TEST(BuiltInScenes, RefuseWhatTheyDoNotKnow) {
  EXPECT_EQ(error_of("cube").substr(0, 66),
            "cube: there is no built-in scene of this name; there are spheres, ");
  EXPECT_EQ(error_of("plane:size=2"), "plane:size=2: there is no parameter size");
  EXPECT_EQ(error_of("plane:radius"),
            "plane:radius: \"radius\" is not a parameter; they are written key=value");
  EXPECT_EQ(error_of("plane:radius=two"),
            "plane:radius=two: radius must be a number from 0.01 to 10, not \"two\"");
  EXPECT_EQ(error_of("plane:radius=nan"),
            "plane:radius=nan: radius must be a number from 0.01 to 10, not \"nan\"");
  EXPECT_EQ(error_of("spheres:alphas=0//1"),
            "spheres:alphas=0//1: alphas must be a number from 0 to 1, not \"\"");
}

}  // namespace
}  // namespace welkin

#include <gtest/gtest.h>

#include <random>

#include <welkin/realtime/gl/headless_context.h>
#include <welkin/realtime/viewer/viewer.h>
#include <welkin/scene/shapes.h>

// Any order of changes, any technique: no OpenGL error, nothing left behind.

namespace welkin {
namespace {

std::shared_ptr<const EnvironmentData> small_light(float level) {
  Image sky(32, 16);
  for (std::size_t i = 0; i < sky.pixels.size(); ++i)
    sky.pixels[i] = level * (0.5f + static_cast<float>(i % 7));
  IblOptions options;
  options.size = 16;
  options.irradiance_size = 8;
  options.dfg_size = 16;
  return make_environment_data(std::move(sky), options);
}

// Few triangles: a sheet with everything that a mesh can have, and one without normals or texcoords.
Scene small_scene(bool textured) {
  Scene scene;
  scene.source = "small";
  Mesh sheet;
  sheet.positions = {{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}};
  sheet.triangles = {{0, 2, 1}, {0, 3, 2}};
  scene.materials.emplace_back();
  if (textured) {
    sheet.normals = {{0, 1, 0}, {0, 1, 0}, {0, 1, 0}, {0, 1, 0}};
    sheet.texcoords[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    Texture texture;
    texture.image = Image(2, 2);
    std::fill(texture.image.pixels.begin(), texture.image.pixels.end(), 0.5f);
    scene.textures.push_back(texture);
    scene.materials[0].base_color_texture.texture = 0;
    scene.materials[0].normal_texture.texture = 0;
  }
  scene.meshes.push_back(sheet);
  scene.instances.push_back({});
  check_scene(scene);
  return scene;
}

// Names up to the largest that was given out, of every kind that OpenGL can be asked about.
int objects_of_the_context() {
  glUseProgram(0);  // a program in use lives on until another is
  int found = 0;
  for (GLuint name = 1; name < 20000; ++name) {
    found += glIsTexture(name) + glIsBuffer(name) + glIsFramebuffer(name) + glIsVertexArray(name) +
             glIsRenderbuffer(name) + glIsProgram(name) + glIsQuery(name) + glIsShader(name);
  }
  return found;
}

class Shaker {
 public:
  explicit Shaker(unsigned seed) : random_(seed) {}

  void step(Viewer& viewer) {
    ViewerState& state = viewer.state;
    switch (below(12)) {
      case 0: viewer.resize(1 + below(70), 1 + below(50)); break;
      case 1: viewer.resize(1, 1); break;
      case 2:
      case 3: random_technique(state.technique); break;
      case 4: random_technique(state.reference_technique); break;
      case 5: viewer.set_scene(small_scene(below(2) == 0)); break;
      case 6: viewer.set_environment(below(2) == 0 ? dim_ : bright_); break;
      case 7: state.comparison = static_cast<Comparison>(below(5)); break;
      case 8: state.reference = static_cast<ReferenceKind>(below(2)); break;
      case 9:
        viewer.set_truth(Image(1 + below(64), 1 + below(48), 3 + below(2)), viewer.view_number());
        break;
      case 10: move(state); break;
      default: set_timing(viewer); break;
    }
    viewer.draw();
    viewer.show(target_.framebuffer.name(), {below(9) - 4, 3, below(40), below(40)});
    if (below(4) == 0) viewer.screenshot();
  }

 private:
  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }

  void random_technique(TechniqueChoice& choice) {
    const auto all = techniques();
    choose_technique(choice, all[static_cast<std::size_t>(below(static_cast<int>(all.size())))]);
    for (std::size_t i = 0; i < choice.values.size(); ++i) {
      const Parameter& p = choice.technique->parameters[i];
      // Costs grow with counts and sizes, so mostly the cheaper half.
      const float share = static_cast<float>(below(101)) / 200.0f;
      choice.values[i] = p.minimum + share * (p.maximum - p.minimum);
    }
  }
  void move(ViewerState& state) {
    orbit(state.camera, {0.01f * static_cast<float>(below(100)), 0.02f});
    zoom(state.camera, below(2) == 0 ? 0.5f : 2.0f);
    state.rotation_degrees = static_cast<float>(below(360));
    state.time_seconds = below(5);
    state.background = below(3) != 0;
  }
  void set_timing(Viewer& viewer) {
    PassTimer& timer = viewer.renderer().timer();
    timer.enabled = below(2) == 0;
    timer.mode = below(2) == 0 ? TimerMode::clock : TimerMode::queries;
  }

  std::mt19937 random_;
  const std::shared_ptr<const EnvironmentData> dim_ = small_light(0.2f), bright_ = small_light(1000);
  const TexelFormat format_ = TexelFormat::rgba8;
  RenderTarget target_ = make_render_target(32, 32, &format_, 1, false);
};

void shake(unsigned seed, int steps) {
  const HeadlessContext context;
  {
    Shaker shaker(seed);
    Viewer viewer;
    viewer.set_scene(small_scene(true));
    viewer.set_environment(small_light(1));
    viewer.resize(40, 30);
    for (int i = 0; i < steps; ++i) {
      const std::string before = viewer.state.technique.technique == nullptr
                                     ? "the first"
                                     : std::string(viewer.state.technique.technique->name);
      ASSERT_NO_THROW(shaker.step(viewer)) << "step " << i << " from " << before;
      ASSERT_EQ(glGetError(), GLenum{GL_NO_ERROR}) << "step " << i << " after " << before;
    }
  }
  for (const int living : living_gl_objects()) EXPECT_EQ(living, 0);
  EXPECT_EQ(objects_of_the_context(), 0);
}

TEST(Robustness, AnySequenceOfChangesLeavesNoErrorAndNoObject) { shake(1, 25); }
TEST(Robustness, AnotherSequence) { shake(7, 25); }

// Every technique drawn at the least size, an odd one, and again after a change of scene.
TEST(Robustness, EveryTechniqueAtEverySize) {
  const HeadlessContext context;
  {
    Viewer viewer;
    viewer.set_scene(small_scene(false));
    viewer.set_environment(small_light(1));
    bool textured = false;
    for (const TechniqueInfo& technique : techniques()) {
      choose_technique(viewer.state.technique, technique);
      for (const auto& [width, height] : {std::pair{1, 1}, {17, 5}}) {
        viewer.resize(width, height);
        ASSERT_NO_THROW(viewer.draw()) << technique.name << " " << width;
        EXPECT_EQ(viewer.screenshot().width, width);
      }
      viewer.set_scene(small_scene(textured = !textured));
      ASSERT_NO_THROW(viewer.draw()) << technique.name;
      EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR}) << technique.name;
    }
  }
  for (const int living : living_gl_objects()) EXPECT_EQ(living, 0);
  EXPECT_EQ(objects_of_the_context(), 0);
}

}  // namespace
}  // namespace welkin

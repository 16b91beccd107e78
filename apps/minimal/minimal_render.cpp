// A built-in scene under an environment, rendered: radiance with its standard error as OpenEXR, and a PNG to look at.
// Usage: minimal_render [SCENE [ENVIRONMENT [OUTPUT.exr]]]     SCENE is built in or a .gltf, .glb, .obj or .ply file
#include <welkin/envmap/environment.h>
#include <welkin/error.h>
#include <welkin/image/codecs/exr_layers.h>
#include <welkin/image/codecs/ldr.h>
#include <welkin/image/output_file.h>
#include <welkin/image/tonemap.h>
#include <welkin/pathtrace/picture.h>
#include <welkin/scene/read_scene.h>

#include <cstdio>
#include <string>

int main(int argc, char** argv) try {
  const std::string output = argc > 3 ? argv[3] : "picture.exr";
  const welkin::Scene scene = welkin::open_scene(argc > 1 ? argv[1] : "spheres");
  const welkin::Environment environment =
      welkin::load_environment(argc > 2 ? argv[2] : "sky:studio,size=256x128");
  const welkin::EnvironmentSampler light(environment.radiance);

  // Rays, lights and materials, made once.
  const welkin::RenderScene render_scene(scene, &light);
  const auto bounds = welkin::scene_bounds(scene);
  const welkin::Camera camera = scene.cameras.empty() && bounds ? welkin::default_camera(*bounds, 2)
                                : scene.cameras.empty()         ? welkin::Camera{}
                                                                : scene.cameras.front();
  welkin::PictureOptions options;
  options.size = {280, 80};
  options.samples = 32;
  options.integrator.max_bounces = 8;

  // The state can be stored (checkpoint.h) and gone on with; the observer could stop it.
  welkin::PictureState state = welkin::make_picture_state(options.size);
  welkin::render_picture(state, render_scene, camera, options);
  const welkin::PictureError error = welkin::picture_error(state);
  std::printf("%.0f samples a pixel, standard error %.3g of the luminance\n", error.mean_samples,
              error.mean_relative_error);

  const welkin::PictureLayers layers = welkin::make_picture_layers(state);
  const std::vector<std::string> rgb{"R", "G", "B"};
  welkin::write_file(output, welkin::encode_exr_layers({{{"", rgb, layers.radiance},
                                                         {"stderr", rgb, layers.standard_error},
                                                         {"depth", {"Z"}, layers.depth}},
                                                        welkin::picture_replicates - 1}));
  welkin::ToneMapOptions tone;
  tone.curve = welkin::ToneCurve::filmic;
  welkin::write_file(output + ".png", welkin::encode_png(welkin::tone_map(layers.radiance, tone)));
} catch (const welkin::Error& error) {
  std::fprintf(stderr, "minimal_render: %s\n", error.what());
  return 1;
}

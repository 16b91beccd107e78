#include <welkin/pathtrace/picture.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include <welkin/error.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/pathtrace/checkpoint.h>
#include <welkin/pathtrace/fingerprint.h>
#include <welkin/pathtrace/picture_loop.h>
#include <welkin/sampling/sobol.h>

// The film and its loop, with functions of pixel and number whose mean and variance are known in place of a renderer.

namespace welkin {
namespace {

// Independent numbers: no stratification, so that the error is what s^2/n says as well.
double random_unit(int x, int y, int replicate, std::uint32_t index) {
  std::uint32_t h = mix_bits32(static_cast<std::uint32_t>(x) + 0x9e3779b9u);
  h = mix_bits32(h ^ (static_cast<std::uint32_t>(y) * 0x85ebca6bu + 7));
  h = mix_bits32(h ^ (static_cast<std::uint32_t>(replicate) * 0xc2b2ae35u + 11));
  return mix_bits32(h ^ (index * 0x27d4eb2fu + 13)) * 0x1p-32;
}

// Uniform about a mean that grows from left to right: mean 1 + x, standard deviation (1 + x) / sqrt(12).
PixelSample uniform_noise(int x, int y, int replicate, std::uint32_t index) {
  const auto u = static_cast<float>(random_unit(x, y, replicate, index));
  const float value = (1 + static_cast<float>(x)) * (0.5f + u);
  return {{value, 2 * value, 3 * value}, {0.25f, 0.5f, 1}, {0, 0, 1}, 7, 1};
}

PictureState rendered(const PictureOptions& options, const PictureObserver& observer = {}) {
  PictureState state = make_picture_state(options.size);
  sample_picture(state, options, uniform_noise, observer);
  return state;
}

TEST(Picture, MeansAndLayers) {
  const PictureOptions options{{40, 33}, 100, 0, 64, {}};
  const PictureLayers layers = make_picture_layers(rendered(options));
  for (const auto& [x, y] : {std::pair{0, 0}, {39, 32}, {17, 20}}) {
    const float mean = 1 + static_cast<float>(x);
    for (int c = 0; c < 3; ++c) {
      // Six standard errors of the mean of 100 uniform numbers.
      EXPECT_NEAR(layers.radiance.at(x, y)[c] / (mean * static_cast<float>(c + 1)), 1, 6 / std::sqrt(1200.0));
      EXPECT_FLOAT_EQ(layers.albedo.at(x, y)[c], 0.25f * static_cast<float>(1 << c));
      EXPECT_EQ(layers.normal.at(x, y)[c], c == 2 ? 1 : 0);
    }
    EXPECT_EQ(layers.depth.at(x, y)[0], 7);
    EXPECT_EQ(layers.coverage.at(x, y)[0], 1);
    EXPECT_EQ(layers.samples.at(x, y)[0], 100);
  }
}

TEST(Picture, DepthIsOfWhatWasMet) {
  const auto half_covered = [](int, int, int, std::uint32_t index) {
    return index % 2 == 0 ? PixelSample{{1, 1, 1}, {}, {}, 3, 1} : PixelSample{};
  };
  PictureState state = make_picture_state({1, 1});
  sample_picture(state, {{1, 1}, 32, 0, 64, {}}, half_covered);
  const PictureLayers layers = make_picture_layers(state);
  EXPECT_EQ(layers.depth.pixels[0], 3);
  EXPECT_EQ(layers.coverage.pixels[0], 0.5f);
  EXPECT_EQ(layers.radiance.pixels[0], 0.5f);
}

// Mean square of (value - truth) / standard error over many pixels: F-distributed with (1, 7) degrees of freedom, of mean
// 7/5 and variance 2 * 49 * 6 / (25 * 3) = 7.84; 3 times 1/sqrt(N) of that. And the mean of the squared error itself is
// the variance, 1 / 12 / n.
TEST(Picture, StandardErrorIsHonestForIndependentSamples) {
  const PictureOptions options{{64, 64}, 64, 0, 64, {}};
  const PictureLayers layers = make_picture_layers(rendered(options));
  double ratio = 0, variance = 0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const double truth = 1 + x, error = layers.standard_error.at(x, y)[0];
      ratio += std::pow((layers.radiance.at(x, y)[0] - truth) / error, 2) / 4096;
      variance += std::pow(error / truth, 2) / 4096;
    }
  }
  EXPECT_NEAR(ratio, 1.4, 4 * 2.8 / 64);
  EXPECT_NEAR(variance * 12 * 64, 1, 4 * std::sqrt(2.0 / 7) / 64);
}

// Owen-scrambled points of a smooth function: the error falls faster than s^2/n says, and the replicates know it.
TEST(Picture, StandardErrorIsHonestForStratifiedSamples) {
  const auto smooth = [](int x, int y, int replicate, std::uint32_t index) {
    SampleStream stream(index, mix_bits32(static_cast<std::uint32_t>(x + 1000 * y + 1000000 * replicate)));
    const Vec2f u = stream.next_2d();
    const float value = u.x * u.y;
    return PixelSample{{value, value, value}, {}, {}, 0, 0};
  };
  PictureState state = make_picture_state({64, 64});
  sample_picture(state, {{64, 64}, 256, 0, 64, {}}, smooth);
  const PictureLayers layers = make_picture_layers(state);
  double true_square = 0, stated_square = 0;
  for (std::size_t i = 0; i < 4096; ++i) {
    true_square += std::pow(layers.radiance.pixels[3 * i] - 0.25, 2) / 4096;
    stated_square += std::pow(layers.standard_error.pixels[3 * i], 2) / 4096;
  }
  // Both are means over 4096 pixels: 2 % and 1 % of noise.
  EXPECT_NEAR(stated_square / true_square, 1, 0.1);
  const double independent = (1.0 / 9 - 1.0 / 16) / 256;  // the variance of u v, over n
  EXPECT_LT(stated_square, 0.25 * independent);
}

std::vector<std::uint8_t> bytes_of(const PictureState& state) { return encode_checkpoint(state, 1); }

TEST(Picture, SameBytesOnAnyNumberOfThreadsAndInAnySteps) {
  for (const double target : {0.0, 0.02}) {
    const PictureOptions options{{50, 37}, 200, target, 16, {}};
    set_thread_count(1);
    const auto once = bytes_of(rendered(options));
    set_thread_count(3);
    EXPECT_EQ(bytes_of(rendered(options)), once);
    set_thread_count(0);
    PictureState state = make_picture_state(options.size);
    int runs = 0;
    // Stopped after every group of tiles, and through a checkpoint each time.
    while (!sample_picture(state, options, uniform_noise, [](const PictureProgress&) { return false; })) {
      state = decode_checkpoint(encode_checkpoint(state, 5), "part", options.size, 5);
      if (++runs > 10000) break;
    }
    EXPECT_GT(runs, 3);
    EXPECT_EQ(bytes_of(state), once);
  }
}

TEST(Picture, GoesOnToMoreSamples) {
  PictureState state = rendered({{20, 20}, 30, 0, 64, {}});
  sample_picture(state, {{20, 20}, 75, 0, 64, {}}, uniform_noise);
  EXPECT_EQ(bytes_of(state), bytes_of(rendered({{20, 20}, 75, 0, 64, {}})));
}

TEST(Picture, FaultsAreCountedAndBlack) {
  const auto faulty = [](int, int, int replicate, std::uint32_t) {
    const float value = replicate == 0 ? NAN : replicate == 1 ? INFINITY : 1.0f;
    return PixelSample{{1, value, 1}, {}, {}, 0, 0};
  };
  PictureState state = make_picture_state({4, 4});
  sample_picture(state, {{4, 4}, 8, 0, 64, {}}, faulty);
  EXPECT_EQ(state.faults, 32u);
  for (float value : make_picture_layers(state).radiance.pixels) EXPECT_FLOAT_EQ(value, 0.75f);
}

TEST(Picture, SizesAreChecked) {
  EXPECT_THROW(make_picture_state({0, 5}), Error);
  EXPECT_THROW(make_picture_state({5, -1}), Error);
  EXPECT_THROW(make_picture_state({16385, 1}), Error);
  EXPECT_THROW(make_picture_state({16384, 16384}), Error);
}

// Noise of 0.29 of the mean: an error of 2 % takes (0.29 / 0.02)^2 = 208 samples.
TEST(Adaptive, ReachesItsErrorAndNoMore) {
  const PictureOptions options{{64, 64}, 5000, 0.02, 32, {}};
  PictureState state = rendered(options);
  const PictureError error = picture_error(state, options.target_error);
  // A pixel stays stopped when more samples of its neighbours change what is known of its own error and reference.
  EXPECT_GT(error.share_reached, 0.95);
  EXPECT_LE(error.worst_relative_error, 0.02 * 1.15);
  EXPECT_GT(error.mean_samples, 150);
  EXPECT_LT(error.mean_samples, 420);
  const Image radiance = picture_radiance(state);
  double square = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 32; x < 64; ++x)  // where the reference is the pixel's own mean, not the picture's
      square += std::pow(double{radiance.at(x, y)[0]} / (1 + x) - 1, 2) / 2048;
  EXPECT_LT(std::sqrt(square), 0.021);
  EXPECT_GT(std::sqrt(square), 0.012);
}

// One sample in 200 is bright: most pixels see nothing in 32. Their neighbours tell them to go on, and the mean is right
// to 1 %: six standard errors of it would be 6 sqrt(199 / 3e6) = 5 %, one 0.8 %.
TEST(Adaptive, RareLightIsNotMissed) {
  const auto rare = [](int x, int y, int replicate, std::uint32_t index) {
    const float value = random_unit(x, y, replicate, index) < 0.005 ? 200.0f : 0.0f;
    return PixelSample{{value, value, value}, {}, {}, 0, 0};
  };
  const PictureOptions options{{64, 64}, 4096, 0.5, 32, {}};
  PictureState state = make_picture_state(options.size);
  sample_picture(state, options, rare);
  double mean = 0;
  for (const float value : picture_radiance(state).pixels) mean += value / (3 * 4096.0);
  EXPECT_NEAR(mean, 1, 0.05);
    std::printf("mean %g\n",mean);EXPECT_GT(picture_error(state, 0.5).mean_samples, 400);
}

TEST(Adaptive, BlackPictureEnds) {
  const auto black = [](int, int, int, std::uint32_t) { return PixelSample{}; };
  PictureState state = make_picture_state({20, 20});
  EXPECT_TRUE(sample_picture(state, {{20, 20}, 1000, 0.01, 32, {}}, black));
  EXPECT_EQ(picture_error(state, 0.01).mean_samples, 32);
}

TEST(Adaptive, StopsAtTheMostSamples) {
  PictureState state = rendered({{20, 20}, 50, 1e-6, 16, {}});
  for (const std::uint32_t count : state.count) EXPECT_EQ(count, 50u);
  EXPECT_EQ(picture_error(state, 1e-6).share_reached, 0);
}

std::string checkpoint_refusal(std::vector<std::uint8_t> bytes, PictureSize size = {5, 4},
                               std::uint64_t mark = 9) {
  try {
    decode_checkpoint(bytes, "p.state", size, mark);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Checkpoint, DamageIsRefused) {
  const auto whole = encode_checkpoint(rendered({{5, 4}, 9, 0, 64, {}}), 9);
  EXPECT_EQ(checkpoint_refusal(whole), "");
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_TRUE(checkpoint_refusal({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)})
                    .starts_with("p.state: "));
  for (std::size_t at = 0; at < whole.size(); at += 7) {
    auto bytes = whole;
    bytes[at] ^= 16;
    EXPECT_TRUE(checkpoint_refusal(bytes).starts_with("p.state: ")) << at;
  }
  EXPECT_NE(checkpoint_refusal(whole, {5, 4}, 8).find("another scene"), std::string::npos);
  EXPECT_NE(checkpoint_refusal(whole, {4, 5}).find("5 x 4, not of 4 x 5"), std::string::npos);
}

TEST(Fingerprint, TellsEverythingApart) {
  Scene scene;
  scene.materials.resize(1);
  scene.meshes.resize(1);
  scene.meshes[0].positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  scene.spheres.push_back({});
  const Camera camera;
  const Image map(4, 2);
  PictureOptions options;
  const auto print = [&] { return picture_fingerprint(scene, camera, &map, options); };
  const std::uint64_t before = print();
  EXPECT_EQ(print(), before);
  EXPECT_NE(picture_fingerprint(scene, camera, nullptr, options), before);
  Camera turned = camera;
  turned.to_world.origin.x = 1e-7f;
  EXPECT_NE(picture_fingerprint(scene, turned, &map, options), before);
  const auto changes = [&](auto& value, auto other) {
    const auto old = value;
    value = other;
    EXPECT_NE(print(), before);
    value = old;
    EXPECT_EQ(print(), before);
  };
  changes(scene.materials[0].metallic, 0.5f);
  changes(scene.materials[0].base_color.b, 0.999f);
  changes(scene.meshes[0].positions[2].y, 1.0001f);
  changes(scene.spheres[0].radius, 2.0f);
  changes(options.integrator.seed, 1u);
  changes(options.integrator.max_bounces, 3);
  changes(options.target_error, 0.01);
  options.samples = 1000;  // more samples are the same picture
  EXPECT_EQ(print(), before);
}

}  // namespace
}  // namespace welkin

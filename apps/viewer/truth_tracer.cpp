#include "truth_tracer.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <numbers>
#include <vector>

#include <welkin/pathtrace/picture_loop.h>
#include <welkin/pathtrace/render_sample.h>

namespace welkin {
namespace {

// Traces what the camera sees and nothing else: no surface hides the environment from another.
class UnshadowedRays {
 public:
  explicit UnshadowedRays(const RayScene& scene) : scene_(scene) {}
  std::uint32_t closest(std::span<const Ray> rays, Hit* hits, RayKind kind) const {
    return kind == RayKind::side_by_side ? scene_.closest(rays, hits, kind) : 0;
  }
  std::uint32_t occluded(std::span<const Ray>) const { return 0; }

 private:
  const RayScene& scene_;
};

// The environment stays and everything else turns the other way: exact for every angle.
void turn_world(Scene& scene, Camera& camera, float degrees) {
  const float radians = -degrees * std::numbers::pi_v<float> / 180;
  const float s = std::sin(radians), c = std::cos(radians);
  const Affine turn{{c, 0, -s}, {0, 1, 0}, {s, 0, c}, {}};
  for (Instance& instance : scene.instances) instance.to_world = turn * instance.to_world;
  for (Sphere& sphere : scene.spheres) sphere.centre = turn.point(sphere.centre);
  for (PunctualLight& light : scene.lights) {
    light.position = turn.point(light.position);
    light.direction = turn.vector(light.direction);
  }
  camera.to_world = turn * camera.to_world;
}

bool glows(const Scene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const Material& m) { return !is_black(m.emission); });
}

IntegratorOptions integrator_for(const TruthRequest& request, const Scene& scene) {
  IntegratorOptions options;
  options.show_environment = request.background;
  switch (request.truth) {
    case Truth::ambient_occlusion: options.integrator = Integrator::ambient_occlusion; break;
    case Truth::path: options.integrator = Integrator::path; break;
    default: options.integrator = Integrator::direct; break;
  }
  // Light samples would find emitters, which light nothing here.
  if (request.truth == Truth::unshadowed && glows(scene)) options.sampling = LightSampling::bsdf;
  return options;
}

// One group of samples of a pixel, by the integrator's own loop over batches.
bool add_samples(PictureState& state, const RenderScene& scene, const UnshadowedRays& unshadowed,
                 const TruthRequest& request, const Camera& camera, const PictureOptions& options,
                 const PictureObserver& observer) {
  if (request.truth != Truth::unshadowed) return render_picture(state, scene, camera, options, observer);
  return sample_picture(
      state, options,
      [&](int x, int y, int replicate, std::uint32_t index) {
        PixelSample sample;
        const SampleNumber number{index, options.integrator.seed + static_cast<std::uint32_t>(replicate)};
        UnshadowedRays rays = unshadowed;
        render_samples_with(rays, scene, camera, options.size, x, y, {&number, 1}, options.integrator,
                            {&sample, 1});
        return sample;
      },
      observer);
}

TracedTruth picture_of(const PictureState& state, unsigned view_number) {
  TracedTruth picture;
  picture.view_number = view_number;
  const PictureError error = picture_error(state);
  picture.samples = error.mean_samples;
  picture.relative_error = error.mean_relative_error;
  const Image radiance = picture_radiance(state);
  picture.radiance = Image(state.size.width, state.size.height, 4);
  for (std::size_t i = 0; i < state.count.size(); ++i) {
    std::copy_n(&radiance.pixels[3 * i], 3, &picture.radiance.pixels[4 * i]);
    const auto count = static_cast<float>(std::max(1u, state.count[i]));
    picture.radiance.pixels[4 * i + 3] = state.coverage_sum[i] / count;
  }
  return picture;
}

}  // namespace

std::string no_truth_reason(Truth truth) {
  return truth == Truth::dynamic ? "this technique is lit by what it captures: compare it with another "
                                   "technique, or use welkin frame"
                                 : "";
}

TruthTracer::TruthTracer(unsigned most_samples) : most_samples_(most_samples), thread_([this] { run(); }) {}

TruthTracer::~TruthTracer() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = cancel_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void TruthTracer::request(TruthRequest request) {
  {
    const std::lock_guard lock(mutex_);
    next_ = std::move(request);
    picture_.reset();
    error_.clear();
    cancel_ = true;
  }
  wake_.notify_one();
}

void TruthTracer::stop() {
  const std::lock_guard lock(mutex_);
  next_.reset();
  picture_.reset();
  cancel_ = true;
}

std::optional<TracedTruth> TruthTracer::take() {
  const std::lock_guard lock(mutex_);
  std::optional<TracedTruth> taken;
  taken.swap(picture_);
  return taken;
}

std::string TruthTracer::error() const {
  const std::lock_guard lock(mutex_);
  return error_;
}

bool TruthTracer::busy() const {
  const std::lock_guard lock(mutex_);
  return busy_ || next_.has_value();
}

bool TruthTracer::cancelled() const {
  const std::lock_guard lock(mutex_);
  return cancel_;
}

void TruthTracer::trace(const TruthRequest& request) {
  Scene scene = *request.scene;
  Camera camera = request.camera;
  turn_world(scene, camera, request.rotation_degrees);
  if (request.truth == Truth::unshadowed) scene.lights.clear();
  const EnvironmentSampler sky(request.light->radiance);
  const RenderScene ready(scene, &sky);
  const UnshadowedRays unshadowed(ready.tables().rays);
  PictureOptions options;
  options.size = request.size;
  options.integrator = integrator_for(request, scene);
  PictureState state = make_picture_state(request.size);
  // 8 samples, then half as many again each time: pictures come often at first, and reading them out costs little in all.
  for (unsigned samples = picture_replicates; samples <= most_samples_;) {
    options.samples = samples;
    if (!add_samples(state, ready, unshadowed, request, camera, options,
                     [this](const PictureProgress&) { return !cancelled(); }))
      return;
    TracedTruth picture = picture_of(state, request.view_number);
    const std::lock_guard lock(mutex_);
    if (cancel_) return;
    picture_ = std::move(picture);
    if (samples == most_samples_) return;
    samples = std::min(most_samples_, (samples + std::max(samples / 2, 8u)) / 8 * 8);
  }
}

void TruthTracer::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [&] { return stop_ || next_.has_value(); });
    if (stop_) return;
    const TruthRequest request = std::move(*next_);
    next_.reset();
    cancel_ = false;
    busy_ = true;
    lock.unlock();
    std::string error;
    try {
      trace(request);
    } catch (const std::exception& failure) {
      error = failure.what();
    }
    lock.lock();
    busy_ = false;
    if (!error.empty()) error_ = error;
  }
}

}  // namespace welkin

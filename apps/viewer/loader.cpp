#include "loader.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <new>

#include <welkin/envmap/environment.h>
#include <welkin/error.h>
#include <welkin/realtime/ibl_folder.h>
#include <welkin/realtime/renderer.h>
#include <welkin/scene/read_scene.h>

namespace welkin {
namespace {

struct Cancelled {};  // thrown through the filter by its progress

std::string file_name(const std::string& name) {
  const std::string last = std::filesystem::path(name).filename().string();
  return last.empty() ? name : last;
}

}  // namespace

LoadKind kind_of(const std::string& file) {
  return is_scene_file(file) ? LoadKind::scene : LoadKind::environment;
}

Loader::Loader(int map_size) : map_size_(map_size), thread_([this] { run(); }) {}

Loader::~Loader() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = cancel_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void Loader::request(LoadKind kind, std::string name) {
  {
    const std::lock_guard lock(mutex_);
    requests_.erase(
        std::remove_if(requests_.begin(), requests_.end(), [&](const Request& r) { return r.kind == kind; }),
        requests_.end());
    requests_.push_back({kind, std::move(name)});
    if (running_ == kind) cancel_ = true;
  }
  wake_.notify_one();
}

std::optional<Loaded> Loader::take() {
  const std::lock_guard lock(mutex_);
  if (done_.empty()) return {};
  Loaded first = std::move(done_.front());
  done_.pop_front();
  return first;
}

std::optional<Loader::Work> Loader::work() const {
  const std::lock_guard lock(mutex_);
  if (!work_ && !requests_.empty()) return Work{"reading " + file_name(requests_.front().name), 0};
  return work_;
}

void Loader::note(const std::string& text, double share) {
  const std::lock_guard lock(mutex_);
  work_ = Work{text, share};
  if (cancel_) throw Cancelled{};
}

Loaded Loader::load(const Request& request) {
  Loaded loaded;
  loaded.kind = request.kind;
  loaded.name = request.name;
  note("reading " + file_name(request.name), 0);
  try {
    if (request.kind == LoadKind::scene) {
      loaded.scene = open_scene(request.name);
      loaded.warnings = loaded.scene->warnings;
    } else if (is_ibl_folder(request.name)) {
      IblFolder set = load_ibl_folder(request.name);
      loaded.warnings = std::move(set.warnings);
      loaded.light = std::move(set.light);
    } else {
      Environment environment = load_environment(request.name);
      loaded.warnings = environment.warnings;
      IblOptions options;
      options.size = map_size_;
      options.filter.progress = [&](double share) { note("filtering " + file_name(request.name), share); };
      loaded.light = make_environment_data(std::move(environment.radiance), options);
    }
  } catch (const std::bad_alloc&) {
    loaded.error = request.name + ": not enough memory";
  } catch (const std::exception& error) {
    loaded.error = error.what();
  }
  return loaded;
}

void Loader::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [&] { return stop_ || !requests_.empty(); });
    if (stop_) return;
    const Request request = std::move(requests_.front());
    requests_.pop_front();
    running_ = request.kind;
    cancel_ = false;
    lock.unlock();
    std::optional<Loaded> loaded;
    try {
      loaded = load(request);
    } catch (const Cancelled&) {
    }
    lock.lock();
    running_.reset();
    work_.reset();
    if (loaded && !cancel_) done_.push_back(std::move(*loaded));
  }
}

}  // namespace welkin

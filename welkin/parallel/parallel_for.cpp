#include <welkin/parallel/parallel_for.h>

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cassert>
#include <memory>
#include <mutex>

namespace welkin {
namespace {

std::mutex control_mutex;
std::unique_ptr<tbb::task_arena> arena;  // created on first use, replaced by set_thread_count
int wanted_threads = 0;

tbb::task_arena& shared_arena() {
  std::lock_guard lock(control_mutex);
  if (!arena) {
    const int threads = wanted_threads > 0 ? wanted_threads : tbb::info::default_concurrency();
    arena = std::make_unique<tbb::task_arena>(threads);
  }
  return *arena;
}

}  // namespace

void set_thread_count(int threads) {
  std::lock_guard lock(control_mutex);
  wanted_threads = std::max(0, threads);
  arena.reset();
}

int thread_count() { return shared_arena().max_concurrency(); }

void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body) {
  assert(grain >= 1);
  const std::size_t chunks = (count + grain - 1) / grain;
  const auto run_chunk = [&](std::size_t chunk) {
    body(chunk * grain, std::min(count, (chunk + 1) * grain));
  };
  if (chunks <= 1 || thread_count() == 1) {
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) run_chunk(chunk);
    return;
  }
  shared_arena().execute([&] {
    tbb::parallel_for(std::size_t{0}, chunks, run_chunk, tbb::simple_partitioner{});
  });
}

}  // namespace welkin

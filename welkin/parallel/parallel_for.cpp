#include <welkin/parallel/parallel_for.h>

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cassert>
#include <memory>
#include <mutex>

namespace welkin {
namespace {

struct ThreadPool {
  explicit ThreadPool(int threads)
      : limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)),
        arena(threads) {}
  tbb::global_control limit;  // lets the arena have more threads than cores when it is asked to
  tbb::task_arena arena;
};

std::mutex pool_mutex;
std::unique_ptr<ThreadPool> pool;  // made on first use, replaced by set_thread_count
int wanted_threads = 0;

ThreadPool& shared_pool() {
  std::lock_guard lock(pool_mutex);
  if (!pool)
    pool =
        std::make_unique<ThreadPool>(wanted_threads > 0 ? wanted_threads : tbb::info::default_concurrency());
  return *pool;
}

}  // namespace

void set_thread_count(int threads) {
  std::lock_guard lock(pool_mutex);
  wanted_threads = std::max(0, threads);
  pool.reset();
}

int thread_count() { return shared_pool().arena.max_concurrency(); }

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
  shared_pool().arena.execute(
      [&] { tbb::parallel_for(std::size_t{0}, chunks, run_chunk, tbb::simple_partitioner{}); });
}

}  // namespace welkin

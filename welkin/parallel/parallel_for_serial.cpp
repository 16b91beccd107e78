#include <algorithm>
#include <cassert>

#include <welkin/parallel/parallel_for.h>

// Stands for parallel_for.cpp where there are no threads (the web build: threads want a page that is served with
// special headers). The chunks are the same, so every sum comes out the same.

namespace welkin {

void set_thread_count(int) {}

int thread_count() { return 1; }

void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body) {
  assert(grain >= 1);
  for (std::size_t begin = 0; begin < count; begin += std::min(grain, count - begin))
    body(begin, begin + std::min(grain, count - begin));
}

}  // namespace welkin

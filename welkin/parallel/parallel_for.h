#pragma once
#include <cstddef>
#include <functional>
#include <vector>

// Loops over all cores whose result does not depend on how many cores there are: work is cut into chunks of a
// fixed grain, each chunk is computed by one thread in order, and reductions combine chunks in index order.

namespace welkin {

/// How many threads parallel loops may use from now on, in this process; 0 asks for one per core.
void set_thread_count(int threads);

/// The number of threads that parallel loops use, at least 1.
int thread_count();

/// Calls body(begin, end) for consecutive chunks of `grain` (>= 1) indices that cover [0, count), the last one
/// perhaps shorter. Chunks run concurrently in any order, so bodies may write only what belongs to their indices.
/// An exception thrown by a body is rethrown here, after the loop has stopped.
void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t begin, std::size_t end)>& body);

/// parallel_for that lets each chunk fill its own Partial; returns them in chunk order, to be combined in a fixed
/// order by the caller (floating-point sums come out the same on any number of threads).
template <class Partial, class Body>
std::vector<Partial> parallel_partials(std::size_t count, std::size_t grain, Body&& body) {
  std::vector<Partial> partials((count + grain - 1) / grain);
  parallel_for(count, grain,
               [&](std::size_t begin, std::size_t end) { body(partials[begin / grain], begin, end); });
  return partials;
}

}  // namespace welkin

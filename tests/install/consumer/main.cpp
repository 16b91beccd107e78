#include <atomic>
#include <cstdio>

#include <welkin/error.h>
#include <welkin/image/image.h>
#include <welkin/image/output_file.h>
#include <welkin/parallel/parallel_for.h>

// Prints "45 4": the sum of 0..9 from a parallel loop, and the size of a file written and read back.
int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    std::atomic<int> sum{0};
    welkin::parallel_for(10, 3, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) sum += static_cast<int>(i);
    });
    const welkin::Image image(2, 2, 1);
    welkin::write_file(argv[1], std::vector<std::uint8_t>(image.pixels.size(), 7));
    std::printf("%d %zu\n", sum.load(), welkin::read_file(argv[1]).size());
  } catch (const welkin::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

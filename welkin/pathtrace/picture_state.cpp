#include <string>

#include <welkin/error.h>
#include <welkin/pathtrace/picture.h>

namespace welkin {

PictureState make_picture_state(PictureSize size) {
  constexpr int longest = 16384;
  constexpr std::size_t most_pixels = std::size_t{1} << 26;
  if (size.width < 1 || size.height < 1 || size.width > longest || size.height > longest)
    throw Error("a picture has 1 to 16384 pixels along each side, not " + std::to_string(size.width) + " x " +
                std::to_string(size.height));
  const auto pixels = static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
  if (pixels > most_pixels) throw Error("a picture has at most 67108864 pixels");
  PictureState state;
  state.size = size;
  state.count.resize(pixels);
  state.goal.resize(pixels);
  state.radiance_sum.resize(3 * pixels);
  state.replicate_sum.resize(3 * picture_replicates * pixels);
  state.albedo_sum.resize(3 * pixels);
  state.normal_sum.resize(3 * pixels);
  state.depth_sum.resize(pixels);
  state.coverage_sum.resize(pixels);
  return state;
}

}  // namespace welkin

#include <welkin/pathtrace/picture.h>

#include <array>

#include <welkin/pathtrace/picture_loop.h>
#include <welkin/sampling/sobol.h>

namespace welkin {

bool render_picture(PictureState& state, const RenderScene& scene, const Camera& camera,
                    const PictureOptions& options, const PictureObserver& observer) {
  std::array<IntegratorOptions, picture_replicates> of_replicate;
  for (int r = 0; r < picture_replicates; ++r) {
    of_replicate[r] = options.integrator;
    of_replicate[r].seed =
        mix_bits32(options.integrator.seed + 0x9e3779b9u * static_cast<std::uint32_t>(r + 1));
  }
  const auto sample = [&](int x, int y, int replicate, std::uint32_t index) {
    return render_sample(scene, camera, options.size, x, y, index,
                         of_replicate[static_cast<std::size_t>(replicate)]);
  };
  return sample_picture(state, options, sample, observer);
}

}  // namespace welkin

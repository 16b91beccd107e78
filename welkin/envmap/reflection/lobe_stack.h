#pragma once
#include <array>
#include <string>
#include <vector>

#include <welkin/brdf/lobe_fit.h>
#include <welkin/envmap/reflection/stack_files.h>
#include <welkin/envmap/reflection/truth.h>
#include <welkin/image/image.h>

// An environment filtered with the lobes that fit a BRDF (Kautz & McCool 2000): a stack of cubes over the elevation of
// the view, each looked up along its lobe's axis. docs/reflection.md has the errors against the full integral.

namespace welkin {

struct LobeStackOptions {
  int lobes = 1;  ///< 1 to 4 a view; the single lobe has 1
  LobeFamily family = LobeFamily::free;
  LobeTarget target = LobeTarget::brdf_times_cosine;
  int views = 16;          ///< elevations, 2 to 128, from normal view to 88 degrees, closest near grazing
  int largest_size = 128;  ///< of a cube, 4 to 1024; each is as small as its lobe's width lets it be
};

/// One lobe of one view.
struct StackLobe {
  double axis = 0;                 ///< rad from the normal, > 0 away from the view
  std::array<double, 3> energy{};  ///< the cube is multiplied by it
  int cube = 0;                    ///< index into cubes
};

struct LobeStack {
  std::string method, brdf;  ///< "lobes" or "single-lobe"; the BRDF's name
  LobeTarget target = LobeTarget::brdf_times_cosine;
  int lobes = 1;                    ///< a view
  std::vector<double> view_angles;  ///< rad, ascending
  std::vector<StackLobe> slots;     ///< [view * lobes + lobe]
  std::vector<Cube> cubes;          ///< filtered with kernels of integral 1
  std::vector<double> fit_errors;   ///< of each view: relative L2 error of the lobes against the BRDF
};

/// A fit and a filter for each view. Throws Error for options out of range. radiance: equirectangular, 3 channels,
/// finite and >= 0.
LobeStack prepare_lobe_stack(const Image& radiance, const IsotropicBrdf& brdf,
                             const LobeStackOptions& options = {});

/// One lobe shape for all views, turned and scaled: one cube.
LobeStack prepare_single_lobe(const Image& radiance, const IsotropicBrdf& brdf,
                              const LobeStackOptions& options = {});

/// Reflected radiance; 0 where the view lies below the surface. Axes and energies are linear between the views next to
/// the query's angle (the last view's hold beyond it), and so are the two cubes, both looked up along the same axis.
/// With LobeTarget::brdf the sum is multiplied by max(0, n.axis), lobe by lobe.
std::array<double, 3> reflect(const LobeStack& stack, const ReflectionQuery& query);

/// Each cube, and a description with the views' axes and energies.
StackFiles stack_files(const LobeStack& stack);

}  // namespace welkin

#pragma once
#include <welkin/realtime/occlusion/depth_layer.h>
#include <welkin/realtime/occlusion/screen_occlusion.h>

namespace welkin {

/// The scalar form of OcclusionMethod::gtao or horizon_sectors on the processor, before the denoiser: the formulas of
/// occlusion_gtao.frag and occlusion_sectors.frag with the same taps, so that either tests the other. One channel, row 0 the top; 1 where nothing
/// is seen. Any other method: assertion.
Image slice_occlusion(const DepthLayer& layer, const OcclusionOptions& options);

/// The cross-bilateral filter of occlusion_denoise.frag over such an image.
Image denoise_occlusion(const DepthLayer& layer, const Image& openness, float radius_metres);

}  // namespace welkin

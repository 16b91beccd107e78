#pragma once
#include <array>
#include <cstdint>

#include <welkin/envmap/ibl.h>
#include <welkin/realtime/gl/program.h>
#include <welkin/realtime/gl/texture.h>

namespace welkin {

/// An environment's maps in OpenGL: what environment.glsl reads.
struct GpuEnvironment {
  GlTexture environment;  ///< radiance, box mips to 1 x 1
  GlTexture specular;     ///< GGX-filtered
  GlTexture irradiance;   ///< E
  GlTexture dfg;          ///< (scale, bias)
  int environment_size = 0, environment_levels = 0, specular_size = 0, specular_levels = 0,
      irradiance_size = 0;
  LevelLaw law = LevelLaw::linear;   ///< of specular
  std::array<Vec3f, 9> radiance_sh;  ///< index l(l+1)+m
  std::uint64_t upload =
      0;  ///< a number that no other upload of this process has: for what techniques make of the maps
  float rotation_radians = 0;  ///< about +Y, right-handed, of the environment in the world
};

/// From a set made with this law, KernelKind::ggx and DfgForm::scale_bias. rgba16f clamps above 65504; rgba32f needs the driver's
/// OES_texture_float_linear.
GpuEnvironment upload_environment(const IblSet& set, TexelFormat format = TexelFormat::rgba16f,
                                  LevelLaw law = LevelLaw::linear);

/// Binds the maps to units 5 to 8 and sets all uniforms of environment.glsl.
void set_environment(const Program& program, const GpuEnvironment& environment);

/// The matrix of `in_map`: from the world into the environment's own frame.
Affine world_to_environment(float rotation_radians);

}  // namespace welkin

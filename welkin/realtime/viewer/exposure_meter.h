#pragma once
#include <welkin/realtime/gl/program.h>
#include <welkin/realtime/gl/texture.h>

namespace welkin {

/// log2(0.18 / log-average luminance) of a picture on the GPU, as automatic_exposure_ev (tonemap.h): of every pixel up to 512 x 512, of
/// an even selection above.
class ExposureMeter {
 public:
  ExposureMeter();
  float measure(const RenderTarget& picture);

 private:
  Program program_;
  Fullscreen fullscreen_;
  RenderTarget cells_;
};

}  // namespace welkin

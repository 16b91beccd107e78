#pragma once
#include <map>
#include <string>
#include <string_view>

#include <welkin/scene/file_resolver.h>
#include <welkin/scene/scene.h>

namespace welkin {

/// The materials of an MTL file as glTF's model, added to the scene together with their textures. Materials that share
/// a name: the last one counts. Throws Error(name, "line N: ...") for what cannot be read, missing textures included.
///   base color = Kd, alpha = d or 1 - Tr, emission = Ke, metallic = Pm or 0
///   perceptual_roughness = Pr, or by the width of the same Blinn-Phong lobe (Walter et al. 2007): alpha^2 = 2 / (Ns + 2)
///   ior = Ni, 1.5 without one; 1 (no highlight) where illum is 0 or 1, or Ks is black
class MtlReader {
 public:
  MtlReader(Scene& scene, const FileResolver& resolve) : scene_(scene), resolve_(resolve) {}

  void read(std::string_view text, std::string_view name);
  /// The index of a material, -1 for a name that no file has.
  int find(std::string_view material) const;

 private:
  struct Draft;
  struct Line;
  void set(Draft& draft, Line& line);
  TextureUse texture(Line& line, bool srgb, float* bump_scale = nullptr);
  int load(const std::string& reference, bool srgb, TextureWrap wrap, const Line& line);
  void finish(const Draft& draft);
  void warn_once(const std::string& text);

  Scene& scene_;
  const FileResolver& resolve_;
  std::map<std::string, int, std::less<>> materials_;
  std::map<std::string, int> textures_;
  std::int64_t pixels_ = 0;
};

}  // namespace welkin

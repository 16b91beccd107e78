#include <fmt/format.h>

#include <algorithm>

#include <welkin/error.h>
#include <welkin/image/codecs/ldr.h>
#include <welkin/image/codecs/size_limit.h>
#include <welkin/scene/gltf_build.h>

namespace welkin {
namespace {

class TextureTable {
 public:
  TextureTable(const GltfDocument& document, GltfStorage& storage, const GltfPictures& pictures, Scene& scene)
      : document_(document), storage_(storage), pictures_(pictures), scene_(scene) {}

  // Turns a glTF texture index into one of the scene.
  void take(TextureUse& use, LdrEncoding encoding) {
    if (use.texture < 0) return;
    const GltfTexture& texture = document_.textures[use.texture];
    if (texture.image < 0) {
      warn_once("textures without an image that is PNG or JPEG are left out");
      use.texture = -1;
      return;
    }
    const auto [entry, is_new] = made_.try_emplace({texture.image, texture.sampler, encoding}, 0);
    if (is_new) entry->second = make(texture, encoding);
    use.texture = entry->second;
  }

 private:
  int make(const GltfTexture& from, LdrEncoding encoding) {
    const GltfImage& image = document_.images[from.image];
    const bool is_file = image.uri && image.uri->substr(0, 5) != "data:";
    Texture texture;
    texture.name = !image.name.empty() ? image.name
                   : is_file           ? *image.uri
                                       : fmt::format("image {}", from.image);
    texture.image = pixels(image, from.image, encoding);
    pixels_ += std::int64_t{texture.image.width} * texture.image.height;
    if (pixels_ > max_pixel_count) throw Error(document_.name, "its textures have too many pixels together");
    if (from.sampler >= 0) {
      const GltfSampler& sampler = document_.samplers[from.sampler];
      texture.wrap_u = sampler.wrap_u, texture.wrap_v = sampler.wrap_v, texture.nearest = sampler.nearest;
    }
    scene_.textures.push_back(std::move(texture));
    return static_cast<int>(scene_.textures.size()) - 1;
  }

  Image pixels(const GltfImage& image, int index, LdrEncoding encoding) {
    const auto decoded = pictures_.find(index);
    if (decoded != pictures_.end()) return linear_texture(decoded->second, encoding);
    std::vector<std::uint8_t> own;
    if (image.uri) own = storage_.uri_bytes(*image.uri);
    const std::span<const std::uint8_t> bytes =
        image.uri ? std::span<const std::uint8_t>(own) : storage_.view_bytes(image.view);
    return decode_ldr_texture(bytes, fmt::format("{}: image {}", document_.name, index), encoding);
  }

  void warn_once(const char* text) {
    if (std::find(scene_.warnings.begin(), scene_.warnings.end(), text) == scene_.warnings.end())
      scene_.warnings.emplace_back(text);
  }

  const GltfDocument& document_;
  GltfStorage& storage_;
  const GltfPictures& pictures_;
  Scene& scene_;
  std::map<std::tuple<int, int, LdrEncoding>, int> made_;
  std::int64_t pixels_ = 0;
};

}  // namespace

void build_gltf_materials(const GltfDocument& document, GltfStorage& storage, const GltfPictures& pictures,
                          Scene& scene) {
  TextureTable textures(document, storage, pictures, scene);
  for (Material material : document.materials) {
    textures.take(material.base_color_texture, LdrEncoding::srgb);
    textures.take(material.emission_texture, LdrEncoding::srgb);
    textures.take(material.normal_texture, LdrEncoding::linear);
    textures.take(material.metallic_texture, LdrEncoding::linear);
    textures.take(material.roughness_texture, LdrEncoding::linear);
    scene.materials.push_back(std::move(material));
  }
}

}  // namespace welkin

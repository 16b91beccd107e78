#include <algorithm>
#include <array>

#include <welkin/scene/gltf_fields.h>

namespace welkin {
namespace {

TextureWrap wrap_of(const GltfObject& sampler, const char* key) {
  switch (sampler.count(key, 10497)) {
    case 33071: return TextureWrap::clamp;
    case 33648: return TextureWrap::mirror;
    case 10497: return TextureWrap::repeat;
    default: sampler.fail("its wrap mode is none of glTF's");
  }
}

// `owner` has a texture under `key`: where it is placed, and nothing (-1) where the file has no such use.
TextureUse parse_use(const GltfObject& owner, const char* key, const GltfDocument& document,
                     int channel = 0) {
  TextureUse use;
  const GltfObject info = owner.part(key);
  if (!info) return use;
  use.texture = info.required_index("index", document.textures.size());
  use.channel = channel;
  std::uint64_t texcoord = info.count("texCoord", 0);
  if (const GltfObject transform = info.extension("KHR_texture_transform")) {
    std::array<float, 2> offset{0, 0}, scale{1, 1};
    transform.numbers("offset", offset);
    transform.numbers("scale", scale);
    use.offset = {offset[0], offset[1]}, use.scale = {scale[0], scale[1]};
    use.rotation_radians = transform.number("rotation", 0);
    texcoord = transform.count("texCoord", texcoord);
  }
  if (texcoord > 1) owner.fail("uses TEXCOORD_2 or above; 0 and 1 are read");
  use.texcoord = static_cast<int>(texcoord);
  return use;
}

AlphaMode alpha_mode_of(const GltfObject& object) {
  const std::string mode = object.text("alphaMode");
  if (mode == "MASK") return AlphaMode::mask;
  if (mode == "BLEND") return AlphaMode::blend;
  if (!mode.empty() && mode != "OPAQUE") object.fail("its alphaMode is none of OPAQUE, MASK, BLEND");
  return AlphaMode::opaque;
}

void parse_surface(const GltfObject& object, const GltfDocument& document, Material& m) {
  const GltfObject pbr = object.part("pbrMetallicRoughness");
  std::array<float, 4> base{1, 1, 1, 1};
  pbr.numbers("baseColorFactor", base);
  m.base_color = {base[0], base[1], base[2]};
  m.base_alpha = base[3];
  m.metallic = pbr.number("metallicFactor", 1);
  m.perceptual_roughness = pbr.number("roughnessFactor", 1);
  m.base_color_texture = parse_use(pbr, "baseColorTexture", document);
  m.metallic_texture = parse_use(pbr, "metallicRoughnessTexture", document, 2);
  m.roughness_texture = parse_use(pbr, "metallicRoughnessTexture", document, 1);
  m.normal_texture = parse_use(object, "normalTexture", document);
  m.normal_scale = object.part("normalTexture").number("scale", 1);
}

void parse_emission(const GltfObject& object, const GltfDocument& document, Material& m) {
  std::array<float, 3> emission{0, 0, 0};
  object.numbers("emissiveFactor", emission);
  const float strength = object.extension("KHR_materials_emissive_strength").number("emissiveStrength", 1);
  m.emission = strength * Rgb{emission[0], emission[1], emission[2]};
  m.emission_texture = parse_use(object, "emissiveTexture", document);
}

Material parse_material(const GltfObject& object, const GltfDocument& document) {
  Material m;
  m.name = object.text("name");
  parse_surface(object, document, m);
  parse_emission(object, document, m);
  m.ior = object.extension("KHR_materials_ior").number("ior", 1.5f);
  if (m.ior == 0) m.ior = 100;  // the extension's way to say that Fresnel's term is 1
  m.double_sided = object.boolean("doubleSided", false);
  m.alpha_mode = alpha_mode_of(object);
  m.alpha_cutoff = object.number("alphaCutoff", 0.5f);
  return m;
}

}  // namespace

void parse_gltf_materials(const GltfObject& root, GltfDocument& document) {
  for_each_object(root, "images", "image", [&](const GltfObject& object) {
    GltfImage image{object.text("name"), std::nullopt, object.index_of("bufferView", document.views.size())};
    if (object.json.find("uri")) image.uri = object.text("uri");
    if (!image.uri && image.view < 0) object.fail("has neither a uri nor a bufferView");
    document.images.push_back(std::move(image));
  });
  for_each_object(root, "samplers", "sampler", [&](const GltfObject& object) {
    document.samplers.push_back(
        {wrap_of(object, "wrapS"), wrap_of(object, "wrapT"), object.count("magFilter", 9729) == 9728});
  });
  for_each_object(root, "textures", "texture", [&](const GltfObject& object) {
    document.textures.push_back({object.index_of("source", document.images.size()),
                                 object.index_of("sampler", document.samplers.size())});
  });
  for_each_object(root, "materials", "material", [&](const GltfObject& object) {
    document.materials.push_back(parse_material(object, document));
  });
}

}  // namespace welkin

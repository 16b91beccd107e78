#include <welkin/scene/mtl.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <welkin/error.h>
#include <welkin/image/codecs/ldr.h>
#include <welkin/image/codecs/size_limit.h>
#include <welkin/scene/text_lines.h>

namespace welkin {

struct MtlReader::Line {
  std::string_view file, key, rest;
  std::size_t number;

  [[noreturn]] void fail(std::string_view what) const {
    throw Error(file, fmt::format("line {}: {}", number, what));
  }
  float take_number(float low, float high) {
    const std::string_view word = take_word(rest);
    const std::optional<float> value = to_number(word);
    if (!value) fail(fmt::format("\"{}\" is not a number", printable(word)));
    return std::clamp(*value, low, high);
  }
  // One number stands for three.
  Rgb take_color() {
    Rgb color;
    color.r = color.g = color.b = take_number(0, 1e6f);
    if (trimmed(rest).empty()) return color;
    color.g = take_number(0, 1e6f);
    color.b = take_number(0, 1e6f);
    return color;
  }
};

struct MtlReader::Draft {
  Material material;
  std::optional<float> roughness, exponent, ior;
  bool has_highlight = true, has_emission_color = false;
};

namespace {

// How many words follow each option of a texture.
int option_size(std::string_view option) {
  for (std::string_view one :
       {"-blendu", "-blendv", "-boost", "-cc", "-clamp", "-texres", "-bm", "-imfchan", "-type"}) {
    if (option == one) return 1;
  }
  if (option == "-mm") return 2;
  return option == "-s" || option == "-o" || option == "-t" ? 3 : -1;
}

// -s and -o may have one, two or three numbers.
Vec2f take_pair(std::string_view& rest, Vec2f otherwise) {
  float* parts[] = {&otherwise.x, &otherwise.y, nullptr};
  for (float* part : parts) {
    std::string_view ahead = rest;
    const std::optional<float> value = to_number(take_word(ahead));
    if (!value) break;
    rest = ahead;
    if (part != nullptr) *part = *value;
  }
  return otherwise;
}

bool is_gray(const Image& image) {
  for (std::size_t i = 0; i + 2 < image.pixels.size(); i += static_cast<std::size_t>(image.channels)) {
    if (image.pixels[i] != image.pixels[i + 1] || image.pixels[i] != image.pixels[i + 2]) return false;
  }
  return true;
}

}  // namespace

int MtlReader::find(std::string_view material) const {
  const auto found = materials_.find(material);
  return found == materials_.end() ? -1 : found->second;
}

void MtlReader::warn_once(const std::string& text) {
  if (std::find(scene_.warnings.begin(), scene_.warnings.end(), text) == scene_.warnings.end())
    scene_.warnings.push_back(text);
}

int MtlReader::load(const std::string& reference, bool srgb, TextureWrap wrap, const Line& line) {
  const std::string key = fmt::format("{}{}{}", srgb ? 's' : 'l', static_cast<int>(wrap), reference);
  const auto [entry, is_new] = textures_.try_emplace(key, 0);
  if (!is_new) return entry->second;
  Texture texture;
  texture.name = reference;
  texture.wrap_u = texture.wrap_v = wrap;
  std::vector<std::uint8_t> bytes;
  try {
    bytes = resolve_(reference);
  } catch (const Error& error) {
    line.fail(fmt::format("refers to a texture that cannot be read: {}", error.what()));
  }
  texture.image = decode_ldr_texture(bytes, fmt::format("{}: {}", line.file, printable(reference)),
                                     srgb ? LdrEncoding::srgb : LdrEncoding::linear);
  pixels_ += std::int64_t{texture.image.width} * texture.image.height;
  if (pixels_ > max_pixel_count) line.fail("the textures have too many pixels together");
  scene_.textures.push_back(std::move(texture));
  return entry->second = static_cast<int>(scene_.textures.size()) - 1;
}

// MTL's v points up: v' = s v + o there is 1 - v' = s (1 - v) + 1 - s - o for what points down.
TextureUse MtlReader::texture(Line& line, bool srgb, float* bump_scale) {
  Vec2f scale{1, 1}, offset{0, 0};
  TextureWrap wrap = TextureWrap::repeat;
  for (std::string_view ahead = line.rest;; ahead = line.rest) {
    const std::string_view option = take_word(ahead);
    const int size = option_size(option);
    if (size < 0) break;
    line.rest = ahead;
    if (option == "-s") {
      scale = take_pair(line.rest, {1, 1});
    } else if (option == "-o" || option == "-t") {
      const Vec2f pair = take_pair(line.rest, {0, 0});
      if (option == "-o") offset = pair;
    } else if (option == "-bm") {
      const float value = line.take_number(-1e3f, 1e3f);
      if (bump_scale != nullptr) *bump_scale = value;
    } else {
      for (int i = 0; i < size; ++i) {
        if (take_word(line.rest) == "on" && option == "-clamp") wrap = TextureWrap::clamp;
      }
    }
  }
  const std::string_view reference = trimmed(line.rest);
  if (reference.empty()) line.fail("a texture without a file");
  TextureUse use;
  use.texture = load(std::string(reference), srgb, wrap, line);
  use.scale = scale, use.offset = {offset.x, 1 - scale.y - offset.y};
  return use;
}

void MtlReader::set(Draft& draft, Line& line) {
  Material& m = draft.material;
  const std::string_view key = line.key;
  if (key == "Kd") m.base_color = line.take_color();
  if (key == "Ks") draft.has_highlight = !is_black(line.take_color());
  if (key == "Ke") m.emission = line.take_color(), draft.has_emission_color = !is_black(m.emission);
  if (key == "Ns") draft.exponent = line.take_number(0, 1e6f);
  if (key == "Ni") draft.ior = line.take_number(1, 100);
  if (key == "d") m.base_alpha = line.take_number(0, 1);
  if (key == "Tr") m.base_alpha = 1 - line.take_number(0, 1);
  if (key == "Pr") draft.roughness = line.take_number(0, 1);
  if (key == "Pm") m.metallic = line.take_number(0, 1);
  if (key == "illum" && line.take_number(0, 100) < 2) draft.has_highlight = false;
  if (key == "map_Kd") m.base_color_texture = texture(line, true);
  if (key == "map_Ke") m.emission_texture = texture(line, true);
  if (key == "map_Pr") m.roughness_texture = texture(line, false);
  if (key == "map_Pm") m.metallic_texture = texture(line, false);
  if (key == "norm" || key == "map_Bump" || key == "map_bump" || key == "bump") {
    m.normal_texture = texture(line, false, &m.normal_scale);
    if (!is_gray(scene_.textures[m.normal_texture.texture].image)) return;
    m.normal_texture = {};
    warn_once("bump maps are not used, only normal maps");
  }
  if (key == "map_d" || key == "map_Ks" || key == "map_Ns" || key == "disp")
    warn_once(fmt::format("{} is not used", key));
}

void MtlReader::finish(const Draft& draft) {
  Material m = draft.material;
  if (m.name.empty()) return;
  m.ior = draft.has_highlight ? draft.ior.value_or(1.5f) : 1;
  const float alpha = draft.exponent ? std::sqrt(2 / (*draft.exponent + 2)) : 1;
  m.perceptual_roughness = draft.roughness.value_or(std::sqrt(alpha));
  if (m.emission_texture.texture >= 0 && !draft.has_emission_color) m.emission = {1, 1, 1};
  if (m.base_alpha < 1 || (m.base_color_texture.texture >= 0 &&
                           scene_.textures[m.base_color_texture.texture].image.channels == 4))
    m.alpha_mode = AlphaMode::blend;
  materials_[m.name] = static_cast<int>(scene_.materials.size());
  scene_.materials.push_back(std::move(m));
}

void MtlReader::read(std::string_view text, std::string_view name) {
  const auto fresh = [](std::string_view material) {
    Draft draft;
    draft.material.name = material;
    draft.material.metallic = 0;
    return draft;
  };
  Draft draft = fresh("");
  TextLines lines(text, true);
  while (lines.next()) {
    Line line{name, {}, lines.line(), lines.number()};
    line.key = take_word(line.rest);
    if (line.key == "newmtl") {
      finish(draft);
      draft = fresh(trimmed(line.rest));
    } else {
      set(draft, line);
    }
  }
  finish(draft);
}

}  // namespace welkin

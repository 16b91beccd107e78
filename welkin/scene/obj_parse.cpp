#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include <welkin/error.h>
#include <welkin/scene/obj_faces.h>
#include <welkin/scene/text_lines.h>

namespace welkin {
namespace {

class Parser {
 public:
  Parser(std::string_view name, const FileResolver& resolve, Scene& scene)
      : name_(name), resolve_(resolve), scene_(scene), materials_(scene, resolve) {
    file_.objects.emplace_back();
  }

  ObjFile run(std::string_view text) {
    TextLines lines(text, true);
    while (lines.next()) {
      line_ = lines.number();
      rest_ = lines.line();
      rest_ = rest_.substr(0, rest_.find('#'));
      statement(take_word(rest_));
    }
    check_forward();
    return std::move(file_);
  }

 private:
  [[noreturn]] void fail(std::string_view what) const {
    throw Error(name_, fmt::format("line {}: {}", line_, what));
  }

  void statement(std::string_view key) {
    if (key == "v") return file_.positions.push_back(take_vector());
    if (key == "vn") return file_.normals.push_back(take_vector());
    if (key == "vt") return take_texcoord();
    if (key == "f" || key == "fo") return take_face();
    if (key == "o") {
      file_.objects.emplace_back(trimmed(rest_));
      return;
    }
    if (key == "s") return take_smoothing();
    if (key == "usemtl") return use_material(trimmed(rest_));
    if (key == "mtllib") return read_library(std::string(trimmed(rest_)));
    if (key == "l" || key == "p") warn_once("points and lines are left out");
    if (key == "curv" || key == "curv2" || key == "surf")
      warn_once("curves and free-form surfaces are left out");
  }

  float take_number() {
    const std::string_view word = take_word(rest_);
    const std::optional<float> value = to_number(word);
    if (!value)
      fail(word.empty() ? "a number is missing"
                        : fmt::format("\"{}\" is not a finite number", printable(word)));
    return *value;
  }

  Vec3f take_vector() {
    const float x = take_number(), y = take_number();
    return {x, y, take_number()};
  }

  void take_texcoord() {
    const float u = take_number();
    const float v = trimmed(rest_).empty() ? 0 : take_number();
    file_.texcoords.push_back({u, 1 - v});
  }

  void take_smoothing() {
    const std::string_view word = take_word(rest_);
    int group = 0;
    if (word != "off") std::from_chars(word.data(), word.data() + word.size(), group);
    smoothing_group_ = std::max(0, group);
  }

  // 1, 2, ... from the first; -1, -2, ... from the last one so far. Positive ones may lie ahead: check_forward.
  std::int32_t take_index(std::string_view text, std::size_t count, const char* what) {
    std::int64_t index = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), index);
    if (fault != std::errc() || end != text.data() + text.size())
      fail(fmt::format("\"{}\" is not an index", printable(text)));
    const std::int64_t from_zero = index > 0 ? index - 1 : static_cast<std::int64_t>(count) + index;
    if (index == 0 || from_zero < 0 || from_zero > 0x7ffffffe)
      fail(fmt::format("a face uses {} {} of {}", what, index, count));
    return static_cast<std::int32_t>(from_zero);
  }

  ObjCorner take_corner(std::string_view word) {
    std::string_view parts[3];
    for (std::string_view& part : parts) {
      const std::size_t end = word.find('/');
      part = word.substr(0, end);
      word.remove_prefix(end == std::string_view::npos ? word.size() : end + 1);
    }
    ObjCorner corner;
    corner.position = take_index(parts[0], file_.positions.size(), "vertex");
    if (!parts[1].empty())
      corner.texcoord = take_index(parts[1], file_.texcoords.size(), "texture coordinate");
    if (!parts[2].empty()) corner.normal = take_index(parts[2], file_.normals.size(), "normal");
    return corner;
  }

  void take_face() {
    const std::size_t first = file_.corners.size();
    for (std::string_view word = take_word(rest_); !word.empty(); word = take_word(rest_))
      file_.corners.push_back(take_corner(word));
    if (file_.corners.size() > 0xffffffffu) fail("has more than 2^32 corners of faces");
    if (file_.corners.size() < first + 3) fail("a face has fewer than 3 vertices");
    file_.faces.push_back({static_cast<std::uint32_t>(first),
                           static_cast<std::int32_t>(file_.objects.size()) - 1, material_, smoothing_group_});
  }

  void use_material(std::string_view material) {
    material_ = materials_.find(material);
    if (material_ < 0) warn_once(fmt::format("there is no material \"{}\"", printable(material)));
  }

  void read_library(const std::string& reference) {
    std::vector<std::uint8_t> bytes;
    try {
      bytes = resolve_(reference);
    } catch (const Error&) {
      return warn_once(fmt::format("the material file \"{}\" cannot be read", printable(reference)));
    }
    materials_.read({reinterpret_cast<const char*>(bytes.data()), bytes.size()},
                    fmt::format("{}: {}", name_, printable(reference)));
  }

  void check_forward() {
    const auto check = [this](std::int32_t index, std::size_t count, const char* what) {
      if (index >= 0 && static_cast<std::size_t>(index) >= count)
        throw Error(name_, fmt::format("a face uses {} {} of {}", what, std::int64_t{index} + 1, count));
    };
    for (const ObjCorner& corner : file_.corners) {
      check(corner.position, file_.positions.size(), "vertex");
      check(corner.texcoord, file_.texcoords.size(), "texture coordinate");
      check(corner.normal, file_.normals.size(), "normal");
    }
  }

  void warn_once(const std::string& text) {
    const std::vector<std::string>& known = scene_.warnings;
    if (known.size() < 100 && std::find(known.begin(), known.end(), text) == known.end())
      scene_.warnings.push_back(text);
  }

  std::string_view name_;
  const FileResolver& resolve_;
  Scene& scene_;
  MtlReader materials_;
  ObjFile file_;
  std::string_view rest_;
  std::size_t line_ = 0;
  std::int32_t material_ = -1, smoothing_group_ = 0;
};

}  // namespace

ObjFile parse_obj(std::string_view text, std::string_view name, const FileResolver& resolve, Scene& scene) {
  return Parser(name, resolve, scene).run(text);
}

}  // namespace welkin

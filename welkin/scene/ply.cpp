#include <welkin/scene/ply.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include <welkin/error.h>
#include <welkin/scene/mesh_repair.h>
#include <welkin/scene/ply_header.h>
#include <welkin/scene/polygon.h>
#include <welkin/scene/text_lines.h>

namespace welkin {
namespace {

// The values of the data section, one after the other.
class Values {
 public:
  Values(std::span<const std::uint8_t> bytes, PlyForm form, std::string_view name)
      : bytes_(bytes), form_(form), name_(name) {}

  // As double: holds every type.
  double take(PlyType type) { return form_ == PlyForm::ascii ? take_text() : take_binary(type); }

  void check_left(const PlyElement& element) const {
    std::uint64_t least = 0;  // bytes of one element, at least
    for (const PlyProperty& p : element.properties)
      least += form_ == PlyForm::ascii ? 1 : ply_size(p.is_list ? p.count_type : p.type);
    if (least > 0 && element.count > bytes_.size() / least)
      throw Error(name_, fmt::format("is cut off: {} elements \"{}\" do not fit into what is left of it",
                                     element.count, printable(element.name)));
  }

 private:
  double take_text() {
    std::string_view text(reinterpret_cast<const char*>(bytes_.data()), bytes_.size());
    const std::size_t begin = text.find_first_not_of(" \t\r\n");
    if (begin == std::string_view::npos) throw Error(name_, "is cut off: values are missing");
    text.remove_prefix(begin);
    const std::string_view word = text.substr(0, text.find_first_of(" \t\r\n"));
    bytes_ = bytes_.subspan(begin + word.size());
    double value = 0;
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size() || fault == std::errc::invalid_argument)
      throw Error(name_, fmt::format("\"{}\" is not a number", printable(word)));
    return value;
  }

  template <class Number>
  double take_number() {
    std::uint8_t raw[sizeof(Number)];
    if (bytes_.size() < sizeof raw) throw Error(name_, "is cut off: values are missing");
    std::memcpy(raw, bytes_.data(), sizeof raw);
    if (form_ == PlyForm::big_endian) std::reverse(raw, raw + sizeof raw);
    bytes_ = bytes_.subspan(sizeof raw);
    Number value;
    std::memcpy(&value, raw, sizeof value);
    return static_cast<double>(value);
  }

  double take_binary(PlyType type) {
    switch (type) {
      case PlyType::int8: return take_number<std::int8_t>();
      case PlyType::uint8: return take_number<std::uint8_t>();
      case PlyType::int16: return take_number<std::int16_t>();
      case PlyType::uint16: return take_number<std::uint16_t>();
      case PlyType::int32: return take_number<std::int32_t>();
      case PlyType::uint32: return take_number<std::uint32_t>();
      case PlyType::float32: return take_number<float>();
      case PlyType::float64: break;
    }
    return take_number<double>();
  }

  std::span<const std::uint8_t> bytes_;
  PlyForm form_;
  std::string_view name_;
};

class Reader {
 public:
  Reader(std::span<const std::uint8_t> bytes, const PlyHeader& header, std::string_view name)
      : header_(header), name_(name), values_(bytes, header.form, name) {}

  Mesh run() {
    bool has_vertices = false;
    for (const PlyElement& element : header_.elements) {
      values_.check_left(element);
      if (element.name == "vertex") {
        if (has_vertices) throw Error(name_, "has two lists of vertices");
        has_vertices = true;
        read_vertices(element);
      } else {
        read_faces(element);
      }
    }
    if (mesh_.positions.empty()) throw Error(name_, "has no vertices");
    make_triangles();
    return std::move(mesh_);
  }

  bool has_colors() const { return has_colors_; }

 private:
  // Reads one element; scalars end up in row_ by property, the list of property `wanted` in list_.
  void take_element(const PlyElement& element, int wanted) {
    row_.resize(element.properties.size());
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (!property.is_list) {
        row_[i] = values_.take(property.type);
        continue;
      }
      const double count = values_.take(property.count_type);
      if (!(count >= 0) || count != std::floor(count) || count > 4294967295.0)
        throw Error(name_, "a list's length is not a whole number of 0 or more");
      if (static_cast<int>(i) == wanted) list_.clear();
      for (double item = 0; item < count; ++item) {
        const double value = values_.take(property.type);
        if (static_cast<int>(i) == wanted) list_.push_back(value);
      }
    }
  }

  static std::array<int, 2> texcoord_properties(const PlyElement& element) {
    for (const auto& names :
         {std::array{"u", "v"}, std::array{"s", "t"}, std::array{"texture_u", "texture_v"}}) {
      const std::array<int, 2> found{element.find(names[0]), element.find(names[1])};
      if (found[0] >= 0 && found[1] >= 0) return found;
    }
    return {-1, -1};
  }

  float number(int property) const {
    const auto value = static_cast<float>(row_[property]);
    if (!std::isfinite(value))
      throw Error(name_, fmt::format("vertex {}: a value is not finite", mesh_.positions.size()));
    return value;
  }

  void read_vertices(const PlyElement& element) {
    const int x = element.find("x"), y = element.find("y"), z = element.find("z");
    if (x < 0 || y < 0 || z < 0) throw Error(name_, "its vertices have no x, y and z");
    const int nx = element.find("nx"), ny = element.find("ny"), nz = element.find("nz");
    const auto [u, v] = texcoord_properties(element);
    has_colors_ = element.find("red") >= 0 || element.find("diffuse_red") >= 0;
    mesh_.positions.reserve(element.count);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      take_element(element, -1);
      const Vec3f position{number(x), number(y), number(z)};
      if (nx >= 0 && ny >= 0 && nz >= 0)
        mesh_.normals.push_back(
            {static_cast<float>(row_[nx]), static_cast<float>(row_[ny]), static_cast<float>(row_[nz])});
      if (u >= 0) mesh_.texcoords[0].push_back({number(u), 1 - number(v)});  // glTF's v points down
      mesh_.positions.push_back(position);
    }
  }

  void read_faces(const PlyElement& element) {
    const bool is_face = element.name == "face", is_strip = element.name == "tristrips";
    int wanted = element.find("vertex_indices");
    if (wanted < 0) wanted = element.find("vertex_index");
    if ((is_face || is_strip) && (wanted < 0 || !element.properties[wanted].is_list))
      throw Error(name_, "its faces have no list vertex_indices");
    if (element.properties.empty()) return;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      take_element(element, wanted);
      if (is_face) add_list(polygons_);
      if (is_strip) add_list(strips_);
    }
  }

  // Lists one after the other, each with its length before it.
  void add_list(std::vector<double>& lists) {
    lists.push_back(static_cast<double>(list_.size()));
    lists.insert(lists.end(), list_.begin(), list_.end());
  }

  std::uint32_t vertex(double index) const {
    if (!(index >= 0 && index < static_cast<double>(mesh_.positions.size())) || index != std::floor(index))
      throw Error(name_, fmt::format("a face uses vertex {} of {}", index, mesh_.positions.size()));
    return static_cast<std::uint32_t>(index);
  }

  // Faces may come before the vertices, so they are looked at last.
  void make_triangles() {
    for (std::size_t i = 0; i < polygons_.size(); i += 1 + static_cast<std::size_t>(polygons_[i]))
      add_polygon(std::span(polygons_).subspan(i + 1, static_cast<std::size_t>(polygons_[i])));
    for (std::size_t i = 0; i < strips_.size(); i += 1 + static_cast<std::size_t>(strips_[i]))
      add_strip(std::span(strips_).subspan(i + 1, static_cast<std::size_t>(strips_[i])));
  }

  void add_polygon(std::span<const double> indices) {
    corners_.clear();
    triangles_.clear();
    for (double index : indices) corners_.push_back(mesh_.positions[vertex(index)]);
    triangulate(corners_, triangles_);
    for (const auto& t : triangles_)
      mesh_.triangles.push_back({vertex(indices[t[0]]), vertex(indices[t[1]]), vertex(indices[t[2]])});
  }

  // -1 ends a strip and begins the next.
  void add_strip(std::span<const double> indices) {
    std::size_t first = 0;
    for (std::size_t i = 0; i < indices.size(); ++i) {
      if (indices[i] == -1) {
        first = i + 1;
        continue;
      }
      if (i < first + 2) continue;
      const std::uint32_t a = vertex(indices[i - 2]), b = vertex(indices[i - 1]), c = vertex(indices[i]);
      if (a == b || b == c || c == a) continue;
      mesh_.triangles.push_back((i - first) % 2 == 0 ? std::array{a, b, c} : std::array{b, a, c});
    }
  }

  const PlyHeader& header_;
  std::string_view name_;
  Values values_;
  Mesh mesh_;
  std::vector<double> row_, list_, polygons_, strips_;
  std::vector<Vec3f> corners_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  bool has_colors_ = false;
};

}  // namespace

Scene decode_ply(std::span<const std::uint8_t> bytes, std::string_view name) {
  const PlyHeader header =
      parse_ply_header({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, name);
  Reader reader(bytes.subspan(header.size), header, name);
  Scene scene;
  scene.source = name;
  scene.meshes.push_back(reader.run());
  MeshRepairs repairs;
  repair_mesh(scene.meshes[0], repairs);
  repairs.add_warnings(scene.warnings);
  if (reader.has_colors()) scene.warnings.emplace_back("vertex colors are not used");
  if (scene.meshes[0].triangles.empty()) throw Error(name, "has no triangles to show");
  scene.materials.push_back(default_import_material());
  scene.instances.emplace_back();
  check_scene(scene);
  return scene;
}

}  // namespace welkin

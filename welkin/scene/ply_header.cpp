#include <welkin/scene/ply_header.h>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <utility>

#include <welkin/error.h>
#include <welkin/scene/text_lines.h>

namespace welkin {
namespace {

struct HeaderLine {
  std::string_view name;
  std::string_view rest;
  std::size_t number;

  [[noreturn]] void fail(std::string_view what) const {
    throw Error(name, fmt::format("line {}: {}", number, what));
  }
  std::string_view word() { return take_word(rest); }

  PlyType type() {
    static constexpr std::pair<std::string_view, PlyType> types[] = {
        {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
        {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
        {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
        {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
        {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
        {"float64", PlyType::float64}};
    const std::string_view name_of_type = word();
    for (const auto& [known, type] : types) {
      if (known == name_of_type) return type;
    }
    fail(fmt::format("\"{}\" is not a type of PLY", printable(name_of_type)));
  }

  PlyForm form() {
    const std::string_view form = word();
    if (word() != "1.0") fail("only PLY 1.0 is read");
    if (form == "ascii") return PlyForm::ascii;
    if (form == "binary_little_endian") return PlyForm::little_endian;
    if (form == "binary_big_endian") return PlyForm::big_endian;
    fail(fmt::format("\"{}\" is not a format of PLY", printable(form)));
  }

  PlyElement element() {
    PlyElement element;
    element.name = word();
    const std::string_view count = word();
    const auto [end, fault] = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (fault != std::errc() || end != count.data() + count.size())
      fail(fmt::format("\"{}\" is not a number of elements", printable(count)));
    return element;
  }

  PlyProperty property() {
    PlyProperty property;
    std::string_view ahead = rest;
    if (take_word(ahead) == "list") {
      rest = ahead;
      property.is_list = true;
      property.count_type = type();
    }
    property.type = type();
    property.name = word();
    return property;
  }
};

}  // namespace

int PlyElement::find(std::string_view property) const {
  const auto found = std::find_if(properties.begin(), properties.end(),
                                  [&](const PlyProperty& p) { return p.name == property; });
  return found == properties.end() ? -1 : static_cast<int>(found - properties.begin());
}

PlyHeader parse_ply_header(std::string_view text, std::string_view name) {
  constexpr std::size_t most_parts = 1000;
  TextLines lines(text);
  if (!lines.next() || trimmed(lines.line()) != "ply") throw Error(name, "not a PLY file");
  PlyHeader header;
  bool has_form = false;
  for (std::size_t parts = 0; lines.next(); ++parts) {
    HeaderLine line{name, lines.line(), lines.number()};
    const std::string_view key = line.word();
    if (key == "end_header") {
      if (!has_form) throw Error(name, "its header names no format");
      // The last line has its end, or binary data could not begin.
      header.size = text.size() - lines.rest().size();
      if (text[header.size - 1] != '\n') throw Error(name, "is cut off after its header");
      return header;
    }
    if (parts > most_parts) line.fail("the header has more than 1000 lines");
    if (key == "format") {
      header.form = line.form();
      has_form = true;
    } else if (key == "element") {
      header.elements.push_back(line.element());
    } else if (key == "property") {
      if (header.elements.empty()) line.fail("a property before any element");
      header.elements.back().properties.push_back(line.property());
    } else if (key != "comment" && key != "obj_info" && !key.empty()) {
      line.fail(fmt::format("\"{}\" does not belong into a PLY header", printable(key)));
    }
  }
  throw Error(name, "its header has no end");
}

}  // namespace welkin

#include <welkin/image/codecs/hdr.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <string>

#include <welkin/error.h>
#include <welkin/image/codecs/chromaticities.h>
#include <welkin/image/codecs/size_limit.h>
#include <welkin/parallel/parallel_for.h>

namespace welkin {
namespace {

constexpr int min_rle_width = 8, max_rle_width = 32767;  // scan lines that new run lengths are defined for

using Rgbe = std::array<std::uint8_t, 4>;

struct Header {
  int width = 0, height = 0;
  bool column_major = false;   // scan lines are columns
  bool right_to_left = false;  // X decreases along the file
  bool bottom_to_top = false;  // Y increases along the file
  bool xyz = false;
  std::array<double, 3> scale{1, 1, 1};  // what EXPOSURE and COLORCORR multiplied in

  int scan_line_count() const { return column_major ? width : height; }
  int scan_line_length() const { return column_major ? height : width; }
};

class Reader {
 public:
  Reader(std::span<const std::uint8_t> bytes, std::string_view name) : bytes_(bytes), name_(name) {}

  std::size_t position() const { return position_; }
  [[noreturn]] void fail(const std::string& message) const { throw Error(name_, message); }

  std::string_view line() {
    const auto rest = bytes_.subspan(position_);
    const auto end = std::find(rest.begin(), rest.end(), std::uint8_t{'\n'});
    if (end == rest.end()) fail("the Radiance header is cut off");
    const auto length = static_cast<std::size_t>(end - rest.begin());
    position_ += length + 1;
    std::string_view text(reinterpret_cast<const char*>(rest.data()), length);
    if (text.ends_with('\r')) text.remove_suffix(1);
    return text;
  }

  const std::uint8_t* take(std::size_t count) {
    if (bytes_.size() - position_ < count)
      fail(fmt::format("the pixels are cut off after {} bytes", bytes_.size()));
    position_ += count;
    return bytes_.data() + position_ - count;
  }

  bool starts_with_run_length_marker() const {
    const auto rest = bytes_.subspan(position_);
    return rest.size() >= 4 && rest[0] == 2 && rest[1] == 2 && rest[2] < 128;
  }

 private:
  std::span<const std::uint8_t> bytes_;
  std::string_view name_;
  std::size_t position_ = 0;
};

// strtod and friends depend on the locale; from_chars does not.
std::optional<double> take_number(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

double exposure_factor(const Reader& reader, std::string_view& text) {
  const std::optional<double> factor = take_number(text);
  if (!factor || !(*factor > 0) || !std::isfinite(*factor)) {
    reader.fail("the header has an EXPOSURE or COLORCORR that is not a positive number");
  }
  return *factor;
}

// Lines that a tool copied from an earlier picture are indented and do not count, hence the exact prefixes.
void read_variable(const Reader& reader, std::string_view line, Header& header) {
  constexpr std::string_view exposure = "EXPOSURE=", correction = "COLORCORR=", format = "FORMAT=";
  if (line.starts_with(exposure)) {
    line.remove_prefix(exposure.size());
    const double factor = exposure_factor(reader, line);
    for (double& scale : header.scale) scale *= factor;
  } else if (line.starts_with(correction)) {
    line.remove_prefix(correction.size());
    for (double& scale : header.scale) scale *= exposure_factor(reader, line);
  } else if (line.starts_with(format)) {
    line.remove_prefix(format.size());
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    header.xyz = line.starts_with("32-bit_rle_xyze");
    if (!header.xyz && !line.starts_with("32-bit_rle_rgbe")) {
      reader.fail(fmt::format("the Radiance format '{}' is not known", line.substr(0, 40)));
    }
  }
}

struct Axis {
  char sign = 0, letter = 0;
  std::int64_t length = 0;
};

std::optional<Axis> take_axis(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  if (text.size() < 3) return std::nullopt;
  Axis axis{text[0], text[1], 0};
  if ((axis.sign != '-' && axis.sign != '+') || (axis.letter != 'X' && axis.letter != 'Y'))
    return std::nullopt;
  text.remove_prefix(2);
  const std::optional<double> length = take_number(text);
  if (!length || !(std::abs(*length) < 1e15) || *length != std::floor(*length)) return std::nullopt;
  axis.length = static_cast<std::int64_t>(*length);
  return axis;
}

void read_resolution(Reader& reader, std::string_view name, std::size_t byte_count, Header& header) {
  std::string_view line = reader.line();
  const std::string shown(line.substr(0, 40));
  const std::optional<Axis> slow = take_axis(line), fast = take_axis(line);
  if (!slow || !fast || slow->letter == fast->letter) {
    reader.fail(fmt::format("'{}' is no resolution line, such as -Y 512 +X 1024", shown));
  }
  header.column_major = slow->letter == 'X';
  const Axis& x = header.column_major ? *slow : *fast;
  const Axis& y = header.column_major ? *fast : *slow;
  header.right_to_left = x.sign == '-';
  header.bottom_to_top = y.sign == '+';
  // Old run lengths hold a scan line of n equal pixels in 4 + 4 ceil(log256 n) bytes: no limit per byte, but
  // one that no picture of use comes near.
  constexpr double pixels_per_byte = 4096;
  check_image_size(name, x.length, y.length, byte_count, pixels_per_byte);
  header.width = static_cast<int>(x.length);
  header.height = static_cast<int>(y.length);
}

Header read_header(Reader& reader, std::string_view name, std::size_t byte_count) {
  if (!reader.line().starts_with("#?")) reader.fail("not a Radiance picture: it does not begin with #?");
  Header header;
  for (std::string_view line = reader.line(); !line.empty(); line = reader.line())
    read_variable(reader, line, header);
  read_resolution(reader, name, byte_count, header);
  for (double scale : header.scale) {
    if (!(scale > 0) || !std::isfinite(scale)) reader.fail("the EXPOSURE lines multiply to zero or infinity");
  }
  return header;
}

// New run lengths: a marker (2, 2, length) and then the four components one after another, each as packets: a
// count above 128 repeats the next byte count - 128 times, one up to 128 is followed by that many bytes.
// sink(component, offset, bytes, count, repeated) sees every packet.
template <class Sink>
void read_packets(Reader& reader, int length, Sink&& sink) {
  const std::uint8_t* marker = reader.take(4);
  if ((marker[2] << 8 | marker[3]) != length)
    reader.fail("a scan line's length is not the picture's; it is damaged");
  for (int component = 0; component < 4; ++component) {
    for (int offset = 0; offset < length;) {
      const int code = *reader.take(1);
      const bool repeated = code > 128;
      const int count = repeated ? code - 128 : code;
      if (count == 0 || count > length - offset)
        reader.fail("a run length leaves its scan line; the file is damaged");
      sink(component, offset, reader.take(repeated ? 1 : static_cast<std::size_t>(count)), count, repeated);
      offset += count;
    }
  }
}

// Old run lengths: pixels as they are, except that (1, 1, 1, n) repeats the pixel before it n times; markers
// that follow each other directly are the digits of one count, lowest first (n, n << 8, ...). Flat data is
// the same without markers.
template <class Sink>
void read_old_pixels(Reader& reader, int length, Sink&& sink) {
  const std::uint8_t* last = nullptr;
  int shift = 0;
  for (int offset = 0; offset < length;) {
    const std::uint8_t* pixel = reader.take(4);
    const bool repeat = pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1;
    if (!repeat) {
      last = pixel;
      shift = 0;
    } else if (!last || shift > 24) {
      reader.fail("a run length has no pixel to repeat; the file is damaged");
    }
    const std::int64_t count = repeat ? std::int64_t{pixel[3]} << shift : 1;
    if (count > length - offset) reader.fail("a run length leaves its scan line; the file is damaged");
    if (repeat) shift += 8;
    sink(offset, last, static_cast<int>(count));
    offset += static_cast<int>(count);
  }
}

bool has_new_run_lengths(const Reader& reader, int length) {
  return length >= min_rle_width && length <= max_rle_width && reader.starts_with_run_length_marker();
}

// Walks over the run lengths only, which is much less than decoding, so that scan lines can be decoded in
// parallel and a damaged file is refused before memory is taken.
std::vector<std::size_t> find_scan_lines(Reader& reader, const Header& header) {
  const int length = header.scan_line_length();
  std::vector<std::size_t> starts;
  for (int i = 0; i < header.scan_line_count(); ++i) {
    starts.push_back(reader.position());
    if (has_new_run_lengths(reader, length)) {
      read_packets(reader, length, [](int, int, const std::uint8_t*, int, bool) {});
    } else {
      read_old_pixels(reader, length, [](int, const std::uint8_t*, int) {});
    }
  }
  return starts;
}

// One scan line as four planes of `length` bytes.
void decode_scan_line(Reader reader, int length, std::span<std::uint8_t> planes) {
  const auto plane = [&](int component) {
    return planes.data() + static_cast<std::size_t>(component) * length;
  };
  if (has_new_run_lengths(reader, length)) {
    read_packets(reader, length,
                 [&](int component, int offset, const std::uint8_t* data, int count, bool repeated) {
                   std::uint8_t* target = plane(component) + offset;
                   const auto size = static_cast<std::size_t>(count);
                   repeated ? std::memset(target, *data, size) : std::memcpy(target, data, size);
                 });
    return;
  }
  read_old_pixels(reader, length, [&](int offset, const std::uint8_t* pixel, int count) {
    for (int c = 0; c < 4; ++c) std::memset(plane(c) + offset, pixel[c], static_cast<std::size_t>(count));
  });
}

// 2^(e - 136) for every exponent, with what the header multiplied in divided out.
using ScaleTable = std::array<std::array<float, 3>, 256>;

ScaleTable make_scales(const Header& header) {
  ScaleTable table{};
  for (int e = 1; e < 256; ++e) {
    for (int c = 0; c < 3; ++c) table[e][c] = static_cast<float>(std::ldexp(1 / header.scale[c], e - 136));
  }
  return table;
}

void store_scan_line(const Header& header, const ScaleTable& scales, std::span<const std::uint8_t> planes,
                     int index, Image& image) {
  const int length = header.scan_line_length();
  const ColourMatrix to_rec709 = xyz_to_rec709();
  const auto mirrored = [](bool mirror, int i, int count) { return mirror ? count - 1 - i : i; };
  const std::uint8_t *r = planes.data(), *g = r + length, *b = g + length, *e = b + length;
  for (int i = 0; i < length; ++i) {
    const int x = mirrored(header.right_to_left, header.column_major ? index : i, header.width);
    const int y = mirrored(header.bottom_to_top, header.column_major ? i : index, header.height);
    const auto& scale = scales[e[i]];
    float* pixel = image.at(x, y);
    pixel[0] = static_cast<float>(r[i]) * scale[0];
    pixel[1] = static_cast<float>(g[i]) * scale[1];
    pixel[2] = static_cast<float>(b[i]) * scale[2];
    if (header.xyz) transform_colour(to_rec709, pixel);
  }
}

}  // namespace

Image decode_hdr(std::span<const std::uint8_t> bytes, std::string_view name) {
  Reader reader(bytes, name);
  const Header header = read_header(reader, name, bytes.size());
  const std::vector<std::size_t> starts = find_scan_lines(reader, header);
  const ScaleTable scales = make_scales(header);
  Image image(header.width, header.height);
  const int length = header.scan_line_length();
  parallel_for(starts.size(), 16, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint8_t> planes(std::size_t{4} * length);
    for (std::size_t i = begin; i < end; ++i) {
      Reader line(bytes, name);
      line.take(starts[i]);
      decode_scan_line(line, length, planes);
      store_scan_line(header, scales, planes, static_cast<int>(i), image);
    }
  });
  return image;
}

namespace {

// With max = f * 2^k, f in [1/2, 1), the exponent byte k + 128 gives mantissas max * 2^(8 - k) in [128, 256).
// One that would round to 256 takes the next exponent, where it is 128 exactly.
Rgbe encode_pixel(const float* pixel, int channels) {
  constexpr float largest = 255 * 0x1p119f;
  std::array<float, 3> value{};
  for (int c = 0; c < 3; ++c) {
    const float v = pixel[channels == 1 ? 0 : c];
    value[c] = v > 0 ? std::min(v, largest) : 0.0f;  // NaN compares false
  }
  int exponent = 0;
  const float top = std::max({value[0], value[1], value[2]});
  if (std::frexp(top, &exponent) >= 255.5f / 256) ++exponent;
  const int stored = exponent + 128;
  if (top == 0 || stored < 1) return {0, 0, 0, 0};
  Rgbe result{};
  for (int c = 0; c < 3; ++c) {
    result[c] =
        static_cast<std::uint8_t>(std::lround(std::ldexp(static_cast<double>(value[c]), 8 - exponent)));
  }
  result[3] = static_cast<std::uint8_t>(std::min(stored, 255));
  return result;
}

// Runs shorter than this cost more as a repeat packet between two literal ones than as part of one literal
// packet.
constexpr std::size_t min_run = 4;

std::size_t run_length(std::span<const std::uint8_t> plane, std::size_t at) {
  std::size_t end = at + 1;
  while (end < plane.size() && end - at < 127 && plane[end] == plane[at]) ++end;
  return end - at;
}

void write_plane(std::span<const std::uint8_t> plane, std::vector<std::uint8_t>& out) {
  for (std::size_t at = 0; at < plane.size();) {
    std::size_t literal_end = at, run = 0;
    while (literal_end < plane.size() && (run = run_length(plane, literal_end)) < min_run) literal_end += run;
    while (at < literal_end) {
      const std::size_t count = std::min<std::size_t>(128, literal_end - at);
      out.push_back(static_cast<std::uint8_t>(count));
      out.insert(out.end(), plane.begin() + static_cast<std::ptrdiff_t>(at),
                 plane.begin() + static_cast<std::ptrdiff_t>(at + count));
      at += count;
    }
    if (at == plane.size()) return;
    out.push_back(static_cast<std::uint8_t>(128 + run));
    out.push_back(plane[at]);
    at += run;
  }
}

void write_row(const Image& image, int y, bool run_lengths, std::vector<std::uint8_t>& planes,
               std::vector<std::uint8_t>& out) {
  const auto width = static_cast<std::size_t>(image.width);
  for (int x = 0; x < image.width; ++x) {
    const Rgbe pixel = encode_pixel(image.at(x, y), image.channels);
    if (!run_lengths) out.insert(out.end(), pixel.begin(), pixel.end());
    for (std::size_t c = 0; c < 4; ++c) planes[c * width + x] = pixel[c];
  }
  if (!run_lengths) return;
  out.insert(out.end(), {2, 2, static_cast<std::uint8_t>(image.width >> 8),
                         static_cast<std::uint8_t>(image.width & 255)});
  for (std::size_t c = 0; c < 4; ++c) write_plane(std::span(planes).subspan(c * width, width), out);
}

}  // namespace

std::vector<std::uint8_t> encode_hdr(const Image& image) {
  assert(image.width > 0 && image.height > 0 && (image.channels == 1 || image.channels == 3));
  const std::string header = fmt::format(
      "#?RADIANCE\nSOFTWARE=welkin\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", image.height, image.width);
  const bool run_lengths = image.width >= min_rle_width && image.width <= max_rle_width;
  constexpr std::size_t rows_per_chunk = 16;
  using Bytes = std::vector<std::uint8_t>;
  const auto parts =
      parallel_partials<Bytes>(static_cast<std::size_t>(image.height), rows_per_chunk,
                               [&](Bytes& out, std::size_t begin, std::size_t end) {
                                 Bytes planes(std::size_t{4} * image.width);
                                 for (std::size_t y = begin; y < end; ++y)
                                   write_row(image, static_cast<int>(y), run_lengths, planes, out);
                               });
  Bytes result(header.begin(), header.end());
  for (const Bytes& part : parts) result.insert(result.end(), part.begin(), part.end());
  return result;
}

}  // namespace welkin

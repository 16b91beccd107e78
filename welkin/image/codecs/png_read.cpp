#include <png.h>

#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <string>
#include <utility>

#include <welkin/error.h>
#include <welkin/image/codecs/ldr_samples.h>
#include <welkin/image/codecs/size_limit.h>

// libpng reports errors by longjmp. So each step that calls it is a function of its own with setjmp at its start, and
// neither there nor in the callbacks lives anything with a destructor; what has one belongs to the caller of the steps.

namespace welkin {
namespace {

constexpr png_uint_32 max_side = 1000000;

struct Source {
  const std::uint8_t* next = nullptr;
  std::size_t left = 0;
  char failure[160] = "out of memory";
};

void read_bytes(png_structp png, png_bytep to, png_size_t count) {
  Source& source = *static_cast<Source*>(png_get_io_ptr(png));
  if (count > source.left) png_error(png, "the file is cut off");
  std::memcpy(to, source.next, count);
  source.next += count;
  source.left -= count;
}

[[noreturn]] void on_error(png_structp png, png_const_charp message) {
  Source& source = *static_cast<Source*>(png_get_error_ptr(png));
  std::snprintf(source.failure, sizeof source.failure, "%s", message);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

struct Reader {
  explicit Reader(std::span<const std::uint8_t> bytes) : source{bytes.data(), bytes.size()} {
    png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, on_error, on_warning);
    info = png ? png_create_info_struct(png) : nullptr;
  }
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  Source source;
  png_structp png = nullptr;
  png_infop info = nullptr;
};

// Wrong check sums, also those of chunks that are not needed, and what libpng itself would only warn of (a wrong check
// sum of the deflated data) count as damage. A fuzzer cannot guess check sums.
void set_strictness(png_structp png) {
  png_set_user_limits(png, max_side, max_side);
  png_set_chunk_malloc_max(png, 0);  // chunks are skipped, not kept, so long ones may pass
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
  png_set_crc_action(png, PNG_CRC_QUIET_USE, PNG_CRC_QUIET_USE);
  png_set_option(png, PNG_IGNORE_ADLER32, PNG_OPTION_ON);
#else
  png_set_crc_action(png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
#endif
  png_set_benign_errors(png, 0);
  png_set_check_for_invalid_index(png, 0);  // look_up does
}

// Of the chunks that may be left out, none is used but, for alpha, tRNS. Skipping them also keeps profiles and compressed texts from being
// unpacked. A negative count names all that libpng knows, except the transparent colours.
bool read_header(png_structp png, png_infop info, Source* source, bool keep_alpha) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_read_fn(png, source, read_bytes);
  set_strictness(png);
  png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
  if (!keep_alpha)
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, reinterpret_cast<png_const_bytep>("tRNS"), 1);
  png_read_info(png, info);
  return true;
}

// RGB or RGBA, or one byte of palette index per pixel.
bool set_row_form(png_structp png, png_infop info, bool keep_alpha) {
  if (setjmp(png_jmpbuf(png))) return false;
  if (png_get_color_type(png, info) == PNG_COLOR_TYPE_PALETTE) {
    png_set_packing(png);
  } else {
    png_set_expand(png);
    png_set_gray_to_rgb(png);
    if (!keep_alpha) png_set_strip_alpha(png);
  }
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  return true;
}

// An interlaced picture comes in 7 passes, each adding its pixels to the rows.
bool read_rows(png_structp png, png_infop info, std::uint8_t* rows, std::size_t row_bytes) {
  if (setjmp(png_jmpbuf(png))) return false;
  const int passes = png_get_interlace_type(png, info) == PNG_INTERLACE_ADAM7 ? 7 : 1;
  const png_uint_32 height = png_get_image_height(png, info);
  for (int pass = 0; pass < passes; ++pass) {
    for (png_uint_32 y = 0; y < height; ++y) png_read_row(png, rows + y * row_bytes, nullptr);
  }
  png_read_end(png, nullptr);
  return true;
}

// Replaces indices by colours. Those beyond the list of transparencies are opaque.
void look_up(LdrSamples& samples, const Reader& reader, bool keep_alpha, std::string_view name) {
  png_colorp palette = nullptr;
  png_bytep alpha = nullptr;
  int count = 0, alpha_count = 0;
  png_get_PLTE(reader.png, reader.info, &palette, &count);
  if (keep_alpha) png_get_tRNS(reader.png, reader.info, &alpha, &alpha_count, nullptr);
  samples.channels = alpha_count > 0 ? 4 : 3;
  std::vector<std::uint8_t> colors;
  colors.reserve(samples.bytes.size() * samples.channels);
  for (std::uint8_t index : samples.bytes) {
    if (index >= count) throw Error(name, "this PNG is damaged: a pixel is outside the palette");
    colors.insert(colors.end(), {palette[index].red, palette[index].green, palette[index].blue});
    if (samples.channels == 4) colors.push_back(index < alpha_count ? alpha[index] : std::uint8_t{255});
  }
  samples.bytes = std::move(colors);
}

[[noreturn]] void fail(const Reader& reader, std::string_view name) {
  throw Error(name, std::string("cannot read this PNG: ") + reader.source.failure);
}

}  // namespace

LdrSamples read_png(std::span<const std::uint8_t> bytes, std::string_view name, bool keep_alpha) {
  Reader reader(bytes);
  png_structp png = reader.png;
  if (!reader.info || !read_header(png, reader.info, &reader.source, keep_alpha)) fail(reader, name);
  const auto width = png_get_image_width(png, reader.info), height = png_get_image_height(png, reader.info);
  const int pixel_bits = png_get_bit_depth(png, reader.info) * png_get_channels(png, reader.info);
  constexpr double deflate_ratio = 1032;  // no stream unpacks to more
  check_image_size(name, width, height, bytes.size(), 8 * deflate_ratio / pixel_bits);

  if (!set_row_form(png, reader.info, keep_alpha)) fail(reader, name);
  LdrSamples samples{static_cast<int>(width),
                     static_cast<int>(height),
                     png_get_bit_depth(png, reader.info),
                     png_get_channels(png, reader.info),
                     {}};
  const std::size_t row_bytes = png_get_rowbytes(png, reader.info);
  samples.bytes.resize(row_bytes * height);
  if (!read_rows(png, reader.info, samples.bytes.data(), row_bytes)) fail(reader, name);
  if (png_get_color_type(png, reader.info) == PNG_COLOR_TYPE_PALETTE) {
    look_up(samples, reader, keep_alpha, name);
  }
  return samples;
}

}  // namespace welkin

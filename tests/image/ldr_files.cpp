#include <tests/image/ldr_files.h>

#include <png.h>

#include <cassert>
#include <stdexcept>

// Errors of the libraries end the program: what is written here is valid.

namespace welkin {
namespace {

using Bytes = std::vector<std::uint8_t>;

void append(png_structp png, png_bytep data, png_size_t count) {
  auto& bytes = *static_cast<Bytes*>(png_get_io_ptr(png));
  bytes.insert(bytes.end(), data, data + count);
}

// Samples of less than 8 bits stand side by side in a byte, the first in the high bits; 16 have the high byte first.
Bytes packed_row(const PngForm& form, const PngSample& sample, int y) {
  Bytes row;
  int used = 8;
  for (int i = 0; i < form.width * channel_count(form.color); ++i) {
    const int value = sample(i / channel_count(form.color), y, i % channel_count(form.color));
    assert(value >= 0 && value < 1 << form.bits);
    if (form.bits == 16) row.push_back(static_cast<std::uint8_t>(value >> 8));
    if (form.bits >= 8) {
      row.push_back(static_cast<std::uint8_t>(value));
      continue;
    }
    if (used == 8) row.push_back(0), used = 0;
    used += form.bits;
    row.back() = static_cast<std::uint8_t>(row.back() | value << (8 - used));
  }
  return row;
}

void write_palette(png_structp png, png_infop info, const PngForm& form) {
  std::vector<png_color> colors;
  for (const auto& [r, g, b] : form.palette) colors.push_back({r, g, b});
  png_set_PLTE(png, info, colors.data(), static_cast<int>(colors.size()));
}

void write_chunks(png_structp png, png_infop info, const PngForm& form) {
  if (form.color == PngColor::palette) write_palette(png, info, form);
  if (form.transparent_color) {
    png_color_16 color{};
    Bytes alpha(form.palette.size(), 7);
    png_set_tRNS(png, info, alpha.data(), static_cast<int>(alpha.size()), &color);
  }
  if (form.ancillary) {
    png_set_gAMA(png, info, 1.0);
    char key[] = "Comment", words[] = "light";
    png_text text{};
    text.compression = PNG_TEXT_COMPRESSION_zTXt, text.key = key, text.text = words, text.text_length = 5;
    png_set_text(png, info, &text, 1);
  }
}

Bytes compressed(const Bytes& pixels, int width, int height, TJPF format, const JpegForm& form) {
  tjhandle handle = tjInitCompress();
  unsigned char* memory = nullptr;
  unsigned long size = 0;
  const int failed = tjCompress2(handle, pixels.data(), width, 0, height, format, &memory, &size,
                                 form.subsampling, form.quality, form.progressive ? TJFLAG_PROGRESSIVE : 0);
  Bytes bytes(memory, memory + (failed ? 0 : size));
  tjFree(memory);
  tjDestroy(handle);
  if (failed) throw std::runtime_error("TurboJPEG cannot write this form");
  return bytes;
}

}  // namespace

int channel_count(PngColor color) {
  const int bits = static_cast<int>(color);
  return color == PngColor::palette ? 1 : (bits & 2 ? 3 : 1) + (bits & 4 ? 1 : 0);
}

std::vector<std::uint8_t> png_file(const PngForm& form, const PngSample& sample) {
  Bytes bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(png, &bytes, append, nullptr);
  png_set_check_for_invalid_index(png, 0);  // tests write pixels outside the palette
  png_set_IHDR(png, info, static_cast<png_uint_32>(form.width), static_cast<png_uint_32>(form.height),
               form.bits, static_cast<int>(form.color),
               form.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  write_chunks(png, info, form);
  png_write_info(png, info);
  std::vector<Bytes> rows;
  std::vector<png_bytep> row_pointers;
  for (int y = 0; y < form.height; ++y) rows.push_back(packed_row(form, sample, y));
  for (Bytes& row : rows) row_pointers.push_back(row.data());
  png_write_image(png, row_pointers.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

std::vector<std::uint8_t> jpeg_file(const ByteImage& image, const JpegForm& form) {
  JpegForm actual = form;
  if (image.channels == 1) actual.subsampling = TJSAMP_GRAY;
  const Bytes pixels(image.pixels.begin(), image.pixels.end());
  return compressed(pixels, image.width, image.height, image.channels == 1 ? TJPF_GRAY : TJPF_RGB, actual);
}

std::vector<std::uint8_t> cmyk_jpeg_file() {
  return compressed(Bytes(std::size_t{16} * 16 * 4, 200), 16, 16, TJPF_CMYK, {.subsampling = TJSAMP_444});
}

}  // namespace welkin

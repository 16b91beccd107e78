#include <cstdio>
#include <filesystem>
#include <string>

#include <tests/image/exr_files.h>
#include <tests/image/ldr_files.h>
#include <tests/scene/scene_files.h>
#include <welkin/brdf/merl.h>
#include <welkin/brdf/models.h>
#include <welkin/image/codecs/dds.h>
#include <welkin/image/codecs/exr.h>
#include <welkin/image/codecs/exr_layers.h>
#include <welkin/image/codecs/hdr.h>
#include <welkin/image/codecs/ktx2.h>
#include <welkin/image/codecs/ldr.h>
#include <welkin/image/output_file.h>
#include <welkin/pathtrace/checkpoint.h>
#include <welkin/sh/forms/document.h>

// Usage: fuzz_seeds FOLDER. Writes small valid files of every form into FOLDER/<reader>, and all images into
// FOLDER/image, for the fuzzers to begin with.

namespace welkin {
namespace {

using Bytes = std::vector<std::uint8_t>;

class SeedFolder {
 public:
  explicit SeedFolder(std::filesystem::path root) : root_(std::move(root)) {}
  void add(const std::string& reader, const std::string& name, const Bytes& bytes) const {
    for (const std::string& folder : {reader, std::string("image")}) add_to(folder, name, bytes);
  }
  void add_to(const std::string& folder, const std::string& name, const Bytes& bytes) const {
    std::filesystem::create_directories(root_ / folder);
    write_file(root_ / folder / name, bytes);
  }

 private:
  std::filesystem::path root_;
};

Image picture(int width, int height, int channels = 3) {
  Image image(width, height, channels);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<float>(i / 5) * 0.25f;
  return image;
}

CubeMips cube_mips(int size) {
  CubeMips cube;
  for (; size > 0; size /= 2) {
    cube.levels.emplace_back(size);
    std::fill(cube.levels.back().texels.begin(), cube.levels.back().texels.end(), static_cast<float>(size));
  }
  return cube;
}

Bytes text_and_pixels(const std::string& text, const Bytes& pixels) {
  Bytes bytes(text.begin(), text.end());
  bytes.insert(bytes.end(), pixels.begin(), pixels.end());
  return bytes;
}

void add_hdr(const SeedFolder& seeds) {
  seeds.add("hdr", "new.hdr", encode_hdr(picture(16, 3)));
  seeds.add("hdr", "flat.hdr", encode_hdr(picture(3, 2)));
  const std::string variables = "EXPOSURE=2\nCOLORCORR=1 2 3\nFORMAT=32-bit_rle_xyze\n\n";
  seeds.add(
      "hdr", "old.hdr",
      text_and_pixels("#?RADIANCE\n" + variables + "+X 1 -Y 261\n", {9, 8, 7, 130, 1, 1, 1, 4, 1, 1, 1, 1}));
}

std::vector<ExrChannel> exr_channels(Imf::PixelType type, std::initializer_list<const char*> names,
                                     int sampling = 1) {
  std::vector<ExrChannel> channels;
  for (const char* name : names) {
    channels.push_back({name, [](int x, int y) { return static_cast<float>(x + y); }, type,
                        channels.empty() ? 1 : sampling});
  }
  return channels;
}

void add_exr_form(const SeedFolder& seeds, const std::string& name, const ExrForm& form,
                  const std::vector<ExrChannel>& channels) {
  const Bytes bytes = exr_file(exr_header(form, channels), channels);
  seeds.add("exr", name + ".exr", bytes);
  seeds.add_to("exr_layers", name + ".exr", bytes);
}

void add_exr(const SeedFolder& seeds) {
  const Imath::Box2i even{{0, 0}, {7, 3}};
  const auto rgb = exr_channels(Imf::HALF, {"R", "G", "B"});
  for (int compression = Imf::NO_COMPRESSION; compression < Imf::NUM_COMPRESSION_METHODS; ++compression) {
    const auto method = static_cast<Imf::Compression>(compression);
    add_exr_form(seeds, "compression" + std::to_string(compression), {.compression = method}, rgb);
  }
  add_exr_form(seeds, "tiled", {.tile = 2}, rgb);
  add_exr_form(seeds, "mip", {.tile = 2, .mip_levels = true}, rgb);
  add_exr_form(seeds, "gray", {}, exr_channels(Imf::FLOAT, {"Y"}));
  add_exr_form(seeds, "chroma", {.data = even, .display = even},
               exr_channels(Imf::HALF, {"Y", "RY", "BY"}, 2));
  add_exr_form(seeds, "uint", {}, exr_channels(Imf::UINT, {"light.R", "light.G", "light.B"}));
  add_exr_form(seeds, "window", {.data = {{-2, 1}, {3, 5}}, .display = {{0, 0}, {4, 4}}}, rgb);
  seeds.add("exr", "ours.exr", encode_exr(picture(5, 4), {.stored_scale = 4}));
  seeds.add_to("exr_layers", "layers.exr",
               encode_exr_layers({{{"", {"R", "G", "B"}, picture(5, 4)},
                                   {"stderr", {"R", "G", "B"}, picture(5, 4)},
                                   {"depth", {"Z"}, picture(5, 4, 1)}},
                                  7}));
}

// Of the size and the fingerprint that fuzz_checkpoint.cpp asks for, and of others.
void add_checkpoints(const SeedFolder& seeds) {
  PictureState state = make_picture_state({3, 2});
  seeds.add_to("checkpoint", "empty.state", encode_checkpoint(state, 0x0123456789abcdef));
  std::fill(state.count.begin(), state.count.end(), 16u);
  std::fill(state.radiance_sum.begin(), state.radiance_sum.end(), 8.0);
  seeds.add_to("checkpoint", "begun.state", encode_checkpoint(state, 0x0123456789abcdef));
  seeds.add_to("checkpoint", "other.state", encode_checkpoint(state, 1));
  seeds.add_to("checkpoint", "small.state", encode_checkpoint(make_picture_state({1, 1}), 1));
}

void add_png_form(const SeedFolder& seeds, const std::string& name, PngForm form) {
  const int largest = (1 << form.bits) - 1;
  form.width = 9, form.height = 5;
  if (form.color == PngColor::palette)
    form.palette.assign(static_cast<std::size_t>(largest) + 1, {9, 99, 199});
  const auto sample = [=](int x, int y, int c) { return (x * 7 + y * 31 + c * 101) & largest; };
  seeds.add("ldr", name + ".png", png_file(form, sample));
  form.interlaced = true;
  seeds.add("ldr", name + "-interlaced.png", png_file(form, sample));
}

void add_ldr(const SeedFolder& seeds) {
  ByteImage bytes(9, 5);
  for (std::size_t i = 0; i < bytes.pixels.size(); ++i) bytes.pixels[i] = static_cast<std::uint8_t>(7 * i);
  seeds.add("ldr", "rgb.png", encode_png(bytes));
  seeds.add("ldr", "gray.png", encode_png(ByteImage(3, 3, 1)));
  add_png_form(seeds, "gray1", {.color = PngColor::gray, .bits = 1});
  add_png_form(seeds, "palette2", {.color = PngColor::palette, .bits = 2, .transparent_color = true});
  add_png_form(seeds, "palette8", {.color = PngColor::palette, .bits = 8});
  add_png_form(seeds, "rgba8", {.color = PngColor::rgba, .bits = 8, .ancillary = true});
  add_png_form(seeds, "gray16", {.color = PngColor::gray_alpha, .bits = 16});
  add_png_form(seeds, "rgb16", {.color = PngColor::rgb, .bits = 16});
  for (bool progressive : {false, true}) {
    const std::string suffix = progressive ? "-progressive.jpg" : ".jpg";
    seeds.add("ldr", "gray" + suffix, jpeg_file(ByteImage(9, 5, 1), {.progressive = progressive}));
    seeds.add("ldr", "rgb420" + suffix, jpeg_file(bytes, {.progressive = progressive}));
    seeds.add("ldr", "rgb444" + suffix,
              jpeg_file(bytes, {.subsampling = TJSAMP_444, .progressive = progressive}));
  }
  seeds.add("ldr", "cmyk.jpg", cmyk_jpeg_file());
}

void add_textures(const SeedFolder& seeds) {
  for (PixelFormat format :
       {PixelFormat::rgba16f, PixelFormat::rgba32f, PixelFormat::rgb9e5, PixelFormat::r11g11b10f,
        PixelFormat::bc6h, PixelFormat::bc6h_signed, PixelFormat::astc, PixelFormat::astc6x6}) {
    const std::string name = std::to_string(static_cast<int>(format));
    for (int zstd_level : {0, 1}) {
      const Ktx2Options options{.format = format, .zstd_level = zstd_level};
      const std::string suffix = name + (zstd_level > 0 ? "-zstd.ktx2" : ".ktx2");
      seeds.add("ktx2", "cube" + suffix, encode_ktx2(cube_mips(2), options).bytes);
      seeds.add("ktx2", "flat" + suffix, encode_ktx2(picture(3, 2), options).bytes);
    }
    if (pixel_layout(format).component == PixelLayout::Component::astc_hdr) continue;  // DDS has no ASTC
    seeds.add("dds", "cube" + name + ".dds", encode_dds(cube_mips(2), {.format = format}).bytes);
    seeds.add("dds", "flat" + name + ".dds", encode_dds(picture(3, 2), {.format = format}).bytes);
  }
}

void add_sh(const SeedFolder& seeds) {
  ShDocument document{ShCoefficients(2, 3), ShQuantity::radiance, "seed"};
  for (std::size_t i = 0; i < 27; ++i) document.coefficients.values[i] = static_cast<double>(i) / 8 - 1;
  for (ShForm form : all_sh_forms) {
    const std::string text = write_sh(document, form);
    seeds.add_to("sh", std::string(sh_form_name(form)), Bytes(text.begin(), text.end()));
  }
}

void add_merl(const SeedFolder& seeds) {
  for (const MerlShape& shape : {MerlShape{1, 1, 1}, MerlShape{2, 3, 4}}) {
    const MerlTable table = tabulate_merl(make_lambert_brdf({0.5, 0.25, 1}), shape);
    seeds.add_to("merl", std::to_string(shape.phi_diff) + ".binary", encode_merl(table));
  }
}

void add_scenes(const SeedFolder& seeds) {
  seeds.add_to("gltf", "quad.gltf", to_bytes(quad_gltf("data:;base64," + base64(quad_buffer()))));
  seeds.add_to("gltf", "quad.glb", glb_file(quad_gltf(""), quad_buffer()));
  const std::string zero(1, '\0');
  seeds.add_to("obj", "plain.obj", to_bytes(quad_obj()));
  seeds.add_to("obj", "materials.obj", to_bytes(quad_obj() + zero + quad_mtl()));
  seeds.add_to("obj", "texture.obj",
               text_and_pixels(quad_obj() + zero + quad_mtl() + zero, encode_png(ByteImage(2, 2))));
  seeds.add_to("ply", "ascii.ply", to_bytes(quad_ply_ascii()));
  for (bool big : {false, true}) seeds.add_to("ply", big ? "big.ply" : "little.ply", quad_ply_binary(big));
}

// One block of every mode number, the reserved ones too.
void add_bc6h(const SeedFolder& seeds) {
  for (int mode = 0; mode < 32; ++mode) {
    Bytes block(16, 0x5a);
    block[0] = static_cast<std::uint8_t>(mode);
    seeds.add_to("bc6h", std::to_string(mode), block);
  }
}

}  // namespace
}  // namespace welkin

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "usage: fuzz_seeds FOLDER\n");
    return 2;
  }
  const welkin::SeedFolder seeds(arguments[1]);
  welkin::add_hdr(seeds);
  welkin::add_exr(seeds);
  welkin::add_ldr(seeds);
  welkin::add_textures(seeds);
  welkin::add_sh(seeds);
  welkin::add_merl(seeds);
  welkin::add_scenes(seeds);
  welkin::add_bc6h(seeds);
  welkin::add_checkpoints(seeds);
  return 0;
}

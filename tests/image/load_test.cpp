#include <welkin/image/load.h>

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include <tests/image/prefixes.h>
#include <welkin/image/codecs/exr.h>
#include <welkin/image/codecs/hdr.h>
#include <welkin/image/codecs/ldr.h>
#include <welkin/image/output_file.h>

namespace welkin {
namespace {

class Load : public testing::Test {
 protected:
  Load() : folder_(std::filesystem::temp_directory_path() / ("welkin-load-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~Load() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path path(const char* name) const { return folder_ / name; }

 private:
  std::filesystem::path folder_;
};

Image small_image() {
  Image image(2, 1);
  image.pixels = {0.5f, 1, 2, 0.25f, 4, 8};
  return image;
}

TEST_F(Load, SavesAndLoadsEachFlatFormat) {
  for (const char* name : {"a.hdr", "a.PIC", "a.exr"}) {
    Image image = small_image();
    image.pixels[3] = 0.125f;  // 8 / 64: exact in RGBE beside 8
    save_image(path(name), image);
    EXPECT_EQ(load_image(path(name)).flat.pixels, image.pixels) << name;
  }
  save_image(path("a.png"), small_image());
  EXPECT_EQ(load_image(path("a.png")).flat.width, 2);
}

TEST_F(Load, GoesByTheFirstBytesNotByTheName) {
  write_file(path("exr.hdr"), encode_exr(small_image()));
  EXPECT_EQ(load_image(path("exr.hdr")).format, "OpenEXR");
  write_file(path("hdr.png"), encode_hdr(small_image()));
  EXPECT_EQ(load_image(path("hdr.png")).format, "Radiance HDR");
  write_file(path("png"), encode_png(ByteImage(1, 1)));
  EXPECT_EQ(load_image(path("png")).format, "PNG");
}

TEST_F(Load, ErrorsNameTheFile) {
  const auto load = [](const std::filesystem::path& p) {
    return refusal({}, [&](std::span<const std::uint8_t>) { load_image(p); });
  };
  write_file(path("text.hdr"), std::string("hello"));
  EXPECT_EQ(load(path("text.hdr")),
            path("text.hdr").string() + ": not an image that can be read (HDR, EXR, PNG, JPEG, KTX2, DDS)");
  EXPECT_TRUE(load(path("missing.hdr")).starts_with(path("missing.hdr").string() + ": "));
  write_file(path("cut.hdr"), std::string("#?RADIANCE\n"));
  EXPECT_TRUE(load(path("cut.hdr")).starts_with(path("cut.hdr").string() + ": "));
}

TEST_F(Load, OtherExtensionsAreRefusedAndWriteNothing) {
  const std::string message =
      refusal({}, [&](std::span<const std::uint8_t>) { save_image(path("a.tga"), small_image()); });
  EXPECT_TRUE(message.starts_with(path("a.tga").string() + ": ")) << message;
  EXPECT_FALSE(std::filesystem::exists(path("a.tga")));
}

// A link stays a link and what it points to is replaced; a device is written to, not replaced.
TEST_F(Load, LinksAndDevicesStayWhatTheyAre) {
  write_file(path("target"), std::string("old"));
  std::filesystem::create_symlink(path("target"), path("link"));
  write_file(path("link"), std::string("new"));
  EXPECT_TRUE(std::filesystem::is_symlink(path("link")));
  EXPECT_EQ(read_file(path("target")), (std::vector<std::uint8_t>{'n', 'e', 'w'}));
  EXPECT_THROW(write_file("/dev/full", std::string("x")), Error);
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

// What an earlier process of the same number left behind is neither in the way nor ours to remove.
TEST_F(Load, StaleTemporaryFilesAreLeftAlone) {
  const std::string stem = path("a.hdr").string() + ".part-" + std::to_string(::getpid()) + "-";
  for (int serial = 0; serial < 100; ++serial) std::ofstream(stem + std::to_string(serial)) << "not ours";
  write_file(path("a.hdr"), std::string("ours"));
  const std::vector<OutputFile> set{{path("a.hdr"), {1, 2}}, {path("b.hdr"), {3}}};
  write_files(set);
  EXPECT_EQ(std::filesystem::file_size(path("a.hdr")), 2u);
  const auto count = std::distance(std::filesystem::directory_iterator(path("")), {});
  EXPECT_EQ(count, 100 + 2);
}

TEST(DecodeImage, TakesCubesToo) {
  const std::string ktx2("\xabKTX 20\xbb\r\n\x1a\n", 12), dds("DDS ");
  for (const std::string& magic : {ktx2, dds}) {
    const std::vector<std::uint8_t> bytes(magic.begin(), magic.end());
    const std::string message =
        refusal(bytes, [](std::span<const std::uint8_t> b) { decode_image(b, "cube"); });
    EXPECT_TRUE(message.starts_with("cube: ")) << message;
    EXPECT_EQ(message.find("not an image"), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace welkin

#include <unistd.h>

#include <cmath>
#include <functional>
#include <limits>

#include "command_test.h"

#include <welkin/image/codecs/exr.h>
#include <welkin/image/codecs/hdr.h>
#include <welkin/image/codecs/ktx2.h>
#include <welkin/image/output_file.h>

// Whatever is wrong with a file, an output or an option: one line that names it, the right exit code, and no file that
// was not there before.

namespace welkin {
namespace {

using BadInputTest = CommandTest;
using Arguments = std::vector<std::string>;

// Every way to hand a file to the command.
const std::vector<std::function<Arguments(const std::string&)>> readers{
    [](const std::string& f) {
      return Arguments{"info", f};
    },
    [](const std::string& f) { return Arguments{"ibl", f, "-o", "set", "--size", "4"}; },
    [](const std::string& f) {
      return Arguments{"sh", f, "--json", "result.json"};
    },
    [](const std::string& f) {
      return Arguments{"convert", f, "-o", "result.exr"};
    },
    [](const std::string& f) {
      return Arguments{"compare", f, "good.hdr", "--diff", "result.png"};
    },
    [](const std::string& f) {
      return Arguments{"compare", "good.hdr", f, "--diff", "result.png"};
    }};

std::string bytes_of(const std::vector<std::uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

Image small_map() {
  Image image(16, 8);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = 0.1f * static_cast<float>(i % 37);
  return image;
}

class BadFileTest : public CommandTest {
 protected:
  BadFileTest() { write_text(at("good.hdr"), bytes_of(encode_hdr(small_map()))); }

  // Exactly one line, which names the file; exit code 1; every file as it was.
  void expect_refused(const Arguments& arguments, const std::string& named,
                      std::uint64_t file_limit = 0) const {
    const auto before = files_below(at(""));
    const RunResult result = run(arguments, file_limit);
    const std::string all = testing::PrintToString(arguments);
    EXPECT_EQ(result.exit_code, 1) << all << result.err;
    EXPECT_EQ(line_count(result.err), 1u) << all << result.err;
    EXPECT_NE(result.err.find(named), std::string::npos) << all << result.err;
    EXPECT_TRUE(result.err.starts_with("welkin: ")) << all << result.err;
    EXPECT_TRUE(files_below(at("")) == before) << all;
    EXPECT_FALSE(std::filesystem::exists(at("set"))) << all;
  }
  void expect_unreadable(const std::string& name) const {
    for (const auto& reader : readers) expect_refused(reader(name), name);
  }
};

TEST_F(BadFileTest, TheGoodFileIsGood) { run_well({"info", "good.hdr"}); }

TEST_F(BadFileTest, MissingEmptyAndDirectory) {
  write_text(at("empty.hdr"), "");
  std::filesystem::create_directory(at("folder.hdr"));
  for (const char* name : {"missing.hdr", "empty.hdr", "folder.hdr"}) expect_unreadable(name);
}

TEST_F(BadFileTest, WrongMagicAndSizesInHeaders) {
  write_text(at("noise.hdr"), "not a picture at all, but text that goes on for a while and then some");
  write_text(at("zero.hdr"), "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 0 +X 0\n");
  write_text(at("huge.hdr"), "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 100000 +X 100000\n1234");
  std::string texture = bytes_of(encode_ktx2(CubeMips{{Cube(4)}}).bytes);
  for (std::size_t i = 20; i < 28; ++i) texture[i] = '\0';  // pixelWidth and pixelHeight
  write_text(at("zero.ktx2"), texture);
  for (std::size_t i : {20, 24}) texture.replace(i, 4, "\xa0\x86\x01", 4);  // 100,000
  write_text(at("huge.ktx2"), texture);
  for (const char* name : {"noise.hdr", "zero.hdr", "huge.hdr", "zero.ktx2", "huge.ktx2"})
    expect_unreadable(name);
}

TEST_F(BadFileTest, TruncatedAnywhere) {
  const std::string whole = read_text(at("good.hdr"));
  for (std::size_t i = 0; i < 20; ++i) {
    write_text(at("cut.hdr"), whole.substr(0, whole.size() * i / 20));
    expect_refused({"info", "cut.hdr"}, "cut.hdr");
  }
  write_text(at("cut.hdr"), whole.substr(0, whole.size() - 1));
  expect_unreadable("cut.hdr");
}

TEST_F(BadFileTest, ProportionsThatSayNothing) {
  write_file(at("odd.exr"), encode_exr(Image(7, 5)));
  for (std::size_t i = 0; i < 4; ++i)
    expect_refused(readers[i]("odd.exr"), "odd.exr");  // compare takes any picture
  expect_refused({"convert", "odd.exr", "--from", "octahedral", "-o", "result.exr"}, "odd.exr");
  expect_refused({"convert", "odd.exr", "--from", "cube", "-o", "result.exr"}, "odd.exr");
}

TEST_F(BadFileTest, ABlackMap) {
  write_file(at("black.exr"), encode_exr(Image(16, 8)));
  for (std::size_t i = 0; i < 3; ++i) expect_refused(readers[i]("black.exr"), "black.exr");
}

TEST_F(BadFileTest, FaultsAreRepairedOrRefused) {
  Image image = small_map();
  image.pixels[5] = std::nanf("");
  image.pixels[6] = image.pixels[7] = std::numeric_limits<float>::infinity();
  image.pixels[8] = image.pixels[9] = image.pixels[10] = -1;
  write_file(at("faulty.exr"), encode_exr(image, {ExrPixelType::single_float, 1}));
  for (std::size_t i = 0; i < 4; ++i) {
    Arguments arguments = readers[i]("faulty.exr");
    arguments.insert(arguments.end(), {"--faults", "refuse"});
    expect_refused(arguments, "faulty.exr");
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const RunResult result = run(readers[i]("faulty.exr"));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "welkin: faulty.exr: warning: repaired 1 NaN, 2 infinite and 3 negative values\n");
  }
  run_well({"info", "result.exr", "--faults", "refuse"});
  EXPECT_EQ(json("set/manifest.json")["input"]["faults"]["infinite"], 2);
}

TEST_F(BadFileTest, ComparesOnlyWhatFitsTogether) {
  run_well({"sky", "--kind", "constant", "--size", "8x4", "-o", "small.hdr"});
  expect_refused({"compare", "small.hdr", "good.hdr"}, "small.hdr");
  run_well({"convert", "good.hdr", "--to", "cube", "-o", "cube.ktx2"});
  expect_refused({"compare", "good.hdr", "cube.ktx2"}, "cube.ktx2");
}

TEST_F(BadFileTest, SixFacesThatAreNot) {
  expect_refused({"convert", "face_%s.hdr", "-o", "result.exr"}, "face_%s.hdr");
  write_text(at("face_px.hdr"), read_text(at("good.hdr")));
  expect_refused({"convert", "face_%s.hdr", "-o", "result.exr"}, "face_nx.hdr");
  for (const char* face : {"nx", "py", "ny", "pz", "nz"})
    write_text(at(std::string("face_") + face + ".hdr"), read_text(at("good.hdr")));
  expect_refused({"convert", "face_%s.hdr", "-o", "result.exr"}, "face_%s.hdr");  // not square
}

// Every way to write, to the output of that name.
const std::vector<std::function<Arguments(const std::string&)>> writers{
    [](const std::string& f) { return Arguments{"ibl", "good.hdr", "-o", f, "--size", "8"}; },
    [](const std::string& f) {
      return Arguments{"sky", "-o", f + ".hdr", "--size", "64x32"};
    },
    [](const std::string& f) { return Arguments{"convert", "good.hdr", "--size", "64", "-o", f + ".exr"}; },
    [](const std::string& f) {
      return Arguments{"convert", "good.hdr", "--to", "cube", "--size", "16", "-o", f + ".ktx2"};
    },
    [](const std::string& f) {
      return Arguments{"convert", "good.hdr", "--size", "16", "-o", f + "_%s.exr"};
    },
    [](const std::string& f) { return Arguments{"sh", "good.hdr", "--degree", "9", "--json", f + ".json"}; },
    [](const std::string& f) {
      return Arguments{"compare", "good.hdr", "other.hdr", "--diff", f + ".png"};
    }};

class BadOutputTest : public BadFileTest {
 protected:
  BadOutputTest() {
    run_well({"sky", "--kind", "studio", "--size", "16x8", "-o", "other.hdr"});
    write_text(at("file"), "precious");
  }
};

TEST_F(BadOutputTest, TheWritersWriteOtherwise) {
  for (const auto& writer : writers) run_well(writer("fine"));
  EXPECT_EQ(files_below(at("")).size(), 3u + 8 + 1 + 1 + 1 + 6 + 1 + 1);
}

TEST_F(BadOutputTest, FoldersThatCannotBe) {
  for (const auto& writer : writers) {
    expect_refused(writer("file/result"), "file/result");
    expect_refused(writer("/proc/nowhere/result"), "/proc/nowhere/result");
  }
  for (std::size_t i = 1; i < writers.size(); ++i)
    expect_refused(writers[i]("missing/result"), "missing/result");
  expect_refused(writers[0]("file"), "file");
}

TEST_F(BadOutputTest, AFolderWhereTheFileShouldBe) {
  for (const char* name :
       {"result.hdr", "result.exr", "result.ktx2", "result_nz.exr", "result.json", "result.png"})
    std::filesystem::create_directory(at(name));
  std::filesystem::create_directories(at("result/manifest.json"));
  for (const auto& writer : writers) expect_refused(writer("result"), "result");
}

// Found before the input is even opened: nobody waits for a set that cannot be written.
TEST_F(BadOutputTest, AFolderThatCannotBeIsFoundBeforeTheWork) {
  expect_refused({"ibl", "missing.hdr", "-o", "file/deep/result"}, "file/deep/result");
}

TEST_F(BadOutputTest, AReadOnlyFolderIsFoundBeforeTheWork) {
  std::filesystem::create_directory(at("locked"));
  std::filesystem::permissions(at("locked"),
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  for (const char* output : {"locked", "locked/deep/result"}) {
    const RunResult result = run_obeying_permissions({"ibl", "missing.hdr", "-o", output});
    EXPECT_EQ(result.exit_code, 1) << result.err;
    EXPECT_EQ(line_count(result.err), 1u) << result.err;
    EXPECT_NE(result.err.find(std::string(output) + ": "), std::string::npos) << result.err;
  }
  const RunResult writer = run_obeying_permissions({"sky", "-o", "locked/a.hdr", "--size", "8x4"});
  EXPECT_EQ(writer.exit_code, 1) << writer.err;
  EXPECT_NE(writer.err.find("locked/a.hdr: cannot write"), std::string::npos) << writer.err;
  EXPECT_TRUE(files_below(at("locked")).empty());
}

// A limit on the size of files fails as a full disk does: the write comes back with an error. 200 bytes are less than
// every output here, and enough for a message.
TEST_F(BadOutputTest, FullDisk) {
  for (const auto& writer : writers) expect_refused(writer("result"), "result", 200);
  std::filesystem::create_directory(at("result"));
  for (const char* name : {"result/specular.ktx2", "result/manifest.json", "result.hdr", "result.exr",
                           "result.ktx2", "result_px.exr", "result.json", "result.png"})
    write_text(at(name), "precious");
  for (const auto& writer : writers) expect_refused(writer("result"), "result", 200);
  expect_refused({"ibl", "good.hdr", "-o", "a/b/c", "--size", "8"}, "a/b/c", 200);
  EXPECT_FALSE(std::filesystem::exists(at("a")));
}

TEST_F(BadOutputTest, NamesThatSayNoFormat) {
  expect_refused({"sky", "-o", "result.bmp"}, "result.bmp");
  expect_refused({"convert", "good.hdr", "-o", "result"}, "result");
  expect_refused({"convert", "good.hdr", "-o", "result_%s.ktx2"}, "result_%s.ktx2");
}

TEST_F(BadOutputTest, FullDiskBehindStandardOutput) {
  for (const Arguments& arguments : {Arguments{"info", "good.hdr"}, Arguments{"sh", "good.hdr"},
                                     Arguments{"compare", "good.hdr", "good.hdr"}}) {
    const RunResult result = run_welkin(arguments, {at(""), 0, false, "/dev/full"});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(result.err, "welkin: standard output: cannot write: No space left on device\n");
  }
}

TEST_F(BadInputTest, BadUsageExitsWithTwo) {
  const std::string sky = "sky:constant,size=16x8";
  const std::vector<Arguments> bad{
      {},
      {"bake"},
      {"info"},
      {"info", sky, "--nonsense"},
      {"info", sky, "--faults", "ignore"},
      {"--threads", "-1", "info", sky},
      {"--threads", "many", "info", sky},
      {"ibl", sky},
      {"ibl", sky, "-o", "set", "--size", "big"},
      {"ibl", sky, "-o", "set", "--size", "0"},
      {"ibl", sky, "-o", "set", "--size", "64", "--levels", "8"},
      {"ibl", sky, "-o", "set", "--levels", "-1"},
      {"ibl", sky, "-o", "set", "--kernel", "blinn"},
      {"ibl", sky, "-o", "set", "--zstd", "23"},
      {"ibl", sky, "-o", "set", "--container", "exr", "--format", "rgb9e5"},
      {"sh", sky, "--degree", "-1"},
      {"sky", "-o", "result.hdr", "--kind", "night"},
      {"sky", "-o", "result.hdr", "--size", "0x8"},
      {"sky", "-o", "result.hdr", "--turbidity", "99"},
      {"convert", "a.hdr", "-o", "result.hdr", "--mips"},
      {"convert", "a.hdr", "-o", "result_%s.hdr", "--layout", "hcross"},
      {"convert", "a.hdr", "-o", "result.hdr", "--to", "dodecahedral"},
      {"convert", "a.hdr", "-o", "result.hdr", "--rotate", "nan"},
      {"convert", "a.hdr", "-o", "result.hdr", "--rotate", "-inf"},
      {"info", sky, "--rotate", "nan"},
      {"ibl", sky, "-o", "set", "--rotate", "1e999"},
      {"info", sky, "--mapping", "dodecahedral"},
      {"sh", sky, "--mapping", "dodecahedral"},
      {"filter", sky, "-o", "result.exr", "--scale", "nan"},
      {"filter", sky, "-o", "result.exr", "--tolerance", "nan"},
      {"filter", sky, "-o", "result.exr", "--method", "box", "--box-bias", "nan"},
      {"filter", sky, "-o", "result.exr", "--method", "bordered", "--border", "nan"},
      {"filter", sky, "-o", "result.exr", "--method", "angular", "--cut", "nan"},
      {"filter", sky, "-o", "result.exr", "--method", "hierarchical", "--detail", "nan"},
      {"reflect", sky, "--brdf", "ggx:0.3", "--verify", "--error-bound", "nan"},
      {"compare", "a.hdr"}};
  for (const Arguments& arguments : bad) {
    const RunResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << testing::PrintToString(arguments) << result.err;
    EXPECT_EQ(line_count(result.err), 1u) << result.err;
    EXPECT_TRUE(result.err.starts_with("welkin: ")) << result.err;
    EXPECT_EQ(result.out, "");
  }
  EXPECT_TRUE(files_below(at("")).empty());
}

TEST_F(BadInputTest, BadUsageSaysWhereHelpIs) {
  const RunResult inside = run({"info", "sky:", "--nonsense"});
  EXPECT_TRUE(inside.err.ends_with(" (see welkin info --help)\n")) << inside.err;
  const RunResult outside = run({"bake"});
  EXPECT_TRUE(outside.err.ends_with(" (see welkin --help)\n")) << outside.err;
}

TEST_F(BadFileTest, SizesThatDoNotFitTheMapping) {
  for (const char* size : {"0", "x", "12x", "16x16x16", "3.5", "99999999999"})
    EXPECT_EQ(run({"convert", "good.hdr", "-o", "result.hdr", "--size", size}).exit_code, 2) << size;
  EXPECT_EQ(run({"convert", "good.hdr", "-o", "r.hdr", "--to", "octahedral", "--size", "16x8"}).exit_code, 2);
  EXPECT_EQ(run({"convert", "good.hdr", "-o", "r.ktx2", "--to", "cube", "--size", "90000"}).exit_code, 2);
  EXPECT_EQ(run({"convert", "good.hdr", "-o", "r.hdr", "--layout", "six", "--to", "octahedral"}).exit_code,
            2);
  EXPECT_EQ(files_below(at("")).size(), 1u);
}

TEST_F(BadInputTest, SkiesThatAreNot) {
  for (const std::string input : {"sky:night", "sky:day,size=0x0", "sky:day,elevation=high"}) {
    const RunResult result = run({"info", input});
    EXPECT_EQ(result.exit_code, 1) << input;
    EXPECT_EQ(line_count(result.err), 1u) << result.err;
  }
}

}  // namespace
}  // namespace welkin

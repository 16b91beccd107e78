#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "run_command.h"

namespace welkin {

/// A test with a fresh folder, in which the command runs.
class CommandTest : public testing::Test {
 protected:
  using Arguments = std::vector<std::string>;

  std::filesystem::path at(const std::string& name) const { return folder_.path() / name; }
  RunResult run(const Arguments& arguments) const {
    return run_welkin(arguments, {folder_.path(), 0, false, ""});
  }
  RunResult run(const Arguments& arguments, std::uint64_t file_limit) const {
    return run_welkin(arguments, {folder_.path(), file_limit, false, ""});
  }
  RunResult run_obeying_permissions(const Arguments& arguments) const {
    return run_welkin(arguments, {folder_.path(), 0, true, ""});
  }
  /// Runs what has to work, without a word on standard error; returns standard output.
  std::string run_well(const Arguments& arguments) const {
    const RunResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    return result.out;
  }
  /// One line on standard error with `why` in it, this exit code, nothing on standard output, and all files as they were.
  void expect_refused(const Arguments& arguments, int exit_code, const std::string& why) const {
    const auto before = files_below(at(""));
    const RunResult result = run(arguments);
    const std::string all = testing::PrintToString(arguments);
    EXPECT_EQ(result.exit_code, exit_code) << all << result.err;
    EXPECT_EQ(line_count(result.err), 1u) << all << result.err;
    EXPECT_NE(result.err.find(why), std::string::npos) << all << result.err;
    EXPECT_EQ(result.out, "") << all;
    EXPECT_TRUE(files_below(at("")) == before) << all;
  }
  nlohmann::json json(const std::string& name) const { return nlohmann::json::parse(read_text(at(name))); }

 private:
  TemporaryFolder folder_;
};

}  // namespace welkin

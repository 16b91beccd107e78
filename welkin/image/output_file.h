#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace welkin {

/// Reads a whole file. Throws Error naming the file when it is missing, a directory, unreadable or empty.
std::vector<std::uint8_t> read_file(const std::filesystem::path& path);

/// Writes `bytes` beside `path` under a temporary name and renames it when it is whole, so that a full disk or a
/// killed run never leaves a broken file at `path` (an earlier file of that name stays until then). The temporary
/// file is removed on failure. Throws Error naming `path` when the folder is missing or read-only or the disk is full.
void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);
void write_file(const std::filesystem::path& path, const std::string& text);

/// A file that is to be written.
struct OutputFile {
  std::filesystem::path path;
  std::vector<std::uint8_t> bytes;
};

/// Writes a set of files: all under temporary names first, renamed only when every one of them is whole. So a failure
/// (Error naming the file) or a kill while writing leaves what was there before. Devices and pipes get their bytes before
/// the renames.
void write_files(std::span<const OutputFile> files);

/// Removes the temporary files of writes that are under way; async-signal-safe, meant for a SIGINT handler.
void remove_unfinished_files() noexcept;

}  // namespace welkin

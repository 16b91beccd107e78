#include <welkin/image/output_file.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <deque>
#include <fstream>

#include <welkin/error.h>

namespace welkin {
namespace {

// Names of files being written, in storage that a signal handler may read: a slot is claimed, filled, then
// published through `active`.
constexpr std::size_t slot_count = 64;
struct Slot {
  std::atomic<bool> claimed{false};
  std::atomic<bool> active{false};
  char path[4096] = {};
};
std::array<Slot, slot_count> slots;

[[noreturn]] void fail(const std::filesystem::path& path, const char* what, int error_number) {
  throw Error(path.string(), std::string(what) + ": " + std::strerror(error_number));
}

class UnfinishedFile {
 public:
  explicit UnfinishedFile(const std::string& path) : path_(path) {
    for (Slot& slot : slots) {
      if (path.size() >= sizeof slot.path || slot.claimed.exchange(true)) continue;
      std::memcpy(slot.path, path.c_str(), path.size() + 1);
      slot.active = true;
      slot_ = &slot;
      return;
    }
  }
  ~UnfinishedFile() {
    if (!finished_) ::unlink(path_.c_str());
    if (!slot_) return;
    slot_->active = false;
    slot_->claimed = false;
  }
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;
  const std::string& path() const { return path_; }
  void rename_to(const std::filesystem::path& path) {
    if (::rename(path_.c_str(), path.c_str()) != 0) fail(path, "cannot write", errno);
    finished_ = true;
  }

 private:
  std::string path_;
  Slot* slot_ = nullptr;
  bool finished_ = false;
};

std::string temporary_name(const std::filesystem::path& path) {
  static std::atomic<unsigned> serial{0};
  return path.string() + ".part-" + std::to_string(::getpid()) + "-" + std::to_string(serial++);
}

void write_all(int file, std::span<const std::uint8_t> bytes, const std::filesystem::path& path) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(path, "cannot write", errno);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void fill(const UnfinishedFile& unfinished, const std::filesystem::path& path,
          std::span<const std::uint8_t> bytes) {
  const int file = ::open(unfinished.path().c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file < 0) fail(path, "cannot write", errno);
  try {
    write_all(file, bytes, path);
  } catch (...) {
    ::close(file);
    throw;
  }
  if (::close(file) != 0) fail(path, "cannot write", errno);
}

}  // namespace

std::vector<std::uint8_t> read_file(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) throw Error(path.string(), "is a directory, not a file");
  std::ifstream stream(path, std::ios::binary | std::ios::ate);
  if (!stream) fail(path, "cannot open", errno);
  const std::streamoff size = stream.tellg();
  if (size < 0) fail(path, "cannot read", errno);
  if (size == 0) throw Error(path.string(), "is empty");
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
  stream.seekg(0);
  stream.read(reinterpret_cast<char*>(bytes.data()), size);
  if (stream.gcount() != size) fail(path, "cannot read", errno);
  return bytes;
}

void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
  UnfinishedFile unfinished(temporary_name(path));
  fill(unfinished, path, bytes);
  unfinished.rename_to(path);
}

void write_files(std::span<const OutputFile> files) {
  std::deque<UnfinishedFile> unfinished;
  for (const OutputFile& file : files)
    fill(unfinished.emplace_back(temporary_name(file.path)), file.path, file.bytes);
  // Renaming onto a folder fails: found out before the first file is replaced, not at the last.
  std::error_code ignored;
  for (const OutputFile& file : files)
    if (std::filesystem::is_directory(file.path, ignored)) fail(file.path, "cannot write", EISDIR);
  for (std::size_t i = 0; i < files.size(); ++i) unfinished[i].rename_to(files[i].path);
}

void write_file(const std::filesystem::path& path, const std::string& text) {
  write_file(path, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

void remove_unfinished_files() noexcept {
  for (const Slot& slot : slots)
    if (slot.active) ::unlink(slot.path);
}

}  // namespace welkin

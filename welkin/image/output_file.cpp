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
#include <utility>

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

// A temporary file beside `path`, open for writing under a name that nothing had. What is left under that name goes
// with this object unless it was renamed.
class UnfinishedFile {
 public:
  explicit UnfinishedFile(const std::filesystem::path& path) {
    create(path);
    for (Slot& slot : slots) {
      if (path_.size() >= sizeof slot.path || slot.claimed.exchange(true)) continue;
      std::memcpy(slot.path, path_.c_str(), path_.size() + 1);
      slot.active = true;
      slot_ = &slot;
      return;
    }
  }
  ~UnfinishedFile() {
    if (file_ >= 0) ::close(file_);
    if (!finished_) ::unlink(path_.c_str());
    if (!slot_) return;
    slot_->active = false;
    slot_->claimed = false;
  }
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;
  int file() const { return file_; }
  int close() { return ::close(std::exchange(file_, -1)); }
  void rename_to(const std::filesystem::path& path) {
    if (::rename(path_.c_str(), path.c_str()) != 0) fail(path, "cannot write", errno);
    finished_ = true;
  }

 private:
  // An earlier process of the same number may have left names behind: not ours, so the next serial is taken.
  void create(const std::filesystem::path& path) {
    static std::atomic<unsigned> serial{0};
    do {
      path_ = path.string() + ".part-" + std::to_string(::getpid()) + "-" + std::to_string(serial++);
      file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (file_ < 0 && errno == EEXIST);
    if (file_ < 0) fail(path, "cannot write", errno);
  }
  std::string path_;
  int file_ = -1;
  Slot* slot_ = nullptr;
  bool finished_ = false;
};

void write_all(int file, std::span<const std::uint8_t> bytes, const std::filesystem::path& path) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(path, "cannot write", errno);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void fill(UnfinishedFile& unfinished, const std::filesystem::path& path,
          std::span<const std::uint8_t> bytes) {
  write_all(unfinished.file(), bytes, path);
  if (unfinished.close() != 0) fail(path, "cannot write", errno);
}

// A link stays a link: what it points to is replaced.
std::filesystem::path behind_links(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_symlink(path, error)) return path;
  const std::filesystem::path target = std::filesystem::canonical(path, error);
  return error ? path : target;
}

bool is_device(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
         !std::filesystem::is_directory(status);
}

// A device or a pipe is never replaced by a file: bytes go into it.
void write_through(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (file < 0) fail(path, "cannot write", errno);
  try {
    write_all(file, bytes, path);
  } catch (...) {
    ::close(file);
    throw;
  }
  ::close(file);
}

// A pipe has no size beforehand.
std::vector<std::uint8_t> read_pipe(const std::filesystem::path& path) {
  constexpr std::size_t block = 1 << 20, most = std::size_t{4} << 30;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) fail(path, "cannot open", errno);
  std::vector<std::uint8_t> bytes;
  while (stream) {
    const std::size_t before = bytes.size();
    if (before >= most) throw Error(path.string(), "is a pipe with more than 4 GiB");
    bytes.resize(before + block);
    stream.read(reinterpret_cast<char*>(bytes.data() + before), block);
    bytes.resize(before + static_cast<std::size_t>(stream.gcount()));
  }
  if (bytes.empty()) throw Error(path.string(), "is empty");
  return bytes;
}

}  // namespace

std::vector<std::uint8_t> read_file(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) throw Error(path.string(), "is a directory, not a file");
  if (std::filesystem::is_fifo(path, error)) return read_pipe(path);
  std::ifstream stream(path, std::ios::binary | std::ios::ate);
  if (!stream) fail(path, "cannot open", errno);
  const std::streamoff size = stream.tellg();
  if (size < 0) fail(path, "cannot read", errno);
  if (size == 0) throw Error(path.string(), "is empty");
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
  stream.seekg(0);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (stream.gcount() != size) fail(path, "cannot read", errno);
  return bytes;
}

void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
  if (is_device(path)) return write_through(path, bytes);
  const std::filesystem::path target = behind_links(path);
  UnfinishedFile unfinished(target);
  fill(unfinished, path, bytes);
  unfinished.rename_to(target);
}

void write_files(std::span<const OutputFile> files) {
  std::deque<UnfinishedFile> unfinished;
  std::vector<std::filesystem::path> targets;
  for (const OutputFile& file : files) {
    if (is_device(file.path)) continue;
    targets.push_back(behind_links(file.path));
    fill(unfinished.emplace_back(targets.back()), file.path, file.bytes);
  }
  // Renaming onto a folder fails: found out before the first file is replaced, not at the last.
  std::error_code ignored;
  for (const OutputFile& file : files)
    if (std::filesystem::is_directory(file.path, ignored)) fail(file.path, "cannot write", EISDIR);
  for (const OutputFile& file : files)
    if (is_device(file.path)) write_through(file.path, file.bytes);
  for (std::size_t i = 0; i < targets.size(); ++i) unfinished[i].rename_to(targets[i]);
}

void write_file(const std::filesystem::path& path, const std::string& text) {
  write_file(path, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

void remove_unfinished_files() noexcept {
  for (const Slot& slot : slots)
    if (slot.active) ::unlink(slot.path);
}

}  // namespace welkin

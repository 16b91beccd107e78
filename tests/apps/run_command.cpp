#include "run_command.h"

#include <fcntl.h>
#include <linux/capability.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace welkin {
namespace {

// What the child needs, made before fork: after it only calls that are safe in a copy of a threaded process.
struct Launch {
  std::vector<std::string> words;
  std::vector<char*> argv;
  std::string folder;
  int out = -1, err = -1;
  rlim_t file_limit = 0;
  bool obey_permissions = false;
};

Launch prepare(const std::vector<std::string>& arguments, const std::filesystem::path& folder) {
  Launch launch;
  launch.words = {WELKIN_COMMAND};
  launch.words.insert(launch.words.end(), arguments.begin(), arguments.end());
  launch.folder = folder.string();
  return launch;
}

pid_t start(Launch& launch) {
  for (std::string& word : launch.words) launch.argv.push_back(word.data());
  launch.argv.push_back(nullptr);
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child > 0) return child;
  const rlimit limit{launch.file_limit, launch.file_limit};
  if (launch.file_limit > 0 && ::setrlimit(RLIMIT_FSIZE, &limit) != 0) ::_exit(126);
  // Without these capabilities root is refused by permissions as anyone is; for others there is nothing to drop.
  for (int capability : {CAP_DAC_OVERRIDE, CAP_DAC_READ_SEARCH})
    if (launch.obey_permissions && ::geteuid() == 0 && ::prctl(PR_CAPBSET_DROP, capability) != 0)
      ::_exit(126);
  const bool ready =
      ::chdir(launch.folder.c_str()) == 0 && ::dup2(launch.out, 1) == 1 && ::dup2(launch.err, 2) == 2;
  if (ready) ::execv(launch.argv[0], launch.argv.data());
  ::_exit(127);
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "welkin-command-XXXXXX").string();
  if (!::mkdtemp(pattern.data())) throw std::runtime_error("cannot make " + pattern);
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code error;
  std::filesystem::remove_all(path_, error);
}

int wait_for(pid_t process) {
  int status = 0;
  if (::waitpid(process, &status, 0) != process) throw std::runtime_error("waitpid failed");
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

RunResult run_welkin(const std::vector<std::string>& arguments, const RunOptions& options) {
  const TemporaryFolder captured;
  Launch launch = prepare(arguments, options.folder);
  launch.file_limit = options.file_limit;
  launch.obey_permissions = options.obey_permissions;
  const std::string out =
      options.standard_output.empty() ? (captured.path() / "out").string() : options.standard_output;
  launch.out = ::open(out.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  launch.err = ::open((captured.path() / "err").c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  if (launch.out < 0 || launch.err < 0) throw std::runtime_error("cannot capture output");
  RunResult result;
  result.exit_code = wait_for(start(launch));
  ::close(launch.out);
  ::close(launch.err);
  if (options.standard_output.empty()) result.out = read_text(captured.path() / "out");
  result.err = read_text(captured.path() / "err");
  return result;
}

pid_t start_welkin(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                   int output) {
  Launch launch = prepare(arguments, folder);
  launch.out = launch.err = output;
  return start(launch);
}

std::string read_text(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw std::runtime_error("cannot read " + path.string());
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream stream(path, std::ios::binary);
  stream << text;
  if (!stream.flush()) throw std::runtime_error("cannot write " + path.string());
}

std::map<std::string, std::string> files_below(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files[entry.path().lexically_relative(folder).string()] = read_text(entry.path());
  return files;
}

std::size_t line_count(const std::string& text) {
  const auto ends = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  return ends + (!text.empty() && text.back() != '\n' ? 1 : 0);
}

}  // namespace welkin

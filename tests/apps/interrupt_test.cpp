#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

#include "command_test.h"

// Ctrl-C and the progress line: on a pseudo-terminal as a user has it, and piped as a script has it.

namespace welkin {
namespace {

using namespace std::chrono_literals;
using std::chrono::steady_clock;

// Minutes of work on any machine: it never ends by itself in a test. Filtering alone takes seconds, and says often how
// far it is; verification, which is most of the work, says so only level by level.
const std::vector<std::string> long_job{"ibl",      "sky:day,size=1024x512", "-o",    "set", "--size", "1024",
                                        "--verify", "--verify-directions",   "100000"};

// A pseudo-terminal: what the command prints comes out of `ours`.
struct Terminal {
  int ours = -1, theirs = -1;
  Terminal() {
    ours = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (ours < 0 || ::grantpt(ours) != 0 || ::unlockpt(ours) != 0)
      throw std::runtime_error("no pseudo-terminal");
    theirs = ::open(::ptsname(ours), O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (theirs < 0) throw std::runtime_error("cannot open the pseudo-terminal");
  }
  ~Terminal() {
    ::close(ours);
    ::close(theirs);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
};

// Appends what comes until it contains `wanted` or the time is over.
bool read_until(int file, const std::string& wanted, std::chrono::seconds limit, std::string& text) {
  const auto end = steady_clock::now() + limit;
  while (text.find(wanted) == std::string::npos) {
    if (steady_clock::now() > end) return false;
    pollfd poll{file, POLLIN, 0};
    if (::poll(&poll, 1, 100) <= 0) continue;
    char buffer[4096];
    const ssize_t count = ::read(file, buffer, sizeof buffer);
    if (count <= 0) return false;
    text.append(buffer, static_cast<std::size_t>(count));
  }
  return true;
}

class InterruptTest : public CommandTest {};

// The same job on a terminal and piped, side by side: what the one shows, the other must not have shown in more time.
TEST_F(InterruptTest, ProgressOnATerminalOnlyUntilCtrlC) {
  const Terminal terminal;
  const int file = ::open(at("output.txt").c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  const pid_t piped = start_welkin(long_job, at(""), file);
  const pid_t process = start_welkin(long_job, at(""), terminal.theirs);
  std::string shown;
  // It starts after half a second; the rest is for busy machines and sanitizers.
  EXPECT_TRUE(read_until(terminal.ours, " s left", 60s, shown)) << shown;
  EXPECT_NE(shown.find(" %, "), std::string::npos) << shown;
  EXPECT_NE(shown.find("filtering sky:"), std::string::npos) << shown;
  ::kill(process, SIGINT);
  EXPECT_EQ(wait_for(process), 130);
  std::this_thread::sleep_for(1s);
  ::kill(piped, SIGTERM);
  EXPECT_EQ(wait_for(piped), 143);
  ::close(file);
  const auto files = files_below(at(""));
  EXPECT_EQ(files.size(), 1u);
  EXPECT_EQ(files.at("output.txt"), "");
}

// The state of a process as waitpid has it once it has ended.
int end_state(pid_t process) {
  int status = 0;
  EXPECT_EQ(::waitpid(process, &status, 0), process);
  return status;
}

// A closed terminal: the command ends itself, after it has cleaned up, rather than being ended.
TEST_F(InterruptTest, HangUpIsHandled) {
  const int ignored = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  const pid_t process = start_welkin(long_job, at(""), ignored);
  std::this_thread::sleep_for(1s);
  ::kill(process, SIGHUP);
  const int status = end_state(process);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 129);
  ::close(ignored);
}

// nohup, and a shell's jobs in the background: what they ignore stays ignored.
TEST_F(InterruptTest, IgnoredSignalsStayIgnored) {
  const int ignored = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  std::signal(SIGHUP, SIG_IGN);
  std::signal(SIGINT, SIG_IGN);
  const pid_t process = start_welkin(long_job, at(""), ignored);
  std::signal(SIGHUP, SIG_DFL);
  std::signal(SIGINT, SIG_DFL);
  std::this_thread::sleep_for(1s);
  ::kill(process, SIGHUP);
  ::kill(process, SIGINT);
  std::this_thread::sleep_for(500ms);
  ::kill(process, SIGTERM);
  const int status = end_state(process);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 143);
  ::close(ignored);
}

// Whenever it comes, also while files are written: all of the set is there or nothing is, or, in the instant of the
// renaming, some of its files; never part of one, never a temporary.
TEST_F(InterruptTest, NeverPartOfAFile) {
  const std::vector<std::string> job{"ibl",
                                     "sky:studio,size=32x16",
                                     "-o",
                                     "set",
                                     "--size",
                                     "128",
                                     "--irradiance-size",
                                     "128",
                                     "--dfg-size",
                                     "256",
                                     "--format",
                                     "rgba32f"};
  run_well(job);
  const auto whole = files_below(at("set"));
  const int ignored = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  int stopped = 0;
  for (int step = 0; step < 8; ++step) {
    std::filesystem::remove_all(at("set"));
    const pid_t process = start_welkin(job, at(""), ignored);
    std::this_thread::sleep_for(80ms * (step + 1));
    ::kill(process, SIGINT);
    const int code = wait_for(process);
    EXPECT_TRUE(code == 0 || code == 130) << code;
    stopped += code != 0;
    for (const auto& [name, bytes] : files_below(at(""))) {
      const std::string inside = name.substr(name.find('/') + 1);
      ASSERT_TRUE(whole.contains(inside)) << name;
      const bool timed = inside == "manifest.json" || inside == "index.html";
      EXPECT_TRUE(timed ? !bytes.empty() : bytes == whole.at(inside)) << name;
    }
  }
  EXPECT_GT(stopped, 0);
  ::close(ignored);
}

}  // namespace
}  // namespace welkin

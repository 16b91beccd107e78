#pragma once
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <welkin/realtime/technique.h>

namespace welkin {

enum class LoadKind { scene, environment };

/// Whether a file is a scene or an environment, by its name: scenes by their endings, everything else is an environment.
LoadKind kind_of(const std::string& file);

/// What came of a request: one of the three.
struct Loaded {
  LoadKind kind = LoadKind::scene;
  std::string name;
  std::optional<Scene> scene;
  std::shared_ptr<const EnvironmentData> light;
  std::string error;  ///< one line
  std::vector<std::string> warnings;
};

/// Reads and filters files in a thread of its own, so that the window stays alive. A newer request takes the place of one of its kind that is not
/// done.
class Loader {
 public:
  explicit Loader(int map_size);
  ~Loader();
  Loader(const Loader&) = delete;
  Loader& operator=(const Loader&) = delete;

  /// A file, a built-in scene or "sky:...".
  void request(LoadKind kind, std::string name);
  /// What is done, in the order in which it was asked for; nothing while there is none.
  std::optional<Loaded> take();

  struct Work {
    std::string text;  ///< "filtering park.hdr"
    double share = 0;
  };
  /// What is being done.
  std::optional<Work> work() const;

 private:
  struct Request {
    LoadKind kind = LoadKind::scene;
    std::string name;
  };
  void run();
  Loaded load(const Request& request);
  void note(const std::string& text, double share);

  const int map_size_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Request> requests_;
  std::deque<Loaded> done_;
  std::optional<Work> work_;
  std::optional<LoadKind> running_;
  bool cancel_ = false, stop_ = false;
  std::thread thread_;  // last: everything else is there when it starts
};

}  // namespace welkin

#pragma once
#include <string>

#include <welkin/realtime/viewer/viewer.h>

#include "loader.h"
#include "truth_tracer.h"
#include "view_options.h"

namespace welkin {

/// What the window shows, without the window: what is loaded, drawn and traced, and what there is to say about it.
class Session {
 public:
  /// Needs a current context. Begins to load.
  explicit Session(const ViewOptions& options);

  Viewer viewer;

  void load(LoadKind kind, const std::string& name);
  /// A file that was dropped.
  void drop(const std::string& file) { load(kind_of(file), file); }
  /// Takes what was loaded and traced, draws if anything changed. `width` and `height` of the picture, pixels. True: the
  /// picture is another one than before.
  bool update(int width, int height, double seconds);
  /// Writes the picture beside where the program was started, under a name that is free.
  void save_picture();

  struct Message {
    std::string text;  ///< one line
    bool is_error = false;
    double seconds_left = 0;
  };
  const Message& message() const { return message_; }
  void say(std::string text, bool is_error);
  bool had_error() const { return had_error_; }
  const std::string& first_error() const { return first_error_; }

  std::optional<Loader::Work> work() const { return loader_.work(); }
  /// Everything that was asked for is there or was refused: scene, light, picture, and all samples of a truth that is shown.
  bool is_settled() const;

  struct TruthStatus {
    double samples = 0, relative_error = 0;
    bool busy = false, stored = false;
  };
  TruthStatus truth_status() const;

  const std::string& scene_name() const { return scene_name_; }
  const std::string& environment_name() const { return environment_name_; }

 private:
  void take_loaded();
  void draw(int width, int height);
  void follow_truth(double seconds);
  void request_truth();
  void use_stored_truth();
  bool wants_truth() const;
  void fall_back(LoadKind kind);

  ViewOptions options_;
  Loader loader_;
  TruthTracer tracer_;
  std::string scene_name_, environment_name_;
  std::shared_ptr<const EnvironmentData> light_;
  Message message_;
  std::string first_error_;
  bool had_error_ = false, changed_ = false;
  double quiet_seconds_ = 0;  // since the view changed
  unsigned seen_view_ = 0, traced_view_ = 0;
  struct Attempt {
    TechniqueChoice technique;
    Comparison comparison = Comparison::picture;
    bool operator==(const Attempt& other) const;
  };
  Attempt attempt() const { return {viewer.state.technique, viewer.state.comparison}; }
  bool has_failed() const { return failed_ && *failed_ == attempt(); }
  std::optional<Attempt> failed_;  // what could not draw the first picture
  double truth_samples_ = 0, truth_error_ = 0;
  Image stored_truth_;  // a file's, for the first view
  unsigned stored_view_ = 0;
  unsigned untraced_view_ = 0;  // whose truth could not be asked for
};

}  // namespace welkin

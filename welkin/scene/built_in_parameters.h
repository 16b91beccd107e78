#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace welkin {

/// The parameters of a built-in scene: "key=value,key=value".
class SceneParameters {
 public:
  /// `scene` is for messages. Throws Error where a key or value is missing.
  SceneParameters(std::string_view scene, std::string_view text);

  /// The value of `key` or the default. Throw Error for anything but numbers in [low, high], whole ones for count(), one
  /// to 16 of them, with / between, for list().
  float number(std::string_view key, float otherwise, float low, float high);
  int count(std::string_view key, int otherwise, int low, int high);
  std::vector<float> list(std::string_view key, std::vector<float> otherwise, float low, float high);

  /// Which of `names` the value is, the first by default. Throws Error that lists them.
  std::size_t choice(std::string_view key, std::span<const std::string_view> names);

  /// Throws Error naming the first key that nobody asked for.
  void refuse_others() const;

 private:
  struct Entry {
    std::string key, value;
    bool used = false;
  };
  const std::string* find(std::string_view key);
  float parse(std::string_view key, std::string_view text, float low, float high) const;

  std::string scene_;
  std::vector<Entry> entries_;
};

}  // namespace welkin

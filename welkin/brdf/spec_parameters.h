#pragma once
#include <fmt/format.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <welkin/brdf/spec_numbers.h>
#include <welkin/error.h>

// Private to welkin/brdf.

namespace welkin {

/// The parameters of one model in a text "NAME:A,B,...", taken from first to last. `form` is the model's form in messages.
class SpecParameters {
 public:
  /// `text` is what follows the colon.
  SpecParameters(std::string_view spec, std::string_view form, std::string_view text)
      : spec_(spec), form_(form) {
    if (!text.empty()) parts_ = split_spec(text, ',');
  }

  double number() { return parse(next()); }

  /// The numbers of the next parameter between colons.
  std::vector<double> numbers() {
    std::vector<double> values;
    for (const std::string_view part : split_spec(next(), ':')) values.push_back(parse(part));
    return values;
  }

  /// One number or three.
  std::array<double, 3> colour() {
    const std::vector<std::string_view> parts = split_spec(next(), ':');
    if (parts.size() == 1) {
      const double grey = parse(parts[0]);
      return {grey, grey, grey};
    }
    if (parts.size() != 3) refuse("a colour is one number or three (1:0.5:0.25)");
    return {parse(parts[0]), parse(parts[1]), parse(parts[2])};
  }

  bool more() const { return at_ < parts_.size(); }

  std::array<double, 3> colour_or(double grey) {
    return more() ? colour() : std::array<double, 3>{grey, grey, grey};
  }

  /// Takes the last parameter off where it is this word.
  bool take_last(std::string_view word) {
    if (!more() || parts_.back() != word) return false;
    parts_.pop_back();
    return true;
  }

  /// To be called when all that the model has were taken.
  void finish() const {
    if (at_ < parts_.size()) refuse("it has a parameter too many");
  }

  [[noreturn]] void refuse(const std::string& what) const {
    throw Error(fmt::format("BRDF '{}': {}; its form is {}", spec_, what, form_));
  }

 private:
  std::string_view next() {
    if (at_ >= parts_.size()) refuse("a parameter is missing");
    return parts_[at_++];
  }

  double parse(std::string_view text) const {
    const std::optional<double> value = spec_number(text);
    if (!value) refuse(fmt::format("'{}' is not a number", text));
    return *value;
  }

  std::string_view spec_, form_;
  std::vector<std::string_view> parts_;
  std::size_t at_ = 0;
};

}  // namespace welkin

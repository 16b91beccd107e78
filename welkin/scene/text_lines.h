#pragma once
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

// Reading text formats word by word (OBJ, MTL, the header of PLY).

namespace welkin {

constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

/// Cuts the first word, between blanks, off `line`; empty when there is none left.
inline std::string_view take_word(std::string_view& line) {
  std::size_t begin = 0;
  while (begin < line.size() && is_blank(line[begin])) ++begin;
  std::size_t end = begin;
  while (end < line.size() && !is_blank(line[end])) ++end;
  const std::string_view word = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return word;
}

/// `text` without blanks at its ends.
inline std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// A finite number of ordinary or scientific notation that fills the word; too small ones are 0. Nothing for all else,
/// also for what does not fit a float.
inline std::optional<float> to_number(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  double value = 0;
  const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty() || end != word.data() + word.size()) return std::nullopt;
  if (fault == std::errc::result_out_of_range && word.find("e-") == std::string_view::npos &&
      word.find("E-") == std::string_view::npos)
    return std::nullopt;
  const auto number = fault == std::errc() ? static_cast<float>(value) : 0.0f;
  if (!std::isfinite(number)) return std::nullopt;
  return number;
}

/// Lines of a text, without their ends (LF or CRLF), counted from 1. With `joined`, a backslash at the end of a line
/// appends the next one.
class TextLines {
 public:
  explicit TextLines(std::string_view text, bool joined = false) : rest_(text), joined_(joined) {}

  /// Whether there was another line.
  bool next() {
    number_ += lines_in_current_;
    lines_in_current_ = 0;
    if (rest_.empty()) return false;
    line_ = take();
    if (!joined_ || !ends_with_backslash()) return true;
    buffer_.clear();
    while (ends_with_backslash()) {
      buffer_ += trimmed(line_);
      buffer_.back() = ' ';  // the backslash
      line_ = take();
    }
    buffer_ += line_;
    line_ = buffer_;
    return true;
  }
  /// Valid until next().
  std::string_view line() const { return line_; }
  /// Of the first line of those that line() joins.
  std::size_t number() const { return number_; }
  /// What follows the current line.
  std::string_view rest() const { return rest_; }

 private:
  bool ends_with_backslash() const { return trimmed(line_).ends_with('\\'); }
  std::string_view take() {
    const std::size_t end = rest_.find('\n');
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++lines_in_current_;
    return line.ends_with('\r') ? line.substr(0, line.size() - 1) : line;
  }

  std::string_view rest_, line_;
  std::string buffer_;
  std::size_t number_ = 1, lines_in_current_ = 0;
  bool joined_;
};

/// What comes from a file goes into messages as one short line.
inline std::string printable(std::string_view text) {
  std::string line;
  for (char c : text.substr(0, 80)) line += c >= ' ' && c <= '~' ? c : '?';
  return line;
}

}  // namespace welkin

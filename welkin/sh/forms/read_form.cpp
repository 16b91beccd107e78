#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string>
#include <vector>

#include <welkin/error.h>
#include <welkin/image/output_file.h>
#include <welkin/sh/forms/code_form.h>
#include <welkin/sh/forms/document.h>
#include <welkin/sh/forms/json_form.h>
#include <welkin/sh/forms/light_lines.h>

namespace welkin {
namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

// What is left of each line before a comment; as many lines as before.
std::string without_comments(std::string_view text) {
  std::string code;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    code += line.substr(0, std::min(line.find("//"), line.find('#')));
    code += '\n';
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return code;
}

// Takes numbers out of source text: words and brackets between them are passed over, anything else is damage.
class NumberReader {
 public:
  NumberReader(std::string_view text, std::string_view name) : text_(text), name_(name) {}

  std::vector<double> all() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (std::isdigit(static_cast<unsigned char>(c)) || c == '-' || c == '+' || c == '.') {
        numbers_.push_back(number());
      } else if (is_word(c)) {
        pass_word();
      } else if (is_space(c) || std::string_view("()[]{},;").find(c) != std::string_view::npos) {
        pass_sign(c);
      } else {
        refuse("has something that does not belong between numbers");
      }
    }
    if (open_ != 0) refuse("is cut off: a bracket is open");
    return numbers_;
  }

 private:
  void pass_sign(char c) {
    ++at_;
    if (c == '(' || c == '[' || c == '{') ++open_;
    if (c == ')' || c == ']' || c == '}') --open_;
    if (open_ < 0) refuse("closes a bracket that was not open");
  }

  double number() {
    if (text_[at_] == '+' && at_ + 1 < text_.size() && text_[at_ + 1] != '-') ++at_;
    double value = 0;
    const char* end = text_.data() + text_.size();
    const auto [next, error] = std::from_chars(text_.data() + at_, end, value);
    if (error == std::errc::result_out_of_range || !std::isfinite(value)) refuse("has a number out of range");
    if (error != std::errc()) refuse("has a damaged number");
    at_ = static_cast<std::size_t>(next - text_.data());
    if (at_ < text_.size() && text_[at_] == 'f') ++at_;
    if (at_ < text_.size() && (is_word(text_[at_]) || text_[at_] == '.')) refuse("has a damaged number");
    return value;
  }

  void pass_word() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_word(text_[at_])) ++at_;
    std::string word(text_.substr(begin, at_ - begin));
    for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (word == "nan" || word == "inf" || word == "infinity") refuse("has a number that is not finite");
  }

  [[noreturn]] void refuse(const char* what) const {
    throw Error(name_, fmt::format("{} ({} numbers came before)", what, numbers_.size()));
  }

  std::string_view text_, name_;
  std::size_t at_ = 0;
  int open_ = 0;  // brackets
  std::vector<double> numbers_;
};

ShFormNumbers numbers_in(std::string_view text, std::string_view name) {
  const std::string code = without_comments(text);
  const std::vector<double> numbers = NumberReader(code, name).all();
  if (numbers.size() != 27)
    throw Error(name, fmt::format("has {} numbers where nine coefficients of red, green, blue have 27",
                                  numbers.size()));
  ShFormNumbers result;
  std::copy(numbers.begin(), numbers.end(), result.begin());
  return result;
}

// What stands after `key` in the first comment that begins with it; nothing when there is none.
std::optional<std::string> comment_after(std::string_view text, std::string_view key) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::optional<std::string_view> comment = comment_of(text.substr(0, end));
    if (comment && comment->starts_with(key)) return std::string(comment->substr(key.size()));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return {};
}

// The lines between the two that are nothing but the marks.
std::string_view marked(std::string_view text, std::string_view name) {
  std::size_t first = std::string_view::npos;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::optional<std::string_view> comment = comment_of(text.substr(at, end - at));
    if (comment == begin_mark && first == std::string_view::npos) first = std::min(end + 1, text.size());
    if (comment == end_mark && first != std::string_view::npos) return text.substr(first, at - first);
    at = end + 1;
  }
  throw Error(name, "is cut off: its coefficients do not both begin and end");
}

ShForm marked_form(const std::string& said, std::string_view name, std::optional<ShForm> bare_form) {
  try {
    const ShForm form = parse_sh_form(said);
    if (bare_form && *bare_form != form)
      throw Error(fmt::format("is {}, not {}", said, sh_form_name(*bare_form)));
    return form;
  } catch (const Error& error) {
    throw Error(name, error.what());
  }
}

ShDocument read_sh_code(std::string_view text, std::string_view name, std::optional<ShForm> bare_form) {
  const std::optional<std::string> said = comment_after(text, sh_marker);
  const bool cmgen = text.find("pre-scaled base") != std::string_view::npos;
  ShForm form = cmgen ? ShForm::filament : bare_form.value_or(ShForm::json);
  if (said) form = marked_form(*said, name, bare_form);
  if (form == ShForm::json)
    throw Error(name, "does not say what its numbers are: name their form with --form-in");
  const bool has_marks = said && form != ShForm::filament;
  if (has_marks && (form == ShForm::three || form == ShForm::babylon))
    throw Error(name, "is not the JSON object that it says it is");
  const ShFormNumbers numbers = numbers_in(has_marks ? marked(text, name) : text, name);
  return {from_sh_form(numbers, form), ShQuantity::radiance, comment_after(text, "Source: ").value_or(""),
          "none", lights_in(text, form, name)};
}

void check_size(std::uintmax_t size, std::string_view name) {
  if (size > max_sh_file_size)
    throw Error(name, fmt::format("has {} bytes; a coefficient file has at most {}", size, max_sh_file_size));
}

// A byte-order mark and leading blanks say nothing.
std::string_view text_of(std::span<const std::uint8_t> bytes) {
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  return text;
}

}  // namespace

ShDocument read_sh(std::span<const std::uint8_t> bytes, std::string_view name,
                   std::optional<ShForm> bare_form) {
  check_size(bytes.size(), name);
  const std::string_view text = text_of(bytes);
  if (text.empty()) throw Error(name, "is empty");
  ShDocument document =
      text.front() == '{' ? read_sh_json(text, name, bare_form) : read_sh_code(text, name, bare_form);
  for (double value : document.coefficients.values)
    if (!std::isfinite(value)) throw Error(name, "has a coefficient out of range");
  return document;
}

ShDocument read_sh_file(const std::filesystem::path& path, std::optional<ShForm> bare_form) {
  std::error_code unknown;
  const std::uintmax_t size = std::filesystem::file_size(path, unknown);
  if (!unknown) check_size(size, path.string());
  return read_sh(read_file(path), path.string(), bare_form);
}

bool looks_like_sh(std::span<const std::uint8_t> bytes) {
  const std::string_view text = text_of(bytes.first(std::min<std::size_t>(bytes.size(), 4096)));
  if (text.empty()) return false;
  return std::string_view("{[(").find(text.front()) != std::string_view::npos ||
         text.find(sh_marker) != std::string_view::npos;
}

}  // namespace welkin

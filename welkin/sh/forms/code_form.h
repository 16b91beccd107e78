#pragma once
#include <optional>
#include <string>
#include <string_view>

#include <welkin/sh/forms/form.h>

// Private to sh/forms: the text around the numbers.

namespace welkin {

/// How a form that is source code is laid out.
struct CodeForm {
  std::string_view comment;  ///< what starts a comment
  std::string_view about;    ///< what it holds, axes, use: lines of the header, without the comment sign
  std::string_view before;   ///< the code up to the numbers
  std::string_view open;     ///< before the three numbers of a row, with its indentation
  std::string_view close;    ///< after them
  std::string_view suffix;   ///< of each number, e.g. "f"
  std::string_view after;    ///< the code after the numbers
};

/// The layout of c, glsl, hlsl, unity, unreal or godot.
const CodeForm& code_form(ShForm form);

/// The comment lines of three, babylon and filament.
std::string_view about_form(ShForm form);

/// GLSL: the three 4 x 4 matrices M of Ramamoorthi & Hanrahan 2001, equations 11 and 12, over pi.
std::string glsl_matrices(const ShFormNumbers& numbers);

/// What a line says that is nothing but a comment ("//" or "#", one blank, then this), without blanks around it; nothing
/// for other lines. Markers count only where they begin such a comment, so that a file's name in it is no marker.
std::optional<std::string_view> comment_of(std::string_view line);

/// The marker that a file of ours has, followed by the name of its form.
inline constexpr std::string_view sh_marker = "welkin-sh: ";
inline constexpr std::string_view begin_mark = "begin coefficients", end_mark = "end coefficients";

}  // namespace welkin

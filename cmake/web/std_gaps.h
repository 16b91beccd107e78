// What the standard library of the web build (libc++ 13, emscripten 3.1.6) lacks of C++20; every source of that build is
// compiled with -include of this file. Here alone is anything added to namespace std.
#pragma once
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>

namespace std {

#ifndef __cpp_lib_bit_cast
template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}
#endif

#ifndef __cpp_lib_to_chars
// strtod takes more than from_chars does: white space, a plus sign, hexadecimal digits. What follows the number may be
// anything, so the part that can be a number is copied first. There is one locale.
inline from_chars_result from_chars(const char* first, const char* last, double& value) {
  const char* at = first != last && *first == '-' ? first + 1 : first;
  const bool digit = at != last && isdigit(static_cast<unsigned char>(*at)) != 0;
  if (at == last || !(digit || *at == '.' || isalpha(static_cast<unsigned char>(*at)) != 0))
    return {first, errc::invalid_argument};
  const auto can_belong = [](char c) {
    return isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '+' || c == '-';
  };
  const bool hexadecimal = last - at > 1 && at[0] == '0' && (at[1] == 'x' || at[1] == 'X');
  const char* end = hexadecimal ? at + 1 : at;
  while (!hexadecimal && end != last && can_belong(*end)) ++end;
  const string copy(first, end);
  char* stop = nullptr;
  const double number = strtod(copy.c_str(), &stop);
  if (stop == copy.c_str()) return {first, errc::invalid_argument};
  const char* next = first + (stop - copy.c_str());
  const string_view text(at, static_cast<size_t>(next - at));
  const string_view mantissa = text.substr(0, text.find_first_of("eE"));
  const bool too_small = number == 0 && mantissa.find_first_of("123456789") != string_view::npos;
  if ((digit || *at == '.') && (isinf(number) || too_small)) return {next, errc::result_out_of_range};
  value = number;
  return {next, errc()};
}

inline from_chars_result from_chars(const char* first, const char* last, float& value) {
  double wide = 0;
  const from_chars_result result = from_chars(first, last, wide);
  if (result.ec != errc()) return result;
  const float narrow = static_cast<float>(wide);
  if (isinf(narrow) != isinf(wide) || (narrow == 0) != (wide == 0))
    return {result.ptr, errc::result_out_of_range};
  value = narrow;
  return result;
}

inline to_chars_result to_chars(char* first, char* last, double value, chars_format format, int precision) {
  const char* pattern = format == chars_format::scientific ? "%.*e"
                        : format == chars_format::fixed    ? "%.*f"
                                                           : "%.*g";
  const int size = snprintf(first, static_cast<size_t>(last - first), pattern, precision, value);
  return size < last - first ? to_chars_result{first + size, errc()}
                             : to_chars_result{last, errc::value_too_large};
}
#endif

}  // namespace std

#pragma once
// Reads a double as std::from_chars does, also where the standard library has it for integers only (libc++ before 20).

#include <locale.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <concepts>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace liecheck {

/// std::from_chars(first, last, value, format) by strtod with the decimal point of the locale "C": the same end, error and
/// value for every text. strtod also takes blanks, a plus, 0x and nan(...), which are left to the caller here.
inline std::from_chars_result fromCharsByStrtod(const char* first, const char* last, double& value,
                                                std::chars_format format) {
  static const locale_t plain = ::newlocale(LC_ALL_MASK, "C", nullptr);
  const bool hex = format == std::chars_format::hex, negative = first != last && *first == '-';
  const char* const begin = first + (negative ? 1 : 0);
  const std::string_view rest(begin, static_cast<std::size_t>(last - begin));
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const bool is_word = !rest.empty() && is_letter(rest[0]) &&
                       (!hex || std::string_view("iInN").find(rest[0]) != std::string_view::npos);
  const char* const marks = is_word ? "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                            : hex   ? "0123456789abcdefABCDEF.pP+-"
                            : format == std::chars_format::fixed ? "0123456789."
                                                                 : "0123456789.eE+-";
  std::string text = (negative ? "-" : "") + std::string(hex && !is_word ? "0x" : "");
  const std::size_t added = text.size();
  text += rest.substr(0, std::min(rest.size(), rest.find_first_not_of(marks)));
  if (text.size() == added || text[added] == '+' || text[added] == '-')
    return {first, std::errc::invalid_argument};
  char* end = nullptr;
  const int kept = std::exchange(errno, 0);
  const double result = ::strtod_l(text.c_str(), &end, plain);
  const bool outside = errno == ERANGE && (result == 0 || std::isinf(result));
  errno = kept;
  const auto read = static_cast<std::size_t>(end - text.c_str());
  if (read <= added) return {first, std::errc::invalid_argument};
  const char* const after = begin + (read - added);
  if (outside) return {after, std::errc::result_out_of_range};
  value = result;
  return {after, std::errc()};
}

/// The double at the beginning of a text, without blanks or a plus before it. Returns where it ends, or the error.
template <std::same_as<double> T>
std::from_chars_result fromChars(const char* first, const char* last, T& value,
                                 std::chars_format format = std::chars_format::general) {
  if constexpr (requires { std::from_chars(first, last, value, format); })
    return std::from_chars(first, last, value, format);
  else
    return fromCharsByStrtod(first, last, value, format);
}

}  // namespace liecheck

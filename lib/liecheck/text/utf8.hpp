#pragma once
// Checks whether a text is UTF-8, and skips its byte order mark.

#include <cstddef>
#include <string_view>

namespace liecheck {

/// The text without the byte order mark that some editors write before it.
inline std::string_view withoutByteOrderMark(std::string_view text) {
  return text.starts_with("\xef\xbb\xbf") ? text.substr(3) : text;
}

/// The index of the first byte that is not valid UTF-8 (RFC 3629: no surrogates, no overlong forms), or
/// text.size() if all are valid.
inline std::size_t firstInvalidUtf8(std::string_view text) {
  std::size_t i = 0;
  while (i < text.size()) {
    const auto byte = [&](std::size_t k) {
      return i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0U;
    };
    const unsigned first = byte(0), second = byte(1);
    if (first < 0x80) {
      ++i;
      continue;
    }
    const std::size_t continuations = first < 0xE0 ? 1 : first < 0xF0 ? 2 : 3;
    const unsigned least = first == 0xE0 ? 0xA0 : first == 0xF0 ? 0x90 : 0x80;
    const unsigned largest = first == 0xED ? 0x9F : first == 0xF4 ? 0x8F : 0xBF;
    if (first < 0xC2 || first > 0xF4 || second < least || second > largest) return i;
    for (std::size_t k = 2; k <= continuations; ++k)
      if ((byte(k) & 0xC0U) != 0x80) return i;
    i += continuations + 1;
  }
  return text.size();
}

}  // namespace liecheck

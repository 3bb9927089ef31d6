#include <support/text.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <support/json.hpp>

namespace liecheck::properties {

std::string printable(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const unsigned next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0U;
    if (byte == '\n') {
      out += "\\n";
    } else if (byte == '\t') {
      out += "\\t";
    } else if (byte < ' ' || byte == 0x7F) {
      out += fmt::format("\\x{:02x}", byte);
    } else if (byte == 0xC2 && next >= 0x80 && next < 0xA0) {  // C1 in UTF-8
      out += fmt::format("\\x{:02x}", next);
      ++i;
    } else if (byte >= 0x80) {
      const std::string letter = text.substr(i, byte < 0xE0 ? 2 : byte < 0xF0 ? 3 : 4);
      const bool whole = is_utf8(letter);
      out += whole ? letter : fmt::format("\\x{:02x}", byte);
      if (whole) i += letter.size() - 1;
    } else {
      out += text[i];
    }
  }
  return out;
}

std::string printable_lines(const std::string& text) {
  std::string out;
  for (std::size_t at = 0, end; at < text.size(); at = end + 1) {
    end = std::min(text.find_first_of("\n\t", at), text.size());
    out += printable(text.substr(at, end - at));
    if (end < text.size()) out += text[end];
  }
  return out;
}

std::string file_name(const std::string& text) {
  constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
  std::string name = text.empty() || text[0] == '.' ? "_" + text.substr(text.empty() ? 0 : 1) : text;
  for (auto at = name.find_first_not_of(plain); at != name.npos; at = name.find_first_not_of(plain, at))
    name[at] = '_';
  return name;
}

std::string shell_quoted(const std::string& word) {
  constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=:,@%+";
  if (!word.empty() && word.find_first_not_of(plain) == word.npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

}  // namespace liecheck::properties

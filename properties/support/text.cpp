#include <support/text.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <support/json.hpp>
#include <utility>

namespace liecheck::properties {

namespace {

/// Whether a letter in UTF-8 is an end of a line, or a format character (Cf) that shows nothing: it may turn the direction
/// of a line, or make two different texts look alike.
bool is_invisible(const std::string& letter) {
  constexpr std::pair<unsigned, unsigned> ranges[] = {
      {0xad, 0xad},       {0x61c, 0x61c},     {0x180e, 0x180e},   {0x200b, 0x200f},
      {0x2028, 0x202e},   {0x2060, 0x206f},   {0xfeff, 0xfeff},   {0xfff9, 0xfffb},
      {0x13430, 0x1343f}, {0x1bca0, 0x1bca3}, {0x1d173, 0x1d17a}, {0xe0000, 0xe007f}};
  unsigned code = static_cast<unsigned char>(letter[0]) & (0xffU >> (letter.size() + 1));
  for (const char c : letter.substr(1)) code = code << 6 | (static_cast<unsigned char>(c) & 0x3fU);
  return std::ranges::any_of(ranges, [&](const auto& r) { return r.first <= code && code <= r.second; });
}

}  // namespace

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
      const bool whole = is_utf8(letter) && !is_invisible(letter);
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

std::string without_mark(const std::string& text) {
  return text.starts_with("\xef\xbb\xbf") ? text.substr(3) : text;
}

std::string file_name(const std::string& text) {
  constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
  std::string name = text.empty() || text[0] == '.' ? "_" + text.substr(text.empty() ? 0 : 1) : text;
  for (auto at = name.find_first_not_of(plain); at != name.npos; at = name.find_first_not_of(plain, at))
    name[at] = '_';
  return name;
}

namespace {
constexpr std::string_view plain_in_a_shell =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=:,@%+";
}

std::string shell_quoted(const std::string& word) {
  if (!word.empty() && word.find_first_not_of(plain_in_a_shell) == word.npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string as_typed(const std::string& words) {
  const char *called = std::getenv("LIECHECK_CALLED_AS"), *serves = std::getenv("LIECHECK_SERVES");
  std::string text = (called && *called ? printable(called) : "liecheck") + " " + words;
  if (!serves || !*serves) return text;
  const std::string before = std::string("'") + serves;
  for (auto at = text.find(before); at != text.npos; at = text.find(before, at + 1)) {
    const auto end = text.find('\'', at + before.size());
    if (end == text.npos) break;
    text.replace(at, end + 1 - at, shell_quoted(text.substr(at + before.size(), end - at - before.size())));
  }
  return text;
}

std::string replay_words(const std::string& id, const std::string& flags) {
  return as_typed("replay " + id + flags);
}

bool is_replay(const std::string& text) {
  if (!(text.starts_with("liecheck replay ") || text.starts_with("liecheck lab replay ")) ||
      printable(text) != text)
    return false;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\'')
      quoted = !quoted;
    else if (!quoted && text.compare(i, 2, "\\'") == 0)
      ++i;
    else if (!quoted && text[i] != ' ' && plain_in_a_shell.find(text[i]) == plain_in_a_shell.npos)
      return false;
  }
  return !quoted;
}

std::string xml_escaped(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += c == '&'                             ? "&amp;"
           : c == '<'                           ? "&lt;"
           : c == '>'                           ? "&gt;"
           : c == '"'                           ? "&quot;"
           : (c >= 0 && c < ' ') || c == '\x7f' ? fmt::format("&#{};", int(c))
                                                : std::string(1, c);
  return out;
}

std::string csv_field(const std::string& field) {
  // A spreadsheet would run a text that begins so as a formula. Numbers begin with '-', too.
  const bool formula =
      field.find_first_of("=+@") == 0 ||
      (field.starts_with('-') && field.find_first_not_of("0123456789abcdefpxin.+- ") != field.npos);
  const std::string text = printable_lines(formula ? "'" + field : field);
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

}  // namespace liecheck::properties

#pragma once
// Mutations of a text: of bytes, numbers, lines, quoted texts and whole elements, so that much of it still parses.

#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace liecheck::test {

using namespace std::literals;

/// The words of a text, which @ separates.
inline std::vector<std::string> words_in(std::string_view text) {
  std::vector<std::string> all;
  for (std::size_t at = 0, end = 0; end != text.npos; at = end + 1)
    all.emplace_back(text.substr(at, (end = text.find('@', at)) - at));
  return all;
}
/// Words that readers of numbers and text stumble over.
inline const std::vector<std::string> awkward_words = words_in(
    "nan@inf@-1@0@-0@1e999@1e-999@0x10@1,5@18446744073709551616@9007199254740993@\"@'@\0@\xff\xfe@"
    "\xc3\x28@\xe2\x80\xae@\r\n@\t@#@:@|@1e308 1e308 1e308"sv);
/// And of URDF.
inline const std::vector<std::string> urdf_words = words_in(
    "<@>@/>@&#0;@&lt;@&x;@<!--@-->@<![CDATA[@]]>@<?xml version=\"1.0\"?>@"
    "<!DOCTYPE r [<!ENTITY x \"y\">]>@<robot>@</robot>@<link name=\"a\"/>@<mimic joint=\"a\"/>@"
    "<limit/>@<axis xyz=\"0 0 0\"/>@type=\"fixed\"@type=\"continuous\"@type=\"floating\"@"
    "type=\"planar\"@type=\"prismatic\"@name=\"\"@root_joint@universe"sv);

class Mutator {
 public:
  /// `words` are inserted beside awkward_words. Texts are cut at `longest` bytes.
  Mutator(std::uint64_t seed, std::vector<std::string> words, std::size_t longest = 20000)
      : bits_(seed), words_(std::move(words)), longest_(longest) {
    words_.insert(words_.end(), awkward_words.begin(), awkward_words.end());
  }

  /// `text` after one to four changes, some of which insert pieces of `other`.
  std::string mutated(std::string text, const std::string& other) {
    for (std::size_t n = 1 + below(4); n > 0; --n) text = once(std::move(text), other);
    if (text.size() > longest_) text.resize(longest_);
    return text;
  }
  std::size_t below(std::size_t n) { return n ? static_cast<std::size_t>(bits_() % n) : 0; }

 private:
  struct Range {
    std::size_t from, size;
  };

  std::string once(std::string text, const std::string& other) {
    const std::size_t at = below(text.size() + 1);
    switch (below(15)) {
      case 0:  // flip a bit
        if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
        return text;
      case 1:  // replace a byte
        if (at < text.size()) text[at] = static_cast<char>(below(256));
        return text;
      case 2:
        return text.insert(at, words_[below(words_.size())]);
      case 3:  // remove a piece, or everything that follows
        return below(4) ? text.erase(at, 1 + below(40)) : text.substr(0, at);
      case 4: {  // insert a piece of `other`
        const std::size_t from = below(other.size());
        return text.insert(at, other.substr(from, below(200)));
      }
      case 5:
      case 6: {  // replace a quoted text
        const Range q = quoted(text, at);
        return text.replace(q.from, q.size, below(2) ? words_[below(words_.size())] : number());
      }
      case 7: {  // replace a quoted text by another one
        const Range a = quoted(text, at), b = quoted(text, below(text.size() + 1));
        return text.replace(a.from, a.size, text.substr(b.from, b.size));
      }
      case 8:
      case 9: {  // remove or duplicate an element
        const Range e = element(text, at);
        const std::string copy = text.substr(e.from, e.size);
        if (below(2)) return text.erase(e.from, e.size);
        return text.insert(below(2) ? e.from : element(text, below(text.size() + 1)).from, copy);
      }
      case 10: {  // insert an element of `other`
        const Range e = element(other, below(other.size() + 1));
        return text.insert(element(text, at).from, other.substr(e.from, e.size));
      }
      case 11: {  // remove, duplicate or move a line
        const Range l = line(text, at);
        const std::string copy = text.substr(l.from, l.size);
        if (below(2)) text.erase(l.from, l.size);
        return below(3) ? text.insert(line(text, below(text.size() + 1)).from, copy) : text;
      }
      case 12: {  // insert a line of `other`
        const Range l = line(other, below(other.size() + 1));
        return text.insert(line(text, at).from, other.substr(l.from, l.size));
      }
      case 13: {  // replace a word or a number by a word
        const Range w = word(text, at);
        return text.replace(w.from, w.size, below(2) ? words_[below(words_.size())] : number());
      }
      default: {  // insert the start of an element many times
        const Range e = element(text, at);
        const std::string copy = text.substr(e.from, std::min<std::size_t>(e.size, 60));
        std::string all;
        for (std::size_t n = below(100); n > 0; --n) all += copy;
        return text.insert(e.from, all);
      }
    }
  }
  std::string number() {
    const int exponent = static_cast<int>(below(640)) - 320;
    return (below(2) ? "-" : "") + std::to_string(below(1000)) + (below(2) ? "." : "") + "e" +
           std::to_string(below(4) ? exponent % 4 : exponent);
  }
  static Range line(const std::string& text, std::size_t at) {
    const std::size_t before = at == 0 ? text.npos : text.rfind('\n', at - 1), end = text.find('\n', at),
                      from = before == text.npos ? 0 : before + 1;
    return {from, (end == text.npos ? text.size() : end + 1) - from};
  }
  static Range word(const std::string& text, std::size_t at) {
    constexpr const char* between = " \t\n,;:=|[](){}<>\"'";
    const std::size_t from = std::min(text.find_first_not_of(between, at), text.size());
    return {from, std::min(text.find_first_of(between, from), text.size()) - from};
  }
  static Range quoted(const std::string& text, std::size_t at) {
    const std::size_t open = text.find('"', at);
    if (open == text.npos) return {std::min(at, text.size()), 0};
    const std::size_t close = text.find('"', open + 1);
    return {open + 1, (close == text.npos ? text.size() : close) - open - 1};
  }
  /// The next tag after `at`, or the element from this tag to its closing tag.
  Range element(const std::string& text, std::size_t at) {
    const std::size_t open = text.find('<', at);
    if (open == text.npos) return {text.size(), 0};
    std::size_t end = text.find('>', open);
    if (end == text.npos) return {open, text.size() - open};
    if (below(2)) {
      const std::size_t name_end = text.find_first_of(" \t\n/>", open + 1);
      const std::string closing = "</" + text.substr(open + 1, name_end - open - 1) + ">";
      const std::size_t found = text.find(closing, end);
      if (found != text.npos) end = found + closing.size() - 1;
    }
    return {open, end + 1 - open};
  }

  std::mt19937_64 bits_;
  std::vector<std::string> words_;
  std::size_t longest_;
};

}  // namespace liecheck::test

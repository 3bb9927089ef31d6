#include <algorithm>
#include <liecheck/urdf/urdf_markup.hpp>
#include <string_view>

namespace liecheck::urdf_detail {

std::size_t firstNotUtf8(std::string_view text) {
  std::size_t i = 0;
  while (i < text.size()) {
    if (static_cast<unsigned char>(text[i]) < 0x80) {
      ++i;
      continue;
    }
    const auto byte = [&](std::size_t k) {
      return i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0U;
    };
    const unsigned first = byte(0), second = byte(1);
    const std::size_t more = first < 0xE0 ? 1 : first < 0xF0 ? 2 : 3;
    const unsigned low = first == 0xE0 ? 0xA0 : first == 0xF0 ? 0x90 : 0x80;
    const unsigned high = first == 0xED ? 0x9F : first == 0xF4 ? 0x8F : 0xBF;
    if (first < 0xC2 || first > 0xF4 || second < low || second > high) return i;
    for (std::size_t k = 2; k <= more; ++k)
      if ((byte(k) & 0xC0U) != 0x80) return i;
    i += more + 1;
  }
  return text.size();
}

namespace {

/// What TinyXML lets pass or would recurse on: a walk over the tags alone, without recursion. Comments,
/// declarations and quoted '>' are understood. Refuses elements nested deeper than max_element_depth, text
/// outside the root element, attribute values without quotes, and markup that does not end.
class Markup {
 public:
  Markup(const std::string& text, const std::string& source_name) : text_(text), source_(source_name) {}

  void check() {
    while (at_ < text_.size()) {
      if (text_[at_] != '<') {
        characters();
      } else if (startsWith("<!--")) {
        skipPast("-->", "a comment");
      } else if (startsWith("<![CDATA[")) {
        skipPast("]]>", "a CDATA section");
      } else if (startsWith("<!DOCTYPE")) {
        doctype();
      } else if (startsWith("<?") || startsWith("<!")) {
        skipPast(">", "a declaration");
      } else {
        tag();
      }
    }
  }

 private:
  bool startsWith(std::string_view prefix) const { return text_.compare(at_, prefix.size(), prefix) == 0; }
  void advance(std::size_t to) {
    line_ += int(std::count(text_.begin() + long(at_), text_.begin() + long(to), '\n'));
    at_ = to;
  }
  void skipPast(std::string_view end, const char* what) {
    const std::size_t found = text_.find(end, at_);
    if (found == std::string::npos) refuse("malformed XML, or cut off", std::string(what) + " does not end");
    advance(found + end.size());
  }
  /// One that only names the document is let pass.
  void doctype() {
    const std::size_t own = std::min(text_.find('[', at_), text_.size());
    if (own < text_.find('>', at_)) {
      advance(own);
      refuse("a DOCTYPE with declarations of its own (entities) is not supported",
             text_.substr(own, text_.find('>', own) - own));
    }
    skipPast(">", "a declaration");
  }
  void characters() {
    const std::size_t end = std::min(text_.find('<', at_), text_.size());
    const std::size_t first = text_.find_first_not_of(" \t\r\n", at_);
    const bool byte_order_mark = at_ == 0 && startsWith("\xEF\xBB\xBF");
    if (depth_ == 0 && first < end && !byte_order_mark) {
      advance(first);
      refuse("text outside the root element", text_.substr(first, end - first));
    }
    advance(end);
  }
  void tag() {
    bool value_due = false;
    std::size_t end = at_ + 1;
    for (; end < text_.size() && text_[end] != '>'; ++end) {
      const char c = text_[end];
      if (c == '<') {
        break;
      } else if (c == '"' || c == '\'') {
        end = std::min(text_.find(c, end + 1), text_.size());
        if (end == text_.size()) break;
        value_due = false;
      } else if (value_due && std::string_view(" \t\r\n").find(c) == std::string_view::npos) {
        refuse("malformed XML, or cut off", "an attribute value without quotes");
      } else {
        value_due = value_due || c == '=';
      }
    }
    if (end >= text_.size() || text_[end] != '>') refuse("malformed XML, or cut off", "a tag does not end");
    if (text_[at_ + 1] == '/') {
      if (--depth_ < 0) refuse("an element is closed that was not opened", text_.substr(at_, end + 1 - at_));
    } else if (text_[end - 1] != '/' && ++depth_ > max_element_depth) {
      refuse("elements nested too deep", "more than " + std::to_string(max_element_depth));
    }
    advance(end + 1);
  }
  [[noreturn]] void refuse(const std::string& what, const std::string& value) const {
    throw UrdfError(source_, line_, what, value);
  }

  const std::string& text_;
  const std::string& source_;
  std::size_t at_ = 0;
  int line_ = 1, depth_ = 0;
};

}  // namespace

void checkMarkup(const std::string& text, const std::string& source_name) {
  const auto refuse = [&](std::size_t at, const std::string& what) {
    throw UrdfError(source_name, 1 + int(std::count(text.begin(), text.begin() + long(at), '\n')), what,
                    "byte " + std::to_string(at));
  };
  if (const std::size_t nul = text.find('\0'); nul != std::string::npos) refuse(nul, "a zero byte: not text");
  if (const std::size_t bad = firstNotUtf8(text); bad < text.size()) refuse(bad, "not UTF-8");
  Markup(text, source_name).check();
}

}  // namespace liecheck::urdf_detail

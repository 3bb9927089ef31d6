#include <algorithm>
#include <liecheck/text/utf8.hpp>
#include <liecheck/urdf/xml_check.hpp>
#include <string_view>

namespace liecheck::urdf_detail {

namespace {

/// Checks the tags in one pass without recursion, and skips comments, declarations and quoted '>', in linear
/// time. It refuses what TinyXML-2 accepts or recurses on: elements nested deeper
/// than max_element_depth, closing tags without an opening tag (TinyXML-2 ignores all that follows), text
/// outside the root element, attribute values without quotes, and markup that does not end. It also refuses
/// what takes TinyXML-2 quadratic time: more than max_attributes in one element, since it compares each with
/// all before it, and character references that do not end, since it looks for them in all that follows.
class TagCheck {
 public:
  TagCheck(const std::string& text, const Messages& messages) : text_(text), messages_(messages) {}

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
  /// A DOCTYPE that only names the document is accepted.
  void doctype() {
    const std::string_view name = std::string_view(text_).substr(at_, text_.find('>', at_) - at_);
    if (const std::size_t bracket = name.find('['); bracket != name.npos) {
      const std::size_t declarations = at_ + bracket;
      advance(declarations);
      refuse("a DOCTYPE with declarations (entities) is not supported",
             text_.substr(declarations, text_.find('>', declarations) - declarations));
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
    references(end);
    advance(end);
  }
  /// Checks the character references (&#65; or &#x41;) from at_ to end.
  void references(std::size_t end) {
    const std::string_view part = std::string_view(text_).substr(at_, end - at_);
    for (std::size_t i = part.find("&#"); i != part.npos; i = part.find("&#", i + 1)) {
      const std::string_view reference = part.substr(i, max_reference_size);
      if (reference.find(';') != reference.npos) continue;
      advance(at_ + i);
      refuse("malformed XML, or cut off: a character reference does not end", std::string(reference));
    }
  }
  void tag() {
    bool value_due = false;
    int attributes = 0;
    std::size_t end = at_ + 1;
    for (; end < text_.size() && text_[end] != '>'; ++end) {
      const char c = text_[end];
      if (c == '<') break;
      if (c == '"' || c == '\'') {
        end = std::min(text_.find(c, end + 1), text_.size());
        if (end == text_.size()) break;
        value_due = false;
      } else if (value_due && std::string_view(" \t\r\n").find(c) == std::string_view::npos) {
        refuse("malformed XML, or cut off", "an attribute value without quotes");
      } else {
        value_due = value_due || c == '=';
        if (c == '=' && ++attributes > max_attributes)
          refuse("too many attributes in one element", "more than " + std::to_string(max_attributes));
      }
    }
    if (end >= text_.size() || text_[end] != '>') refuse("malformed XML, or cut off", "a tag does not end");
    references(end);
    if (text_[at_ + 1] == '/') {
      if (--depth_ < 0) refuse("a closing tag without an opening tag", text_.substr(at_, end + 1 - at_));
    } else if (text_[end - 1] != '/' && ++depth_ > max_element_depth) {
      refuse("elements nested too deep", "more than " + std::to_string(max_element_depth));
    }
    advance(end + 1);
  }
  [[noreturn]] void refuse(const std::string& what, const std::string& value) const {
    messages_.refuse(line_, what, value);
  }

  const std::string& text_;
  const Messages& messages_;
  std::size_t at_ = 0;
  int line_ = 1, depth_ = 0;
};

}  // namespace

void checkXml(const std::string& text, const Messages& messages) {
  const auto refuse = [&](std::size_t at, const std::string& what) {
    messages.refuse(1 + int(std::count(text.begin(), text.begin() + long(at), '\n')), what,
                    "byte " + std::to_string(at));
  };
  if (const std::size_t nul = text.find('\0'); nul != std::string::npos) refuse(nul, "a zero byte: not text");
  if (const std::size_t bad = firstInvalidUtf8(text); bad < text.size()) refuse(bad, "not UTF-8");
  TagCheck(text, messages).check();
}

}  // namespace liecheck::urdf_detail

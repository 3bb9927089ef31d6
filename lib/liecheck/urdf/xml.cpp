#include <expat.h>

#include <algorithm>
#include <exception>
#include <liecheck/text/utf8.hpp>
#include <liecheck/urdf/xml.hpp>
#include <memory>
#include <new>

namespace liecheck::urdf_detail {
namespace {

constexpr const char* xml_space = " \t\r\n";

/// Whether a text begins with a character reference or one of the entities of XML.
bool isReference(std::string_view text) {
  constexpr std::string_view hexadecimal = "0123456789abcdefABCDEF";
  for (const std::string_view entity : {"&amp;", "&lt;", "&gt;", "&quot;", "&apos;"})
    if (text.starts_with(entity)) return true;
  if (!text.starts_with("&#")) return false;
  const std::size_t digits = text.starts_with("&#x") ? 3 : 2;
  const std::size_t end = text.find_first_not_of(hexadecimal.substr(0, digits == 3 ? 22 : 10), digits);
  return end != text.npos && end > digits && text[end] == ';';
}

/// The text with what other readers of URDF take and XML does not have: "--" in comments, "&" in values, and any
/// character between elements, which have no text in URDF. Its lines are those of the text.
std::string strictXml(std::string_view text) {
  std::string strict;
  const auto copy = [&](std::size_t size) { strict += text.substr(0, size), text.remove_prefix(size); };
  const auto blank = [&](std::size_t size) {
    for (const char c : text.substr(0, size)) strict += c == '\n' ? '\n' : ' ';
    text.remove_prefix(size);
  };
  const auto upTo = [&](std::string_view end) { return std::min(text.find(end), text.size()); };
  while (!text.empty()) {
    const bool comment = text.starts_with("<!--"), data = text.starts_with("<![CDATA[");
    if (comment || data) {
      copy(comment ? 4 : 9);
      blank(upTo(comment ? "-->" : "]]>"));
      copy(std::min<std::size_t>(3, text.size()));
    } else if (text.starts_with("<?")) {
      copy(std::min(upTo("?>") + 2, text.size()));
    } else if (text.front() == '<') {
      char quote = 0;
      for (bool inside = true; inside && !text.empty();) {
        const char c = text.front();
        inside = quote || c != '>';
        const bool escaped = quote && c == '&' && !isReference(text);
        if (quote ? c == quote : c == '"' || c == '\'') quote = quote ? 0 : c;
        copy(1);
        if (escaped) strict += "amp;";
      }
    } else {
      const auto c = static_cast<unsigned char>(text.front());
      const bool space = c == '\n' || c == '\t' || c == '\r';
      (c == '&' || text.starts_with("]]>") || (c < ' ' && !space)) ? blank(1) : copy(1);
    }
  }
  return strict;
}

class TreeBuilder {
 public:
  /// `text` begins in `line`.
  TreeBuilder(std::string_view text, int line, const Messages& messages)
      : text_(text), messages_(messages), line_(line) {}

  Element root() {
    if (!parser_) throw std::bad_alloc();
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(
        parser_.get(),
        [](void* self, const char* name, const char** attributes) {
          handle(self, [&](TreeBuilder& b) { b.open(name, attributes); });
        },
        [](void* self, const char*) { handle(self, [](TreeBuilder& b) { b.open_.pop_back(); }); });
    XML_SetStartDoctypeDeclHandler(
        parser_.get(), [](void* self, const char*, const char* external, const char*, int internal) {
          handle(self, [&](TreeBuilder& b) {
            if (external || internal) b.refuseDeclarations(internal ? nullptr : external);
          });
        });
    const XML_Status status = XML_Parse(parser_.get(), text_.data(), int(text_.size()), XML_TRUE);
    if (thrown_) std::rethrow_exception(thrown_);
    if (status != XML_STATUS_OK) refuse(XML_GetErrorCode(parser_.get()));
    return std::move(document_.children.at(0));
  }

 private:
  /// Calls f, until it throws: an exception must not pass through expat, which is written in C. root() throws it again.
  template <class F>
  static void handle(void* self, F f) noexcept {
    TreeBuilder& b = *static_cast<TreeBuilder*>(self);
    if (b.thrown_) return;
    try {
      f(b);
    } catch (...) {
      b.thrown_ = std::current_exception();
      XML_StopParser(b.parser_.get(), XML_FALSE);
    }
  }

  /// The place of what expat has read last, or of an error.
  std::size_t place() const {
    const XML_Index at = XML_GetCurrentByteIndex(parser_.get());
    return std::clamp(at < 0 ? 0 : std::size_t(at), at_, text_.size());
  }
  /// The line of a place that is not before that of the last call.
  int lineOf(std::size_t at) {
    line_ += int(std::count(text_.begin() + long(at_), text_.begin() + long(at), '\n'));
    at_ = at;
    return line_;
  }
  std::string upTo(char end, std::size_t at) const {
    return std::string(text_.substr(at, text_.find(end, at + 1) - at));
  }

  void open(const char* name, const char** attributes) {
    std::size_t at = place();
    const std::size_t depth = open_.size();
    Element& e = open_.back()->children.emplace_back();
    e.name = name, e.line = lineOf(at);
    if (depth > max_element_depth)
      messages_.refuse(e.line, "elements nested too deep", "more than " + std::to_string(max_element_depth));
    at += 1 + e.name.size();
    for (; *attributes; attributes += 2) {
      at = text_.find_first_not_of(xml_space, at);
      Attribute& a = e.attributes.emplace_back(Attribute{attributes[0], attributes[1], lineOf(at)});
      const std::size_t quote = text_.find_first_of("\"'", at), end = text_.find(text_[quote], quote + 1);
      const std::string_view written = text_.substr(quote + 1, end - quote - 1);
      if (written.find_first_of("&\r") == written.npos) a.value = written;  // expat makes spaces of tabs
      at = end + 1;
    }
    open_.push_back(&e);
  }

  /// A DOCTYPE that names a file with declarations, or has declarations that follow.
  [[noreturn]] void refuseDeclarations(const char* file) {
    const std::size_t at = place();
    messages_.refuse(lineOf(at), "a DOCTYPE with declarations (entities) is not supported",
                     file ? file : upTo('>', at));
  }

  [[noreturn]] void refuse(XML_Error error) {
    if (error == XML_ERROR_NO_MEMORY) throw std::bad_alloc();
    const bool outside = open_.size() == 1;
    if (error == XML_ERROR_NO_ELEMENTS && outside) messages_.refuse(1, "no element, expected <robot>", "");
    const char* malformed = "malformed XML, or cut off";
    if (error == XML_ERROR_NO_ELEMENTS || error == XML_ERROR_TAG_MISMATCH)
      messages_.refuse(open_.back()->line, malformed, "an element without a closing tag of its name");
    const std::size_t at = place();
    if (error == XML_ERROR_JUNK_AFTER_DOC_ELEMENT)
      messages_.refuse(lineOf(at),
                       text_[at] == '<' ? "a second root element" : "text outside the root element",
                       upTo('<', at));
    messages_.refuse(lineOf(at), malformed, XML_ErrorString(error) + (": " + upTo('\n', at)));
  }

  std::string_view text_;
  const Messages& messages_;
  std::size_t at_ = 0;
  int line_;  // of at_
  Element document_;
  std::vector<Element*> open_{&document_};
  std::exception_ptr thrown_;
  std::unique_ptr<XML_ParserStruct, void (*)(XML_Parser)> parser_{XML_ParserCreate("UTF-8"), XML_ParserFree};
};

}  // namespace

const char* Element::attribute(std::string_view attribute_name) const {
  for (const Attribute& a : attributes)
    if (a.name == attribute_name) return a.value.c_str();
  return nullptr;
}

const Element* Element::first(std::string_view child_name) const {
  for (const Element& e : children)
    if (e.name == child_name) return &e;
  return nullptr;
}

Element parseXml(const std::string& text, const Messages& messages) {
  const auto lineOf = [&](std::size_t at) {
    return 1 + int(std::count(text.begin(), text.begin() + long(at), '\n'));
  };
  const auto refuse = [&](std::size_t at, const char* what) {
    messages.refuse(lineOf(at), what, "byte " + std::to_string(at));
  };
  if (const std::size_t nul = text.find('\0'); nul != std::string::npos) refuse(nul, "a zero byte: not text");
  if (const std::size_t bad = firstInvalidUtf8(text); bad < text.size()) refuse(bad, "not UTF-8");
  const std::string_view marked = withoutByteOrderMark(text);
  const std::size_t first = marked.find_first_not_of(xml_space);
  if (first == marked.npos) messages.refuse(1, "empty", std::to_string(text.size()) + " bytes");
  const std::string_view rest = marked.substr(first);
  const std::string strict = strictXml(rest);
  return TreeBuilder(strict, lineOf(text.size() - rest.size()), messages).root();
}

}  // namespace liecheck::urdf_detail

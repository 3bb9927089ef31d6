#include <algorithm>
#include <liecheck/urdf/error.hpp>

namespace liecheck {
namespace {

bool continues_a_character(char c) {
  return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
}

/// At most `longest` bytes: the middle of a longer text becomes "...", between whole characters.
std::string shortened(const std::string& text, std::size_t longest, std::size_t kept_at_end) {
  if (text.size() <= longest) return text;
  std::size_t head = longest - kept_at_end - 3, tail = text.size() - kept_at_end;
  while (head > 0 && continues_a_character(text[head])) --head;
  while (tail < text.size() && continues_a_character(text[tail])) ++tail;
  return text.substr(0, head) + "..." + text.substr(tail);
}

std::string message(const std::string& file, int line, const std::string& long_what,
                    const std::string& long_value) {
  const std::string what = shortened(long_what, 400, 150), value = shortened(long_value, 80, 0);
  std::string text = file + ":" + (line > 0 ? std::to_string(line) + ": " : " ") + what + " (" + value + ")";
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 127; }, ' ');
  return text;
}

}  // namespace

UrdfError::UrdfError(const std::string& file, int line, const std::string& what, const std::string& value)
    : std::runtime_error(message(file, line, what, value)), file_(file), line_(line) {}

void urdf_detail::Messages::refuse(int line, const std::string& what, const std::string& value) const {
  throw UrdfError(file_, line, what, value);
}

void urdf_detail::Messages::warn(int line, const std::string& what, const std::string& value) {
  if (strict_) refuse(line, what, value);
  warnings.push_back(message(file_, line, what, value));
}

}  // namespace liecheck

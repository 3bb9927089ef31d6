#include <algorithm>
#include <liecheck/urdf/error.hpp>

namespace liecheck {
namespace {

std::string message(const std::string& file, int line, const std::string& what, std::string value) {
  if (value.size() > 80) {
    std::size_t end = 77;
    while (end > 74 && (static_cast<unsigned char>(value[end]) & 0xC0) == 0x80) --end;  // whole characters
    value = value.substr(0, end) + "...";
  }
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

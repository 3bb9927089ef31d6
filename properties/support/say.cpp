#include <support/say.hpp>

#include <support/text.hpp>

namespace liecheck::properties {

void say_text(const std::string& text) {
  fmt::print("{}", printable_lines(text));
}

}  // namespace liecheck::properties

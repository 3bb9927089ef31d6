#include <support/terminal.hpp>

#include <unistd.h>

#include <cstdlib>
#include <string_view>

namespace liecheck::properties {

std::string coloured(Colour colour, const std::string& text) {
  static const bool shown = [] {
    const char *no = std::getenv("NO_COLOR"), *kind = std::getenv("TERM");
    return ::isatty(1) && !(no && *no) && kind && std::string_view(kind) != "dumb";
  }();
  return shown ? "\033[" + std::to_string(static_cast<int>(colour)) + "m" + text + "\033[0m" : text;
}

}  // namespace liecheck::properties

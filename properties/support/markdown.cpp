#include <support/markdown.hpp>

#include <fmt/format.h>
#include <cstring>
#include <support/text.hpp>

namespace liecheck::properties {

std::string markdown(const std::string& text) {
  const std::string line = printable(text);
  std::string all;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool less = line[i] == '<' && line.compare(i, 2, "< ") == 0;
    all += std::strchr("<>|[]!@&*`\\", line[i]) && !less ? fmt::format("&#{};", int(line[i]))
                                                         : line.substr(i, 1);
  }
  return all;
}

std::string markdown_block(const std::string& text) {
  std::string fence = "```";
  while (text.find(fence) != text.npos) fence += '`';
  return fmt::format("{0}\n{1}{2}{0}\n", fence, text, text.ends_with('\n') ? "" : "\n");
}

}  // namespace liecheck::properties

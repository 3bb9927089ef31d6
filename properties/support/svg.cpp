#include <support/svg.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <support/text.hpp>

namespace liecheck::properties {
namespace {

constexpr const char* style = R"(
text{font:12px ui-monospace,'DejaVu Sans Mono',Menlo,Consolas,monospace;fill:#1f2328}
.ground{fill:#fff;stroke:#d0d7de}.faint{fill:#59636e}.line{stroke:#d0d7de;stroke-width:1}.strong{font-weight:bold}
.worse{fill:#c0271d;stroke:#c0271d}.better{fill:#1a7f37;stroke:#1a7f37}.hollow{fill:#fff}
text.worse,text.better{stroke:none}
@media(prefers-color-scheme:dark){text{fill:#e6edf3}.ground{fill:#0d1117;stroke:#3d444d}.faint{fill:#9198a1}
.line{stroke:#3d444d}.worse{fill:#ff8178;stroke:#ff8178}.better{fill:#56d364;stroke:#56d364}.hollow{fill:#0d1117}}
)";

}  // namespace

double svg_width(const std::string& text) {
  const auto characters = std::ranges::count_if(text, [](unsigned char c) { return (c & 0xc0) != 0x80; });
  return 7.2 * static_cast<double>(characters);
}

std::string svg_text(double x, double y, const std::string& text, const std::string& classes,
                     const std::string& anchor, double most) {
  const std::string squeezed =
      svg_width(text) > most ? fmt::format(" textLength=\"{:.0f}\" lengthAdjust=\"spacingAndGlyphs\"", most)
                             : "";
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"{}\" text-anchor=\"{}\"{}>{}</text>\n", x, y,
                     classes, anchor, squeezed, xml_escaped(text));
}

std::string svg(int width, int height, const std::string& title, const std::string& elements) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "role=\"img\">\n"
      "<title>{2}</title><style>{3}</style>\n"
      "<rect class=\"ground\" x=\".5\" y=\".5\" width=\"{4}\" height=\"{5}\" rx=\"6\"/>\n{6}</svg>\n",
      width, height, xml_escaped(title), style, width - 1, height - 1, elements);
}

}  // namespace liecheck::properties

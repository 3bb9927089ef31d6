#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <reports/drawing.hpp>
#include <reports/html.hpp>

namespace liecheck::reports {
namespace {

constexpr auto circle = "m-3.5 0a3.5 3.5 0 1 0 7 0a3.5 3.5 0 1 0-7 0z", triangle = "m0-4l4 7h-8z",
               square = "m-3-3h6v6h-6z", diamond = "m0-4.2l4.2 4.2l-4.2 4.2l-4.2-4.2z",
               star = "m-3-3l6 6m0-6l-6 6m3-7v8m-4-4h8", cross = "m0-4v8m-4-4h8",
               saltire = "m-3-3l6 6m0-6l-6 6";
constexpr std::array outlines = {circle, triangle, square,   diamond, circle, star,
                                 cross,  saltire,  triangle, square,  diamond};
static_assert(outlines.size() == look_count);

constexpr double letter = 5.7;  ///< the mean width of a letter of a name [px]

}  // namespace

std::string text(double x, double y, const std::string& words, const char* anchor, const char* kind) {
  return fmt::format("<text x=\"{:.4g}\" y=\"{:.4g}\" text-anchor=\"{}\"{}>{}</text>", x, y, anchor,
                     *kind ? fmt::format(" class=\"{}\"", kind) : "", escaped(words));
}

std::string line(double x0, double y0, double x1, double y1, const char* kind) {
  return fmt::format("<path class=\"{}\" d=\"M{:.4g} {:.4g}L{:.4g} {:.4g}\"/>", kind, x0, y0, x1, y1);
}

const char* outline(std::size_t look) {
  return outlines[look % look_count];
}

std::string marker(double x, double y, std::size_t look, const std::string& title, const char* kind,
                   bool is_small) {
  const std::string place =
      is_small ? fmt::format("transform=\"translate({:.4g} {:.4g}) scale(.66)\" d=\"M0 0", x, y)
               : fmt::format("d=\"M{:.4g} {:.4g}", x, y);
  return fmt::format("<path class=\"{}\" {}{}\"><title>{}</title></path>", kind, place, outline(look),
                     escaped(title));
}

std::string power(int e) {
  if (e == 0) return "1";
  constexpr std::array digits = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out = "10";
  for (const char c : std::to_string(e)) out += c == '-' ? "⁻" : digits[static_cast<std::size_t>(c - '0')];
  return out;
}

std::string in_look(std::size_t look, const std::string& elements) {
  return fmt::format("<g style=\"--c:var(--look-{})\">{}</g>", look % look_count, elements);
}

std::string drawn(const std::string& label, const std::string& elements, double high) {
  return fmt::format(
      "<svg class=\"picture\" viewBox=\"0 0 {} {:.4g}\" "
      "role=\"img\" aria-label=\"{}\">{}</svg>\n",
      width, high, escaped(label), elements);
}

bool Names::is_free(const Box& box) const {
  return box.x0 >= left + 1 && box.x1 <= right + 6 && box.y0 >= 0 && box.y1 <= bottom &&
         std::ranges::none_of(taken_, [&](const Box& b) {
           return b.x0 < box.x1 && box.x0 < b.x1 && b.y0 < box.y1 && box.y0 < b.y1;
         });
}

bool Names::is_clear(const Box& box, double x, double y, double clear) const {
  return std::ranges::all_of(marks_, [&](const auto& mark) {
    const auto [mx, my] = mark;
    return std::hypot(mx - x, my - y) < .5 || std::hypot(std::max({box.x0 - mx, 0.0, mx - box.x1}),
                                                         std::max({box.y0 - my, 0.0, my - box.y1})) >= clear;
  });
}

std::string Names::name(double x, double y, const std::string& words, const char* kind) {
  const double wide = letter * static_cast<double>(words.size()) * (*kind ? 1.1 : 1);
  const auto box_at = [&](double from, double down) {
    return Box{from - 1, down - 9, from + wide + 1, down + 2};
  };
  const auto written = [&](double from, double down) {  // against its mark, whatever its true width is
    return from + wide <= x + .1 ? text(from + wide, down, words, "end", kind)
                                 : text(from, down, words, "start", kind);
  };
  for (const auto& [from, down] : {std::pair(x + 7, y + 3.5),
                                   {x - 7 - wide, y + 3.5},
                                   {x - wide / 2, y - 8},
                                   {x - wide / 2, y + 15},
                                   {x + 6, y - 5},
                                   {x + 6, y + 12},
                                   {x - 6 - wide, y - 5}}) {
    if (!is_free(box_at(from, down)) || !is_clear(box_at(from, down), x, y, 8)) continue;
    taken_.push_back(box_at(from, down));
    return written(from, down);
  }
  for (const double clear : {9.0, 0.0})  // of other marks
    for (double far = 16; far < 56; far += 4)
      for (int i = 0; i < 16; ++i) {
        const double angle = std::numbers::pi * i / 8, px = x + far * std::cos(angle),
                     py = y + far * std::sin(angle);
        const double from = px >= x ? px : px - wide, down = py + 3.5;
        const Box box = box_at(from, down);
        if (!is_free(box) || !is_clear(box, x, y, clear)) continue;
        taken_.push_back(box);
        return line(x, y, px, py, "lead") + written(from, down);
      }
  return "";
}

}  // namespace liecheck::reports

#pragma once
// Small pictures as SVG, readable on light and on dark pages.

#include <string>

namespace liecheck::properties {

/// A picture of width x height [px] on a ground of its own, with a title for screen readers. The classes of its
/// elements: `text` in monospace of 12 px, `faint`, `worse`, `better`, and `line` for strokes of the colour of the
/// text. Dark pages invert the ground (prefers-color-scheme).
std::string svg(int width, int height, const std::string& title, const std::string& elements);

/// Text at x, y of its baseline [px]; `anchor` is start, middle or end. It is squeezed if it is wider than `most`.
std::string svg_text(double x, double y, const std::string& text, const std::string& classes = "",
                     const std::string& anchor = "start", double most = 1e9);

/// The width of a text [px]: 7.2 for each character.
double svg_width(const std::string& text);

}  // namespace liecheck::properties

#pragma once
// HTML elements, and two sections of the page.

#include <reports/record.hpp>
#include <string>
#include <vector>

namespace liecheck::reports {

/// The text with &, <, > and quotes escaped, for use in an element or an attribute.
std::string escaped(const std::string& text);

/// Three digits, "NaN" or "Inf".
std::string eps_text(double value);

using Cells = std::vector<std::string>;  // HTML

/// Most cells of a dense table do not wrap; the table scrolls sideways instead.
std::string table(const std::string& caption, const Cells& heads, const std::vector<Cells>& rows,
                  bool dense = false);

std::string code(const std::string& text);

/// A text field of a row, escaped.
std::string text_of(const Json& row, const char* name);

/// Section "What accuracy costs in time": advice, the price of each further digit, every row.
std::string cost_section(const Merged& merged);

/// Section "Scalar coefficients: every float".
std::string sweep_section(const Merged& merged);

}  // namespace liecheck::reports

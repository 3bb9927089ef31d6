#pragma once
// Elements of HTML, and the sections of the page that need no file of their own header.

#include <reports/record.hpp>
#include <string>
#include <vector>

namespace liecheck::reports {

/// Text, safe in an element or an attribute.
std::string escaped(const std::string& text);

/// "1.23", "NaN", "Inf".
std::string eps_text(double value);

using Cells = std::vector<std::string>;  // HTML

/// dense: cells on one line; the table scrolls sideways instead.
std::string table(const std::string& caption, const Cells& heads, const std::vector<Cells>& rows,
                  bool dense = false);

std::string code(const std::string& text);

/// A field that is text, escaped.
std::string text_of(const Json& row, const char* name);

/// Section "What accuracy costs in time": advice, the price of each further digit, every row.
std::string cost_section(const Merged& merged);

/// Section "Scalar coefficients: every float".
std::string sweep_section(const Merged& merged);

}  // namespace liecheck::reports

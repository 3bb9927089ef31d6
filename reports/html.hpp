#pragma once
// Pieces of HTML that the page's sections are made of.

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

/// What accuracy costs in time: advice, the price of each further digit, every point.
std::string cost_section(const Merged& merged);

/// The scalar coefficients at every float: the sweeps of the records.
std::string sweep_section(const Merged& merged);

}  // namespace liecheck::reports

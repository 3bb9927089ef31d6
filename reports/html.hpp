#pragma once
// HTML elements, the sections of the page, and the page. The verdict, the table of subjects, the definitions
// and the description of the machine are plain HTML without scripts. Scripts in the browser draw the charts
// and the tables of bands from the figures that the page contains as JSON.

#include <reports/record.hpp>
#include <string>
#include <vector>

namespace liecheck::reports {

/// The text with &, <, > and quotes escaped, for use in an element or an attribute.
std::string escaped(const std::string& text);

/// The value with three digits, or "NaN" or "Inf".
std::string eps_text(double value);

/// A time in ns, µs, ms or s, with three digits.
std::string time_text(double ns);

using Cells = std::vector<std::string>;  // HTML

/// Most cells of a dense table do not wrap; the table scrolls sideways instead.
std::string table(const std::string& caption, const Cells& heads, const std::vector<Cells>& rows,
                  bool dense = false);

std::string code(const std::string& text);

/// A text field of a row, escaped.
std::string text_of(const Json& row, const char* name);

/// A verdict or status; "pass" and "fail" have colours.
std::string status_text(const std::string& status);

struct Looks;
struct FirstScreen;

/// The verdict on all, and one line for each library.
std::string verdict_lines(const Looks& looks, const FirstScreen& screen);

/// The three questions, with their answers and pictures.
std::string answers_section(const FirstScreen& screen);

/// A card for each finding, as the terminal tells it; "" if there are none.
std::string findings_section(const Looks& looks);

/// The table of digits: operations by libraries and scalars, with a box for each region of the angle.
std::string digits_table(const Looks& looks);

/// What its boxes mean.
std::string digits_note(const std::string& table);

/// Section "What accuracy costs in time": advice, the price of each further digit, every row.
std::string cost_section(const Looks& looks);

/// Section "Scalar coefficients: every float".
std::string sweep_section(const Merged& merged);

/// Section "Whole operations: proved beside hunted".
std::string bounds_section(const Merged& merged);

/// Sections "Other environments", "Long horizons" and "Random rounding", each only if there is such a measurement.
std::string measurement_sections(const Merged& merged);

/// Films, charts of error against time, orders, drift, long spins, flips, other simulators, costs of effects.
std::string scenes_section(const Merged& merged);

/// A compact form of the JSON inside the page. page.js restores the original; report.json is not packed.
/// A list of objects with equal keys becomes {"*keys": [...], "*columns": [[...], ...]}. Any other list
/// becomes {"*words": [...], "*at": [...]} if that is shorter. "*words" has its distinct values, and "*at"
/// has, for each element, the index of its value in "*words".
/// Throws std::invalid_argument if a key begins with a star.
Json packed(const Json& value);

/// What the page shows of the content of report.json: errors with four digits; the worst input of a subject, scalar and
/// operation in each region of the angle, of its first 16 numbers; times over all inputs. Each row gets the key of its
/// region and the digits that it loses, and its worst case `count`, how many numbers the input has, and `shown`, whether it is
/// the worst one there. `looks` has the look of each library.
Json page_numbers(Json numbers, const Looks& looks);

/// The text compressed by zlib, in base 85. The browser expands it; DecompressionStream("deflate") has been in every
/// browser since 2023.
std::string compressed(const std::string& text);

/// The whole page; `numbers` is the content of report.json.
std::string page(const Merged& merged, const Json& numbers);

}  // namespace liecheck::reports

#pragma once
// Pictures as SVG, drawn when the page is written: they need no script, and the browser colours them as the page.

#include <algorithm>
#include <reports/cost_points.hpp>
#include <reports/regions.hpp>
#include <string>
#include <vector>

namespace liecheck::reports {

/// The look of each library, the same one everywhere: a place in the colours --look-0 ... of page.css and in the markers
/// of drawing.hpp. First those of the results, then those of the times only.
std::map<std::string, std::size_t> looks_of(const Merged& merged);

/// A piece of line with the marker of a library.
std::string swatch(std::size_t look);

/// What pictures are drawn with.
struct Looks {
  const Merged& merged;
  Digits digits;
  std::map<std::string, std::size_t> of;
  std::set<std::pair<std::string, std::string>> wrong;  ///< subject and operation, if a row of them is
  explicit Looks(const Merged& all);
  /// Whether the operation of a library is wrong.
  bool is_wrong(const std::string& operation) const {
    return std::ranges::any_of(wrong, [&](const auto& one) { return one.second == operation; });
  }
};

/// What the first screen says: on each library, and on each question. All texts are HTML.
struct FirstScreen {
  struct Line {
    std::string subject, kind, mark,
        words;             ///< kind: pass, edge (wrong at extreme angles alone), fail or open
    std::string headline;  ///< of a page of this library alone
  };
  struct Question {
    std::string id, to, words, answer;                          ///< `to`: the section with the details
    std::vector<std::pair<std::string, std::string>> pictures;  ///< head and SVG
  };
  std::string kind, title;  ///< kind of the title: pass, edge, fail or incomplete
  std::vector<Line> lines;
  std::vector<Question> questions;
};
FirstScreen first_screen(const Looks& looks);

/// The first screen as one picture, for a page that is not HTML. It names the digest of the inputs.
std::string first_picture(const Merged& merged);

/// Digits lost over the angle: of each library, a line that 99 % of the cases do not exceed, and a mark for the worst case.
/// `rows` are of one scalar and one block of an operation; those of another axis than "theta" or "pi_minus_theta" are left
/// out. "" if no row is left.
std::string error_picture(const Looks& looks, const std::vector<const Json*>& rows, const std::string& axis);

/// Correct digits over the latency of a call, and the Pareto front, of one operation in float and double. "" without times.
std::string cost_picture(const Looks& looks, const std::vector<CostPoint>& points,
                         const std::string& operation);

/// Classes of hard cases by libraries: how many cases fail, the classes with the most failures first.
std::string hard_picture(const Looks& looks, const std::vector<HardCase>& cases);

}  // namespace liecheck::reports

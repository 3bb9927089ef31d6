#pragma once
// Pictures as SVG, drawn when the page is written: they need no script, and the browser colours them as the page.

#include <reports/cost_points.hpp>
#include <reports/regions.hpp>
#include <string>
#include <vector>

namespace liecheck::reports {

/// The look of each library, the same one everywhere: a place in the colours --look-0 ... of page.css and in the markers
/// below. First those of the results, then those of the times only.
std::map<std::string, std::size_t> looks_of(const Merged& merged);
inline constexpr std::size_t look_count = 11;

/// A piece of line with the marker of a library.
std::string swatch(std::size_t look);

/// What pictures are drawn with.
struct Looks {
  const Merged& merged;
  Digits digits;
  std::map<std::string, std::size_t> of;
  explicit Looks(const Merged& all) : merged(all), digits(all), of(looks_of(all)) {}
};

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

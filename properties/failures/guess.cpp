// A guess at the cause of a failure. Errors of formulas have shapes over the angle theta: what cancels as theta goes to 0
// grows as a power of 1 / theta and ends where the code changes its formula; a series with a wrong term has an
// error that grows with theta up to its end. A result that is wrong everywhere may be right in another convention. Where
// no shape fits, there is no guess.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <conventions/probe.hpp>
#include <failures/blocks.hpp>
#include <failures/calls.hpp>
#include <invariants/tree_laws.hpp>
#include <map>
#include <search/plain.hpp>
#include <span>
#include <support/stop.hpp>

namespace liecheck::properties {

namespace {

/// The errors in one band: x = log10 of its middle (theta, or pi - theta), y = log10 of error / limit, at least 0 and at
/// most where all digits are lost: larger errors tell nothing more.
struct Point {
  double x, y, low, high;
  bool lost;   ///< whether the error leaves at most one and a half digits
  bool zero;   ///< whether the worst result differs from the right one by its size, as 0 does
  bool still;  ///< whether the worst result differs from the right one by theta, as that of theta = 0 does
  std::uint64_t cases, failed;
  /// Whether the band tells of a formula, which fails for many inputs of a band.
  bool many_fail() const { return 4 * failed > cases; }
};

constexpr double jump = 1.5;  ///< a factor of 30 between adjacent bands is no property of a smooth formula
constexpr std::uint64_t least_cases = 3;

/// The bands of one axis, ascending. The lowest ones, in which theta^2 underflows, say nothing of a formula.
std::vector<Point> points(const FailedBlock& f, Axis axis) {
  std::map<std::size_t, Point> by_band;
  for (const BandOf& b : f.bands) {
    const Band& band = b.series->bands()[b.band];
    const bool underflows = axis == Axis::theta && !band.name.starts_with("theta 1e");
    if (band.axis != axis || underflows || band.low <= 1e-100 || b.row->errors.count() < least_cases)
      continue;
    const Budget& budget = b.series->budget(b.output, band.region);
    const double error = budget.rule == Rule::forward ? b.row->max_error : b.row->max_excess;
    const double limit = std::max(budget.limit, 1.0);
    const double y = std::max(0.0, std::log10(std::min(error, 1 / b.series->eps) / limit));
    const auto at = by_band.try_emplace(b.band, Point{std::log10(std::sqrt(band.low * band.high)), 0,
                                                      band.low, band.high, false, false, false, 0, 0});
    Point& point = at.first->second;
    point.y = std::max(point.y, y), point.cases += b.row->errors.count(), point.failed += b.row->failed;
    point.lost |= error * b.series->eps > 0.03;
    point.zero |= std::fabs(error * b.series->eps - 1) < 1e-6;
    point.still |= error * b.series->eps > 0.5 * band.low && error * b.series->eps < 2 * band.high;
  }
  std::vector<Point> all;
  for (const auto& [band, p] : by_band) all.push_back(p);
  std::ranges::sort(all, {}, &Point::x);
  return all;
}

/// The number of bands up to the last one in which all digits are lost.
std::size_t lost_bands(const std::vector<Point>& p) {
  const auto last = std::find_if(p.rbegin(), p.rend(), [](const Point& q) { return q.lost; });
  return static_cast<std::size_t>(p.rend() - last);
}
/// The slope of y over x where the error is not within its limit, in the bands above those that have lost all digits;
/// 0 in fewer than three bands.
double slope(const std::vector<Point>& p) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const Point& q : std::span(p).subspan(lost_bands(p)))
    if (q.y > 0.5) ++n, x += q.x, y += q.y, xx += q.x * q.x, xy += q.x * q.y;
  return n < 3 ? 0 : (n * xy - x * y) / (n * xx - x * x);
}

std::string about(double theta) {
  const int e = static_cast<int>(std::lround(std::log10(theta)));
  return fmt::format("1e{}", e);
}

/// Two digits, as 0.02 or 1.5e-8, and a power of ten as 1e-2.
std::string short_of(double x) {
  if (std::fabs(std::log10(x) - std::round(std::log10(x))) < 0.02) return about(x);
  std::string text = fmt::format("{:.2g}", x);
  if (const auto zero = text.find("e-0"); zero != text.npos) text.erase(zero + 2, 1);
  return text;
}

/// The angle at which failures begin or end, between a band that fails and the next one; else the border of both.
std::string border(const FailedBlock& f, const Point& failing, const Point& passing) {
  const bool below = failing.x < passing.x;
  const auto inside = [](const Point& p, double share) {  // from the lower edge up
    return std::pow(p.low, 1 - share) * std::pow(p.high, share);
  };
  for (const double from : {0.1, 0.5, 0.9})
    for (const double to : {0.9, 0.5, 0.1})
      if (const auto angle =
              angle_between(*f.worst->series, static_cast<int>(f.worst->output),
                            inside(failing, below ? from : to), inside(passing, below ? to : from)))
        return short_of(*angle);
  return about(below ? failing.high : failing.low);
}

bool is_rotation_vector(const FailedBlock& f) {
  return f.block == "rotation vector";
}
std::string_view operation_of(const FailedBlock& f) {
  return f.worst->series->outputs.at(f.worst->output).operation;
}
/// Whether the result is a rotation vector, or its angle alone.
bool has_angle(const FailedBlock& f) {
  return is_rotation_vector(f) || operation_of(f) == "relative_angle";
}
/// Whether formulas for the result have series in theta.
bool has_series(const FailedBlock& f) {
  return operation_of(f) != "relative_angle" && operation_of(f) != "rotation_between" &&
         operation_of(f) != "slerp";
}
/// Whether the error is an angle, not relative to theta.
bool errs_by_angle(const FailedBlock& f) {
  return f.block == "rotation" || f.block == "direction";
}

/// Whether no input of an angle from 1 to pi - 1 fails.
bool moderate_angles_pass(const FailedBlock& f) {
  return std::ranges::none_of(f.bands, [](const BandOf& b) {
    const Band& band = b.series->bands()[b.band];
    return band.axis == Axis::none && band.region == Region::to_pi && b.row->failed > 0;
  });
}

/// What is wrong below a cutoff, above which the error ends.
std::string below_cutoff(const FailedBlock& f, const std::vector<Point>& p, std::size_t peak) {
  Point next{};
  next.x = 0.3, next.low = 1, next.high = 2;  // moderate angles are no band of this axis
  const std::string at = border(f, p[peak], peak + 1 < p.size() ? p[peak + 1] : next);
  if (errs_by_angle(f) && p[peak].still && p[peak - 1].still)
    return fmt::format("a threshold at theta about {}, below which the result is that of theta = 0", at);
  if (!has_series(f))
    return fmt::format("a threshold at theta about {}, below which another formula is coarser", at);
  return fmt::format("a cutoff at theta about {}: the series below it lacks a term, or has a wrong one", at);
}

/// What the errors at small angles tell.
std::string at_small_angles(const FailedBlock& f) {
  const std::vector<Point> p = points(f, Axis::theta);
  if (p.size() < 5) return "";
  const auto peak = static_cast<std::size_t>(std::ranges::max_element(p, {}, &Point::y) - p.begin());
  if (p[peak].y < 1) return "";
  const auto at = [&](std::size_t i) { return i < p.size() ? p[i].y : 0; };
  const auto falls = [&](std::size_t i) { return at(i) < p[peak].y - jump; };
  const bool to_one = peak + 1 == p.size() && p[peak].high == 1 && moderate_angles_pass(f),
             ends_below = peak > 0 && falls(peak - 1),
             ends_above = to_one || (peak + 1 < p.size() && falls(peak + 1)),
             fails_above = at(peak + 1) > 0.5;
  const double power = slope(p), root = std::sqrt(f.worst->series->eps);
  const auto near_root = [root](double theta) { return std::fabs(std::log10(theta / root)) < 1.6; };
  // Below the root of eps the cosine is 1, and its acos is 0. The angle between two quaternions errs by chance there.
  const std::size_t lost = lost_bands(p);
  if (is_rotation_vector(f) ? power < -1.5 && power > -2.5 && (!ends_below || near_root(p[peak].low))
                            : has_angle(f) && power < -1 && lost > 0 && near_root(p[lost - 1].high))
    return "acos near 1, which keeps half of the digits: the error grows as 1 / theta^2; atan2 of both parts "
           "does not";
  if (has_series(f) && ends_below && fails_above && p[peak].many_fail())
    return fmt::format(
        "a cutoff at theta about {}: above it the closed form cancels, the more the smaller theta is",
        border(f, p[peak], p[peak - 1]));
  if (peak >= 2 && at(peak - 1) > 0.3 && at(peak - 2) <= at(peak - 1) && ends_above && falls(peak - 2) &&
      p[peak].many_fail())
    return below_cutoff(f, p, peak);
  std::size_t zeros = 0;
  while (zeros < p.size() && p[zeros].zero) ++zeros;
  if (zeros > 1 && zeros < p.size() && at(zeros) < at(zeros - 1) - jump &&
      p[zeros].low < 1.01 * p[zeros - 1].high)  // the next band has cases, too
    return fmt::format(
        "the result is 0 where theta is below about {}: a threshold, or acos of a number that rounds to 1",
        border(f, p[zeros - 1], p[zeros]));
  if (has_series(f) && peak >= 3 && peak + 3 < p.size() && falls(peak - 3) && falls(peak + 3) &&
      p[peak].cases >= 10)
    return fmt::format("a cutoff at theta about {}, towards which the errors of both formulas grow",
                       about(at(peak + 1) > at(peak - 1) ? p[peak].high : p[peak].low));
  if (power > -0.5 || p.front().y < p[peak].y - jump) return "";
  if (operation_of(f).starts_with("log3_quaternion") || operation_of(f) == "log3_any_norm") {
    // Half of the stored quaternions have w < 0.
    std::uint64_t cases = 0, failed = 0;
    for (const Point& q : p) cases += q.y > 0.5 ? q.cases : 0, failed += q.y > 0.5 ? q.failed : 0;
    if (failed * 10 > cases * 2 && failed * 10 < cases * 8)
      return "where w < 0, the angle 2 atan2(|v|, w) is near 2 pi, and 2 pi - angle cancels; -Q is the same "
             "rotation, "
             "with w > 0";
  }
  return fmt::format(
      "a missing series: the formula cancels as theta goes to 0, and the error grows as 1 / theta{}",
      std::lround(-power) > 1 ? fmt::format("^{}", std::lround(-power)) : "");
}

/// What failures only at tiny angles tell.
std::string of_underflow(const FailedBlock& f) {
  for (const BandOf& b : f.bands) {
    const Band& band = b.series->bands()[b.band];
    if (b.fails && (b.row->not_finite || band.axis != Axis::theta || band.high > 1e-100)) return "";
  }
  return "theta^2 underflows: std::hypot and a norm of scaled numbers do not";
}

/// What the errors near pi tell.
std::string near_pi(const FailedBlock& f) {
  const std::vector<Point> p = points(f, Axis::pi_minus_theta);
  if (p.size() < 4) return "";
  const double power = slope(p);
  if (!has_series(f) && !has_angle(f)) {
    std::size_t lost = 0;
    while (lost < p.size() && p[lost].lost) ++lost;
    if (lost > 1 && lost < p.size() && p[lost].y < 1 && p[lost].low < 1.01 * p[lost - 1].high)
      return fmt::format("a threshold between pi - theta = {} and {}, below which the result is wrong",
                         about(p[lost - 1].low), about(p[lost - 1].high));
    if (p.front().y > jump && power < -0.5)
      return "1 + cos(theta), or the cross product of the arguments, cancels where they are nearly opposite";
    return "";
  }
  if (p.front().y > jump && power < -0.5 && power > -2.5)
    return fmt::format(
        "sin near pi: something is divided by sin(theta), or theta comes from acos: the error grows as "
        "1 / (pi - theta){}",
        std::lround(-power) > 1 ? "^2" : "");
  return "";
}

/// What results on another branch tell, if there are some only near pi.
std::string of_branch_near_pi(const FailedBlock& f) {
  bool any = false;
  for (const BandOf& b : f.bands) {
    if (b.row->wrong_branch == 0) continue;
    const Band& band = b.series->bands()[b.band];
    if (band.axis != Axis::pi_minus_theta || band.high >= 1) return "";
    if (b.row->failed > b.row->wrong_branch) return "";  // something else is wrong there
    any = true;
  }
  if (!any || operation_of(f) != "log3_quaternion") return "";
  return "the sign of w near pi: where w is just below 0, the shorter rotation is about the opposite axis";
}

/// What NaN and infinite results tell.
std::string of_not_finite(const FailedBlock& f) {
  double largest = -1;
  std::uint64_t elsewhere = 0;  // failures where no result is NaN or infinite
  bool zero = false, beyond = false, near_pi = false, other = false;
  for (const BandOf& b : f.bands) {
    if (b.row->not_finite == 0) {
      elsewhere += b.fails ? b.row->failed : 0;
      continue;
    }
    const Band& band = b.series->bands()[b.band];
    if (band.axis == Axis::theta)
      largest = std::max(largest, band.high), zero = zero || band.high == 0;
    else if (band.axis == Axis::pi_minus_theta && band.high < 1)
      near_pi = true;
    else if (band.region == Region::beyond_pi)
      beyond = true;
    else
      other = true;
  }
  if (has_angle(f) && !other && !beyond && near_pi && largest > 1e-100)
    return "acos of a number beyond 1 or -1";
  if (elsewhere * 10 > f.failed && !has_angle(f)) return "";
  if (other || near_pi || (largest < 0 && !beyond)) return "";
  if (largest < 0) return "theta^2 or a power of it overflows";
  if (beyond) return "";
  if (largest == 0) return "0/0 at theta = 0";
  if (operation_of(f) == "relative_angle") return "acos of a number above 1";
  if (has_angle(f) && largest > 1e-100) return "acos of a number above 1, or 0/0 at small theta";
  return zero ? fmt::format("0/0 for theta < {}", about(largest))
              : "theta^2 underflows to 0, and then something is divided by it";
}

/// The cases at moderate angles: those on another branch, those that fail by a thousandth or more, those that lose
/// four digits and keep four, and all.
struct Moderate {
  std::uint64_t other_branch = 0, wrong = 0, coarse = 0, all = 0;
  double largest = 0;                 ///< relative error of a coarse case
  std::map<int, std::uint64_t> bins;  ///< of the coarse cases
  /// Whether nine coarse cases of ten err by the same, but for a factor of 2, as a wrong constant does.
  bool same() const {
    std::uint64_t like = 0;
    for (const auto& [bin, count] : bins) like += bins.rbegin()->first - bin <= 32 ? count : 0;
    return 10 * like >= 9 * coarse;
  }
};
Moderate at_moderate_angles(const FailedBlock& f, double eps) {
  Moderate m;
  for (const BandOf& b : f.bands) {
    const Band& band = b.series->bands()[b.band];
    const bool moderate = (band.axis == Axis::theta && band.high == 1) ||
                          (band.axis == Axis::none && band.region == Region::to_pi);
    if (!moderate) continue;
    m.all += b.row->inside(), m.other_branch += b.row->wrong_branch, m.wrong += b.row->not_finite;
    for (const auto& [bin, count] : b.row->errors.bins())
      if (const double error = std::exp2(bin / 32.0); error > 1e-3 / eps)
        m.wrong += count;
      else if (error > 1e4 && error < 1e-4 / eps)
        m.coarse += count, m.largest = std::max(m.largest, error * eps), m.bins[bin] += count;
  }
  return m;
}

/// The convention in which the results at moderate arguments would be right, or "".
std::string convention(const FailedBlock& f) {
  const Series& series = *f.worst->series;
  const Operation& operation = *series.outputs.at(f.worst->output).record;
  conventions::Probed probed{&operation, {}};
  try {
    for (const conventions::Numbers& x : conventions::probe_arguments<double>(operation))
      if (auto result = result_of(series, operation, x); !result.empty())
        probed.answers.push_back({x, result});
    if (probed.answers.empty()) return "";
    const auto findings = conventions::explain({probed});
    if (findings.empty() || !findings.front().named) return "";
    const std::string& sentence = findings.front().sentence;
    std::string text = sentence.substr(0, sentence.find(" in " + std::string(operation.name)));
    if (const auto note = text.find(" (these operations do not tell which)"); note != text.npos)
      text.erase(note);
    return text;
  } catch (const std::exception&) {  // not an operation on fixed-size values
    return "";
  } catch (const GivenUp&) {
    return "";
  }
}

}  // namespace

std::string guess_of(const FailedBlock& f) {
  if (f.block == "jump")  // measured only beside common cutoffs
    return f.worst->series->bands()[f.worst->band].axis == Axis::theta
               ? fmt::format("a cutoff at theta about {}, at which the result jumps",
                             about(f.worst->series->bands()[f.worst->band].high))
               : "";
  const double eps = f.worst->series->eps;
  const Moderate m = at_moderate_angles(f, eps);
  if (m.other_branch * 5 > m.all && is_rotation_vector(f))
    return "the sign of w is not looked at: Q and -Q, the same rotation, give different results";
  const bool euler_angles = conventions::has_order(*f.worst->series->outputs.at(f.worst->output).record);
  if (m.wrong * 10 > m.all) {
    if (m.wrong * 3 <= m.all) return "";
    const std::string other =
        convention(f);  // most inputs of Euler angles are near gimbal lock, not moderate
    return !other.empty() || euler_angles || f.worst->series->on_robot ||
                   is_tree_law(f.worst->series->property)
               ? other
               : "a wrong term, factor or sign: moderate angles fail, too, and no other convention explains "
                 "the "
                 "results";
  }
  std::string all;
  for (const std::string& guess :
       {of_branch_near_pi(f), at_small_angles(f), near_pi(f), of_underflow(f), of_not_finite(f)})
    if (!guess.empty()) all += (all.empty() ? "" : "; and ") + guess;
  if (!all.empty()) return all;
  // A float rounds by 2^-24, and a formula may do so a dozen times.
  if (m.coarse * 2 > m.all && !euler_angles && (m.largest < 0x1p-20 || m.same()))
    return "a constant or a step of the calculation has too few digits, such as one in float, or a series or "
           "iteration ends too early: most cases at moderate angles fail, too";
  return "";
}

}  // namespace liecheck::properties

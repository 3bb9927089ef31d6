#pragma once
// The errors of a block over the angle, and what they have in common with those of formulas (shapes.hpp).

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <failures/shapes.hpp>
#include <map>
#include <numbers>
#include <search/plain.hpp>
#include <span>
#include <support/line_fit.hpp>

namespace liecheck::properties {

/// The errors in one band: x = log10 of its middle (theta, or pi - theta), y = log10 of error / limit, at least 0 and at
/// most where all digits are lost: larger errors tell nothing more; raw = log10 of the error, likewise.
struct BandPoint {
  double x, y, raw, low, high;
  bool lost = false;      ///< whether the error leaves at most one and a half digits
  bool zero = false;      ///< whether the worst result differs from the right one by its size, as 0 does
  bool opposite = false;  ///< whether it differs by twice its size, as the opposite result does
  bool still = false;     ///< whether it differs by theta, or pi - theta, as that of theta = 0, or pi, does
  std::uint64_t cases = 0, failed = 0;
  bool many_fail() const { return 4 * failed > cases; }  ///< as a formula does, for many inputs of a band
};

inline constexpr double steep =
    1.5;  ///< a factor of 30 between adjacent bands is no property of a smooth formula
inline constexpr std::uint64_t least_cases = 3;

inline bool is_rotation_vector(const FailedBlock& f) {
  return f.block == "rotation vector";
}
/// Whether formulas for the result have series in theta.
inline bool has_series(const FailedBlock& f) {
  constexpr std::string_view without[] = {"relative_angle", "angle_between", "rotation_between", "slerp"};
  return std::ranges::find(without, operation_of(f)) == std::end(without);
}
/// Whether nothing in the formula of a quaternion is singular near pi.
inline bool returns_quaternion(const FailedBlock& f) {
  return operation_of(f) == "exp3_quaternion" || operation_of(f) == "euler_to_quaternion" ||
         operation_of(f) == "quaternion_from_matrix" || operation_of(f) == "quaternion_of_drifted_matrix";
}
/// Whether the error is an angle, not relative to theta.
inline bool errs_by_angle(const FailedBlock& f) {
  return f.block == "rotation" || f.block == "direction";
}
/// Whether no input of an angle from 1 to pi - 1 fails.
inline bool moderate_angles_pass(const FailedBlock& f) {
  return std::ranges::none_of(f.bands, [](const BandOf& b) {
    const Band& band = b.series->bands()[b.band];
    return band.axis == Axis::none && band.region == Region::to_pi && b.row->failed > 0;
  });
}

/// The points of one axis, ascending. The lowest bands, in which theta^2 underflows, say nothing of a formula.
class Shape {
 public:
  Shape(const FailedBlock& f, Axis axis) : f_(f), axis_(axis), root_(std::sqrt(f.worst->series->eps)) {
    if (std::ranges::none_of(
            f.bands, [&](const BandOf& b) { return b.fails && b.series->bands()[b.band].axis == axis; }) &&
        std::ranges::any_of(f.bands, &BandOf::fails) && std::ranges::any_of(f.bands, &BandOf::expected))
      return;  // what fails here does so as a limits file expects
    std::map<std::size_t, BandPoint> by_band;
    for (const BandOf& b : f.bands) {
      const Band& band = b.series->bands()[b.band];
      const bool underflows = axis == Axis::theta && !band.name.starts_with("theta 1e");
      if (band.axis != axis || underflows || (!b.fails && !b.expected && b.row->failed > 0) ||
          band.low <= 1e-100 || b.row->errors.count() < least_cases)
        continue;
      const double eps = b.series->eps;
      const Budget& budget = b.series->budget(b.output, band.region);
      const double error = budget.rule == Rule::forward ? b.row->max_error : b.row->max_excess;
      const double raw = std::log10(std::clamp(error, 1.0, 1 / eps));
      BandPoint& point = by_band
                             .try_emplace(b.band, BandPoint{std::log10(std::sqrt(band.low * band.high)), 0, 0,
                                                            band.low, band.high})
                             .first->second;
      point.raw = std::max(point.raw, raw);
      point.y = std::max(point.y, raw - std::log10(std::max(budget.limit, 1.0)));
      point.cases += b.row->errors.count(), point.failed += b.row->failed;
      point.lost |= error * eps > 0.03;
      point.zero |= std::fabs(error * eps - 1) < 1e-6, point.opposite |= std::fabs(error * eps - 2) < 1e-6;
      point.still |= error * eps > 0.5 * band.low && error * eps < 2 * band.high;
    }
    for (const auto& [band, p] : by_band) points_.push_back(p);
    std::ranges::sort(points_, {}, &BandPoint::x);
    if (!points_.empty())
      peak_ =
          static_cast<std::size_t>(std::ranges::max_element(points_, {}, &BandPoint::y) - points_.begin());
  }

  std::string at_small_angles() const;
  std::string near_pi() const;

 private:
  bool falls_above() const;
  const BandPoint& p(std::size_t i) const { return points_[i]; }
  std::size_t size() const { return points_.size(); }
  double y(std::size_t i) const { return i < size() ? p(i).y : 0; }
  double raw(std::size_t i) const { return i < size() ? p(i).raw : 0; }
  /// Whether band i errs far less than the worst.
  bool falls(std::size_t i) const { return y(i) < y(peak_) - steep; }
  bool near_root(double theta) const { return std::fabs(std::log10(theta / root_)) < 1.6; }

  /// The number of bands up to the last one in which all digits are lost.
  std::size_t lost_bands() const {
    const auto last =
        std::find_if(points_.rbegin(), points_.rend(), [](const BandPoint& q) { return q.lost; });
    return static_cast<std::size_t>(points_.rend() - last);
  }
  /// The slope of y over x where the error is above its limit, from a band on; 0 in fewer than three bands.
  double slope_from(std::size_t first) const {
    LineFit fit;
    for (const BandPoint& q : std::span(points_).subspan(first))
      if (q.y > 0.5) fit.add(q.x, q.y);
    if (fit.count() < 3) return 0;
    const double of_bands = fit.slope();
    // Of few random inputs in each band.
    const double of_plain = slope_of_errors(*f_.worst->series, static_cast<int>(f_.worst->output),
                                            p(first).low, 1, axis_ != Axis::theta);
    return of_plain < 0 && of_bands < 0 ? of_plain : of_bands;
  }
  double slope() const { return slope_from(lost_bands()); }  ///< above those that have lost all digits
  /// Whether an angle has lost all digits below the root of eps, in some bands by chance, and errs by 1 / theta^2 above it.
  bool is_acos_of_angle() const {
    std::size_t below = 0, lost = 0;
    while (below < size() && p(below).high < 2 * root_) lost += p(below++).lost;
    return has_angle(f_) && lost > 1 && slope_from(below) < -1.2 && slope_from(below) > -2.8;
  }
  /// Where failures begin or end, between a band that fails and the next one. Near pi its angle is pi - theta.
  std::optional<Crossing> crossing(const BandPoint& failing, const BandPoint& passing) const {
    const bool below = failing.x < passing.x;
    const auto inside = [&](const BandPoint& q, double share) {  // from the lower edge up
      const double at = std::pow(q.low, 1 - share) * std::pow(q.high, share);
      return axis_ == Axis::theta ? at : std::numbers::pi - at;
    };
    for (const double from : {0.1, 0.5, 0.9})
      for (const double to : {0.9, 0.5, 0.1})
        if (auto c = angle_between(*f_.worst->series, static_cast<int>(f_.worst->output),
                                   inside(failing, below ? from : to), inside(passing, below ? to : from))) {
          if (axis_ != Axis::theta) c->angle = std::numbers::pi - c->angle;
          return c;
        }
    return std::nullopt;
  }
  /// A cutoff between two bands, or near them: where the errors of plain inputs change at once, and which formula is wrong there.
  /// Without such a step, by the bands: whether errors are large above it.
  std::string cutoff_at(const BandPoint& failing, const BandPoint& passing, bool above) const {
    const double middle = failing.x < passing.x ? failing.high : failing.low;
    const auto step = step_of_errors(*f_.worst->series, static_cast<int>(f_.worst->output), middle / 100,
                                     std::min(middle * 100, 1.0), false);
    const std::string at = step ? short_angle(step->angle) : border(failing, passing);
    const bool upward = step ? step->above > step->below : above;
    const bool both = step && step->above > 1 && step->below > 1;
    return fmt::format("a cutoff at theta about {}: {}", at,
                       both     ? "above it the closed form cancels, and the series below it lacks a term"
                       : upward ? "above it the closed form cancels, the more the smaller theta is"
                                : "the series below it lacks a term, or has a wrong one");
  }
  /// That results are 0 up to a band, and how their errors fall from it on.
  std::string zero_below(std::size_t band) const {
    const auto last = last_zero(*f_.worst->series, static_cast<int>(f_.worst->output), p(band - 1).low / 10,
                                std::min(p(band).high * 10, 1.0));
    const double power = slope_from(band);
    const std::string above =
        power > -0.7 ? ""
                     : fmt::format("; above it, something cancels, and the error grows as 1 / theta{}",
                                   std::lround(-power) > 1 ? fmt::format("^{}", std::lround(-power)) : "");
    return fmt::format("the result is 0 where theta is below about {}: a threshold{}{}",
                       last ? short_angle(*last) : border(p(band - 1), p(band)),
                       near_root(last.value_or(p(band).low)) ? ", or acos of a number that rounds to 1" : "",
                       above);
  }
  /// The angle of this, else the border of both bands.
  std::string border(const BandPoint& failing, const BandPoint& passing) const {
    const auto c = crossing(failing, passing);
    return c ? short_angle(c->angle) : power_of_ten(failing.x < passing.x ? failing.high : failing.low);
  }
  /// The band from which the errors start at once, and then fall over bands, if there is one: there a closed form begins.
  std::optional<std::size_t> sharp_start() const {
    for (std::size_t i = 1; i + 1 < size(); ++i) {
      const bool first = y(i - 1) > 0 ? !p(i - 1).many_fail() : raw(i) - raw(i - 1) > steep;
      if (!first || !p(i).many_fail()) continue;
      std::size_t last = i;
      while (y(last + 1) > 0) ++last;
      const bool falls_after =
          last > i && y(last) < std::min(y(peak_) - 0.5, steep) && peak_ <= last && peak_ < i + 5;
      if (!falls_after) continue;
      const auto c = crossing(p(i), p(i - 1));
      if (!c || c->passing < 0.3) return i;
    }
    return std::nullopt;
  }
  /// Whether the errors fall by half a power of ten a band at least, from band i to the last one that fails.
  bool fall_from(std::size_t i) const {
    std::size_t last = i;
    while (last + 1 < size() && y(last + 1) > 0) ++last;
    return raw(i) - raw(last) >= 0.5 * static_cast<double>(last - i);
  }
  /// Whether the errors of the three bands up to i grow as theta.
  bool grows_up_to(std::size_t i) const {
    for (std::size_t k = i; k + 3 > i; --k)
      if (k == 0 || y(k) - y(k - 1) < 0.5 || y(k) - y(k - 1) > steep) return false;
    return true;
  }
  /// The band from which errors that grow are far larger at once, and then fall over bands.
  std::optional<std::size_t> step_up() const {
    for (std::size_t i = 1; i + 2 < size(); ++i)
      if (y(i) - y(i - 1) > 1 + steep && grows_up_to(i - 1) && y(i + 1) > 0 && y(i + 2) > 0) return i;
    return std::nullopt;
  }
  /// Whether the error grows as theta up to the root of eps and falls above, as that of 1 - cos does, which is 0 below.
  bool is_of_cosine() const {
    return peak_ >= 4 && near_root(std::pow(10, p(peak_).x)) && y(peak_ + 2) > 0 && y(peak_ + 2) < y(peak_) &&
           raw(peak_) - raw(peak_ + 1) < 2 && std::fabs(y(peak_) - y(peak_ - 1)) < steep &&
           (grows_up_to(peak_ - 1) || grows_up_to(peak_));
  }
  /// Whether the errors are those of 1 - w^2 in place of |v|^2: they grow as theta^2 up to the fourth root of eps, and fall as
  /// 1 / theta^2 above it, by two powers of ten a band, of which random inputs may show one less or one more.
  bool is_of_w_squared() const {
    return (operation_of(f_) == "log3_quaternion" || operation_of(f_) == "axis_angle_from_quaternion") &&
           peak_ >= 2 && peak_ + 2 < size() && std::fabs(p(peak_).x - std::log10(root_) / 2) < 1.1 &&
           y(peak_ - 1) > 0 && y(peak_ + 1) > 0 && raw(peak_) - raw(peak_ - 2) > 1.2 &&
           raw(peak_) - raw(peak_ + 2) > 1.2 &&
           std::max(raw(peak_) - raw(peak_ - 1), raw(peak_) - raw(peak_ + 1)) < 2.7;
  }
  /// Whether the largest errors below the root of eps are those of the root of eps, and fall above it.
  bool keeps_half() const {
    const double half = -std::log10(root_);
    std::size_t below = 0, as_large = 0;
    while (below < size() && p(below).x < std::log10(root_)) as_large += std::fabs(raw(below++) - half) < 0.8;
    return has_angle(f_) && as_large >= 3 && peak_ <= below && raw(peak_) < half + 0.8 && y(below) > 0 &&
           y(below + 2) < y(below);
  }
  /// The number of the lowest bands in which all digits are lost, if the next one is right.
  std::size_t wrong_bands() const {
    std::size_t wrong = 0;
    while (wrong < size() && p(wrong).lost) ++wrong;
    return wrong > 2 && wrong < size() && y(wrong) < 1 ? wrong : 0;
  }
  std::string below_cutoff() const {
    BandPoint next{};
    next.x = 0.3, next.low = 1, next.high = 2;  // moderate angles are no band of this axis
    const BandPoint& above = peak_ + 1 < size() ? p(peak_ + 1) : next;
    const std::string at = border(p(peak_), above);
    if (errs_by_angle(f_) && p(peak_).still && p(peak_ - 1).still)
      return fmt::format("a threshold at theta about {}, below which the result is that of theta = 0", at);
    if (has_series(f_)) return cutoff_at(p(peak_), above, false);
    // An error that falls below its limit without a step, as one of rounding does, has no threshold.
    if (const auto c = crossing(p(peak_), above); c && c->passing > 0.3) return "";
    return fmt::format("a threshold at theta about {}, below which another formula is coarser{}", at,
                       operation_of(f_) == "slerp" ? ", such as linear interpolation" : "");
  }

  /// Of errors in one band alone: on the side of a cutoff they begin at once, on the other they come from below the limit.
  std::string of_one_band() const {
    const bool last_goes_on = peak_ + 1 == size() && !moderate_angles_pass(f_);  // to these
    if (peak_ == 0 || y(peak_ - 1) > 0 || y(peak_ + 1) > 0 || last_goes_on || !p(peak_).many_fail())
      return "";
    const auto below = crossing(p(peak_), p(peak_ - 1));
    const auto above = peak_ + 1 < size() ? crossing(p(peak_), p(peak_ + 1)) : std::nullopt;
    const bool from = below && below->passing < 0.3, to = above && above->passing < 0.3;
    if (from == to) return "";
    return from ? cutoff_at(p(peak_), p(peak_ - 1), true) : cutoff_at(p(peak_), p(peak_ + 1), false);
  }

  const FailedBlock& f_;
  Axis axis_;
  double root_;
  std::vector<BandPoint> points_;
  std::size_t peak_ = 0;
};

}  // namespace liecheck::properties

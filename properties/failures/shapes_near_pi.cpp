#include <failures/error_shape.hpp>

namespace liecheck::properties {

/// Whether the errors of the bands above the largest one fall as the square of 1 / (pi - theta), over four bands at least.
bool Shape::falls_above() const {
  std::size_t last = peak_;
  while (last + 1 < size() && y(last + 1) > 0.5) ++last;
  return last >= peak_ + 3 && raw(peak_) - raw(last) > 1.5 * static_cast<double>(last - peak_);
}

std::string Shape::near_pi() const {
  if (size() < 4) return "";
  if (falls_above() && is_rotation_vector(f_))
    return "sin near pi: something is divided by sin(theta), or theta comes from acos: the error grows as 1 "
           "/ (pi - theta)^2";
  const bool stays = operation_of(f_) != "angle_between" && peak_ >= 2 && y(peak_) > 1 &&
                     p(peak_ - 1).still && y(peak_ - 2) < y(peak_ - 1) && peak_ + 1 < size() &&
                     falls(peak_ + 1);
  const auto step = stays ? step_of_errors(*f_.worst->series, static_cast<int>(f_.worst->output),
                                           p(peak_).low / 10, std::min(p(peak_).high * 10, 1.0), true)
                          : std::nullopt;
  if (step)
    return fmt::format(
        "a threshold at pi - theta about {}, below which the result is that of theta = pi, or of another "
        "axis{}{}",
        short_angle(step->angle),
        near_root(step->angle) && operation_of(f_) != "rotation_between"
            ? ", or acos of a number that rounds to -1"
            : "",
        !has_series(f_) && y(peak_ + 1) > 0 ? "; above it, 1 + cos(theta) or the cross product cancels" : "");
  if (!has_series(f_) && !has_angle(f_)) {
    std::size_t lost = 0;
    while (lost < size() && p(lost).lost) ++lost;
    if (lost > 1 && lost < size() && p(lost).y < 1 && p(lost).low < 1.01 * p(lost - 1).high)
      return fmt::format("a threshold between pi - theta = {} and {}, below which the result is wrong",
                         power_of_ten(p(lost - 1).low), power_of_ten(p(lost - 1).high));
    if (p(0).y > steep && slope() < -0.5)
      return "1 + cos(theta), or the cross product of the arguments, cancels where they are nearly opposite";
    return "";
  }
  if (const std::size_t wrong = operation_of(f_) == "log3_matrix" ? wrong_bands() : 0)
    return fmt::format(
        "a threshold at pi - theta about {}, below which the axis has wrong signs: the roots of the diagonal "
        "of R have none",
        border(p(wrong - 1), p(wrong)));
  if (keeps_half())
    return fmt::format("{}, which keeps half of the digits near pi; atan2 of both parts does not",
                       operation_of(f_) == "angle_between" ? "acos near -1" : "acos near -1, or asin near 1");
  // Nearer to pi than the root of eps, the results of any formula are lost, or on another branch.
  if (const auto start = sharp_start(); start && p(*start).low > root_)
    return fmt::format(
        "a threshold at pi - theta about {}: beyond it something is divided by sin(theta) or "
        "sqrt(1 + trace), which cancel near pi",
        border(p(*start), p(*start - 1)));
  if (is_of_cosine() && (operation_of(f_).starts_with("log3_quaternion") || has_angle(f_)))
    return fmt::format("{}, which keeps half of the digits near pi; atan2 of both parts does not",
                       operation_of(f_) == "angle_between" ? "acos near -1" : "acos near -1, or asin near 1");
  if (is_of_cosine())
    return fmt::format(
        "1 + cos(theta) cancels near pi, and is 0 where pi - theta is below about {}: "
        "(1 + cos(theta)) / sin(theta) is 1 / tan(theta / 2)",
        short_angle(root_));
  const double power = p(0).y > steep ? slope() : 0;
  if (power < -0.5 && power > -2.5 && returns_quaternion(f_))
    return "a quaternion from a rotation matrix: something is divided by w = sqrt(1 + trace) / 2, which "
           "cancels near pi";
  if (power < -0.5 && power > -2.5)
    return fmt::format(
        "sin near pi: something is divided by sin(theta), or theta comes from acos: the error grows as "
        "1 / (pi - theta){}",
        std::lround(-power) > 1 ? "^2" : "");
  return "";
}

std::string shape_near_pi(const FailedBlock& f) {
  return Shape(f, Axis::pi_minus_theta).near_pi();
}

}  // namespace liecheck::properties

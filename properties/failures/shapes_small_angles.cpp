#include <failures/error_shape.hpp>

namespace liecheck::properties {

std::string Shape::at_small_angles() const {
  if (size() < 5 || y(peak_) < 1) {
    const auto start = size() < 5 || !has_series(f_) ? std::nullopt : sharp_start();
    if (!start) return "";
  }
  const bool to_one = peak_ + 1 == size() && p(peak_).high == 1 && moderate_angles_pass(f_),
             ends_below = peak_ > 0 && falls(peak_ - 1),
             ends_above = to_one || (peak_ + 1 < size() && falls(peak_ + 1));
  const double of_vector = is_rotation_vector(f_) ? slope() : 0;
  // Below the root of eps the cosine is 1, and its acos is 0. The angle between two quaternions errs by chance there.
  if (is_rotation_vector(f_)
          ? of_vector < -1.5 && of_vector > -2.5 && (!ends_below || near_root(p(peak_).low))
          : is_acos_of_angle())
    return "acos near 1, which keeps half of the digits: the error grows as 1 / theta^2; atan2 of both parts "
           "does not";
  if (is_rotation_vector(f_) && std::ranges::count_if(points_, &BandPoint::opposite) > 1 &&
      std::ranges::all_of(points_, [](const BandPoint& q) { return q.y == 0 || q.opposite; }))
    return "a sign: the result is the opposite of the right one; the rotation vector of Q with w < 0 is that "
           "of -Q";
  if (is_of_w_squared())
    return "1 - w^2 cancels as theta goes to 0, in sqrt(1 - w^2) for |v|, for example: |v| keeps all digits";
  if (const auto start = has_series(f_) ? sharp_start() : std::nullopt)
    return cutoff_at(p(*start), p(*start - 1), true);
  if (const auto step = has_series(f_) ? step_up() : std::nullopt)
    return cutoff_at(p(*step), p(*step - 1), true);
  if (has_series(f_) && ends_below && y(peak_ + 1) > 0.5 && p(peak_).many_fail() && fall_from(peak_))
    return cutoff_at(p(peak_), p(peak_ - 1), true);
  if (has_series(f_) && is_of_cosine() && f_.block == "coupling")
    return "a missing series: theta - sin(theta), or 1 - theta^2 / 2 - cos(theta), cancels as theta goes to "
           "0";
  if (has_series(f_) && is_of_cosine())
    return fmt::format(
        "1 - cos(theta) cancels, and is 0 below theta about {}: 2 sin(theta / 2)^2 keeps all digits",
        short_angle(root_));
  if (errs_by_angle(f_) && p(peak_).still && near_root(p(peak_).high) && y(peak_ + 1) > 0.3 &&
      y(peak_ + 1) < y(peak_))
    return "acos near 1, which keeps half of the digits; atan2 of both parts does not";
  if (peak_ >= 2 && y(peak_ - 1) > 0.3 && y(peak_ - 2) <= y(peak_ - 1) && ends_above && falls(peak_ - 2) &&
      (p(peak_).many_fail() || p(peak_ - 1).many_fail()))
    return below_cutoff();
  if (const std::string alone = has_series(f_) ? of_one_band() : ""; !alone.empty()) return alone;
  std::size_t first = 0;  // angles below the resolution of the arguments are 0
  while (first < size() && y(first) == 0) ++first;
  std::size_t zeros = first;
  while (zeros < size() && p(zeros).zero) ++zeros;
  if (zeros > first + 1 && zeros < size() && y(zeros) < y(zeros - 1) - steep &&
      p(zeros).low < 1.01 * p(zeros - 1).high)  // the next band has cases, too
    return zero_below(zeros);
  if (has_series(f_) && peak_ >= 3 && peak_ + 3 < size() && falls(peak_ - 3) && falls(peak_ + 3) &&
      p(peak_).many_fail() && y(peak_ - 1) > 0 && y(peak_ + 1) > 0)
    return fmt::format("a cutoff at theta about {}, towards which the errors of both formulas grow",
                       power_of_ten(y(peak_ + 1) > y(peak_ - 1) ? p(peak_).high : p(peak_).low));
  const double power = is_rotation_vector(f_) ? of_vector : slope();
  if (power > -0.5 || p(0).y < y(peak_) - steep) return "";
  if (operation_of(f_).starts_with("log3_quaternion") || operation_of(f_) == "log3_any_norm") {
    std::uint64_t cases = 0, failed = 0;  // half of the stored quaternions have w < 0
    for (const BandPoint& q : points_) cases += q.y > 0.5 ? q.cases : 0, failed += q.y > 0.5 ? q.failed : 0;
    if (failed * 10 > cases * 2 && failed * 10 < cases * 8)
      return "where w < 0, the angle 2 atan2(|v|, w) is near 2 pi, and 2 pi - angle cancels; -Q is the same "
             "rotation, with w > 0";
  }
  return fmt::format(
      "a missing series: the formula cancels as theta goes to 0, and the error grows as 1 / theta{}",
      std::lround(-power) > 1 ? fmt::format("^{}", std::lround(-power)) : "");
}

std::string shape_at_small_angles(const FailedBlock& f) {
  return Shape(f, Axis::theta).at_small_angles();
}

}  // namespace liecheck::properties

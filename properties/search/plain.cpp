#include <search/plain.hpp>

#include <algorithm>
#include <cmath>
#include <invariants/property.hpp>
#include <numbers>
#include <support/stop.hpp>

namespace liecheck::properties {

namespace {

using Plain = std::vector<double>;  // numbers of a group or of an input

/// A round angle in a band [rad].
double angle_in(const Band& b) {
  if (b.axis == Axis::theta) return b.high == 0 ? 0 : b.low > 0 ? 3 * b.low : b.high / 2;
  if (b.axis == Axis::pi_minus_theta) return b.low > 0 ? std::numbers::pi - 3 * b.low : std::numbers::pi;
  if (b.region == Region::to_pi) return 1.5;
  return b.low < 4 ? 4 : b.low < 10 ? 6 : 200;
}

/// The rotation vector of an angle about one of three axes.
Plain turn_by(double angle, std::size_t axis) {
  if (axis == 1) return {0, 0, angle};
  if (axis == 2) return {angle * 2 / 3, -angle / 3, angle * 2 / 3};
  return {angle, 0, 0};
}
Plain quaternion_of(const Plain& phi, double sign) {
  const double theta = std::hypot(phi[0], phi[1], phi[2]), s = theta > 0 ? std::sin(theta / 2) / theta : 0.5;
  return {sign * s * phi[0], sign * s * phi[1], sign * s * phi[2], sign * std::cos(theta / 2)};
}
Plain matrix_of(const Plain& phi) {
  const Plain q = quaternion_of(phi, 1);
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  return {1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
          2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
          2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)};
}
bool turns(Kind kind) {
  return kind == Kind::rotation_vector || kind == Kind::quaternion || kind == Kind::any_quaternion ||
         kind == Kind::rotation_matrix;
}

/// The vectors of an input, in their order.
struct Vectors {
  Plain first, second, others;
};
const Vectors vectors[] = {{{1, 2, 3}, {2, -1, 0.5}, {0.5, 3, -1}},
                           {{1, 0, 0}, {0, 0, 0}, {0, 0, 0}},
                           {{1, 2, 3}, {1 + 1e-7, 2, 3}, {1, 0, 0}}};

/// One choice for each group: `turned` is the group with the angle, all others keep still, or all have it.
Plain input_of(const std::vector<Field>& fields, std::size_t turned, double angle, std::size_t axis, double sign,
               const Vectors& of) {
  Plain all;
  std::size_t vectors_before = 0;
  for (std::size_t k = 0; k < fields.size(); ++k) {
    const Field& f = fields[k];
    const auto size = static_cast<std::size_t>(f.size);
    const bool turn_it = turned == fields.size() || k == turned;
    const Plain phi = turn_it ? turn_by(angle, axis) : Plain{0, 0, 0};
    Plain group(size, 0);
    if (f.kind == Kind::rotation_vector && size == 3)
      group = phi;
    else if ((f.kind == Kind::quaternion || f.kind == Kind::any_quaternion) && size == 4)
      group = quaternion_of(phi, turn_it ? sign : 1);
    else if (f.kind == Kind::rotation_matrix && size == 9)
      group = matrix_of(phi);
    else if (f.kind == Kind::vector && size == 3)
      group = vectors_before == 0 ? of.first : vectors_before == 1 ? of.second : of.others, ++vectors_before;
    else if (f.kind == Kind::direction && size > 0)
      group[0] = 1;
    else if (f.kind == Kind::fraction)
      group.assign(size, 0.25);
    else if (f.kind == Kind::angle)
      group.assign(size, std::min(angle, 3.0));
    else if (f.kind == Kind::positive)
      group.assign(size, 1);
    else if (f.kind == Kind::inertia && size == 9)
      group = {0.5, 0, 0, 0, 0.75, 0, 0, 0, 1};
    else if (f.kind != Kind::choice)
      return {};
    all.insert(all.end(), group.begin(), group.end());
  }
  return all;
}

}  // namespace

std::optional<Shrunk> plain_failure(const Series& series, const CaseId& worst, int output,
                                    const std::vector<BandOfFailure>& bands) {
  const Property& law = series.tested_law();
  const auto failure_in = [&](const std::vector<Judged>& judged) -> std::optional<Judged> {
    for (const Judged& j : judged)
      if (j.failed && j.residual.output == output) return j;
    return std::nullopt;
  };
  const auto first = failure_in(series.measure_twice(series.numbers(worst)));
  if (!first || is_misuse(first->residual.outcome) || first->residual.outcome == Outcome::crashed) return std::nullopt;
  const auto score = [&](const Judged& j) {
    return std::min(j.budget && j.budget->rule == Rule::excess ? j.excess : j.residual.error, 1 / series.eps);
  };
  const auto as_bad = [&](const Judged& j) {
    if (j.residual.outcome != first->residual.outcome) return false;
    const auto band = std::ranges::find(bands, j.residual.band, &BandOfFailure::band);
    return band != bands.end() &&
           (j.residual.outcome != Outcome::measured || 10 * score(j) >= std::min(band->score, 1 / series.eps));
  };
  const std::size_t fields = series.fields.size();
  for (const BandOfFailure& band : bands)
    for (const Vectors& of : vectors)
      for (const double sign : {1.0, -1.0})
        for (std::size_t turned = fields + 1; turned-- > 0;)
          for (std::size_t axis = 0; axis < 3; ++axis) {
            if (turned < fields && !turns(series.fields[turned].kind)) continue;
            if (stop_requested) return std::nullopt;
            Plain x = input_of(series.fields, turned, angle_in(series.bands()[band.band]), axis, sign, of);
            for (double& number : x) number = series.format().rounded(number);
            if (x.empty() || !law.takes(x.size()) || !law.valid(x)) continue;
            const auto j = failure_in(series.measure(x));
            if (!j || !as_bad(*j)) continue;
            Shrunk s{worst, {}, *j, true};
            s.id.raw = true, s.id.input.clear();
            for (const double number : x) {
              s.id.input.push_back(hexadecimal_float(number));
              s.decimal.push_back(decimal_float(number, series.format()));
            }
            return s;
          }
  return std::nullopt;
}

}  // namespace liecheck::properties

#include <hard_cases/attempt.hpp>

#include <algorithm>
#include <campaign/series.hpp>
#include <cstdint>
#include <invariants/common.hpp>
#include <limits>
#include <oracles/linear_algebra.hpp>

namespace liecheck::properties {
namespace {

// The input domain of docs/measuring.md: rotations that are off unit or off orthogonal by at most 8 eps, and
// no reflections. Outside this domain a subject may refuse the input at its checked entrance. If it does not,
// its result is judged by the rotation nearest to the stored numbers.

/// f(is_quaternion, position, numbers) for every quaternion and rotation matrix of an input.
template <class F>
void for_each_rotation(const std::vector<Field>& fields, const std::vector<double>& x, F f) {
  std::size_t from = 0;
  for (const Field& field : fields) {
    const auto begin = x.begin() + static_cast<std::ptrdiff_t>(from);
    if (field.kind == Kind::quaternion || field.kind == Kind::rotation_matrix)
      f(field.kind == Kind::quaternion, from, std::vector<double>(begin, begin + field.size));
    from += static_cast<std::size_t>(field.size);
  }
}

/// How far the worst rotation of an input is from one.
enum class Off : std::uint8_t {
  no,        ///< at most 8 eps
  slightly,  ///< as after many products, or after reading six digits: a result is expected to be finite
  far        ///< or a reflection
};
/// The largest defect, | ||Q||^2 - 1 | or ||R^T R - I||, of a rotation that is slightly off.
constexpr double slight_defect = 1e-5;

/// Replaces every finite rotation outside the domain by the identity. Returns how far the worst is off.
Off set_identity_where_off(const Scalar& scalar, const std::vector<Field>& fields, std::vector<double>& x) {
  Off worst = Off::no;
  for_each_rotation(fields, std::vector<double>(x),
                    [&](bool quaternion, std::size_t from, const std::vector<double>& values) {
                      for (const double v : values)
                        if (!std::isfinite(v)) return;
                      Reader read(values);
                      double defect = 0;
                      if (quaternion) {
                        defect = norm_defect_at(scalar, values, 0);
                      } else {
                        const auto R = oracles::exact_matrix<3, 3, Real>(read.take_matrix());
                        defect = determinant(R, cofactors(R)) <= 0 ? std::numeric_limits<double>::infinity()
                                                                   : oracles::orthogonality_defect(scalar, R);
                      }
                      if (defect <= 8) return;
                      worst = std::max(worst,
                                       defect * scalar.epsilon <= slight_defect ? Off::slightly : Off::far);
                      for (std::size_t i = 0; i < values.size(); ++i)
                        x[from + i] = (quaternion ? i == 3 : i % 4 == 0) ? 1 : 0;
                    });
  return worst;
}

/// Calls the subject's checked entrance, whose exceptions pass through.
void check_entrance(const Operations& o, const std::vector<Field>& fields, const std::vector<double>& x) {
  if (!o.check_quaternion && !o.check_rotation) return;
  for_each_rotation(fields, x, [&](bool quaternion, std::size_t, const std::vector<double>& values) {
    Reader read(values);
    if (quaternion && o.check_quaternion) o.check_quaternion(read.take<4>());
    if (!quaternion && o.check_rotation) o.check_rotation(read.take_matrix());
  });
}

/// Whether the outcome is about the numbers of a result, and not about how the call ended.
bool of_result(Outcome outcome) {
  using enum Outcome;
  return outcome == measured || outcome == ill_posed || outcome == not_finite || outcome == wrong_branch ||
         outcome == not_repeatable;
}

}  // namespace

Trial attempt(const Series& series, const CaseId& address) {
  Trial trial;
  Off off = Off::no;
  std::vector<double> x;
  if (address.raw) {
    x = series.parsed(address);
    std::vector<double> in_domain = x;
    off = set_identity_where_off(series.format(), series.fields, in_domain);
    trial.in_domain = off == Off::no;
    series.check_valid(in_domain, address);
  } else {
    x = series.numbers(address);
  }
  for (const double v : x) trial.input.push_back(hexadecimal_float(v));
  Judge balls = series.judge_of_balls();
  // The call of an operation has one result for all oracles.
  const Series::Checking checking(series, true);
  try {
    check_entrance(series.tested_subject().operations, series.fields, x);
    trial.judged = series.measure_by_digits(x, series.limits(), true, &trial.refusal);
    // Hard cases in the domain of the ball arithmetic also test the ball arithmetic. It computes kappa only where
    // a verdict needs it; if that makes a difference, it is compared with digits that do the same.
    if (trial.in_domain && trial.refusal.empty() && series.measure_by_balls(x, balls) &&
        !agree(balls.judged, trial.judged) &&
        !agree(balls.judged, series.measure_by_digits(x, series.limits())))
      for (Judged& j : trial.judged) j.residual.outcome = Outcome::unresolved, j.failed = false;
    checking.judge(trial.judged);
  } catch (const std::bad_alloc&) {
    throw;  // says nothing about the subject
  } catch (const std::exception& e) {
    trial.refusal = e.what();
    balls.judged.clear();
    balls.outcome(series.outputs.front(), 0, Outcome::refused);
    trial.judged = std::move(balls.judged);
  }
  if (trial.in_domain) return trial;
  for (Judged& j : trial.judged) {
    if (j.residual.outcome == Outcome::refused) j.failed = false;
    // Outside the domain, an unresolved input has no exact result: any result counts as a wrong branch.
    if (j.residual.outcome == Outcome::unresolved)
      j.residual.outcome = Outcome::wrong_branch, j.failed = true;
    // Only the profile `ours` promises that such an input is refused, or means the rotation nearest to it. But nothing
    // excuses a NaN where the rotation is off by some roundings.
    const bool excused = off == Off::far || j.residual.outcome != Outcome::not_finite;
    if (series.profile != Profile::ours && of_result(j.residual.outcome) && excused)
      j.residual.outcome = Outcome::outside_domain, j.failed = false;
  }
  return trial;
}

bool concerns(const HardCase& h, const Series& s) {
  return !s.on_robot && std::ranges::count(h.properties, s.property) &&
         (h.scalars.empty() || std::ranges::count(h.scalars, s.scalar));
}

CaseId raw_case(const Series& s, const HardCase& h) {
  CaseId id = s.id(0, 0);
  id.raw = true, id.input = numbers_of(h, s.fields, s.format());
  return id;
}

}  // namespace liecheck::properties

#pragma once
// Compares the residuals of one case with their budgets, and the verdicts from two oracles with each other.

#include <algorithm>
#include <array>
#include <campaign/tally.hpp>
#include <generators/angle_bands.hpp>
#include <limits>
#include <oracles/undecided.hpp>
#include <vector>

namespace liecheck::properties {

/// The relative accuracy of a condition number in ball arithmetic (oracles::condition_number).
inline constexpr double kappa_accuracy = 0.02;

/// Above half of this, an excess is exact whatever the limit is: cliffs.hpp compares excesses of bands.
inline constexpr double largest_inexact_limit = 64;

/// The budgets of one output, up to theta = pi and beyond.
struct OutputLimits {
  const Block* definition;
  std::array<const Budget*, 2> budgets;
  bool ordinary = false;  ///< Recorder::ordinary
};
/// The limits of a law's outputs, in their order.
using Limits = std::vector<OutputLimits>;

/// Collects the residuals of one case and compares each with its budget.
class Judge final : public Recorder {
 public:
  /// `accuracy` is the uncertainty of the recorded errors, relative or in eps, whichever is larger. At 50
  /// digits it is 0. If `every_kappa`, kappa is computed even if the error passes for every kappa, so that
  /// an ill-posed case is always recognised.
  Judge(const Limits& limits, const Scalar& scalar, double accuracy, bool every_kappa = false)
      : Recorder(scalar),
        limits_(limits),
        bands_(Bands::of(scalar)),
        eps_(scalar.epsilon),
        accuracy_(accuracy),
        every_kappa_(every_kappa) {
    judged.reserve(limits.size());
  }

  void record(const Output& output, std::size_t band, double error, Kappa kappa) override {
    Judged j = start(output, band);
    j.residual.error = error;
    // The result is finite: an error too large for a double is one of 0, or of a number that is nearly 0. Under the excess
    // rule it is no failure if kappa makes the case ill-posed.
    const bool overflowed = error == std::numeric_limits<double>::infinity();
    if (overflowed) j.residual.error = error = std::numeric_limits<double>::max();
    if (!(error >= 0)) {
      j.residual.outcome = Outcome::not_finite;
      j.failed = true;
    } else if (j.budget->rule == Rule::forward) {
      j.failed = !(error <= j.budget->limit);
      decided(error, j.budget->limit, accuracy_);
    } else if (!every_kappa_ && kappa.least() * eps_ < 1 &&
               error <= std::min(j.budget->limit, largest_inexact_limit) / 2 * kappa.least()) {
      // It passes for every kappa. An excess above half the limit is exact, one below may be an upper bound.
      j.excess = error / kappa.least();
    } else {
      const double k = kappa ? kappa() : 1.0;
      j.residual.kappa = k;
      j.ill_posed = !(k * eps_ < 1);
      j.excess = j.ill_posed ? 0 : error / std::max(k, 1.0);
      const double accuracy = accuracy_ > 0 ? kappa_accuracy : 0;
      decided(k * eps_, 1, accuracy);
      if (!j.ill_posed) decided(j.excess, j.budget->limit, accuracy);
      j.failed = !j.ill_posed && !(j.excess <= j.budget->limit);
      if (overflowed && j.ill_posed) j.residual.error = std::numeric_limits<double>::infinity();
      // If kappa is below the law's lower bound, verdicts that relied on this bound may be wrong.
      if (kappa.least() > 1 && k * (1 + 2 * kappa_accuracy) < kappa.least())
        j.residual.outcome = Outcome::unresolved;
    }
    judged.push_back(j);
  }
  void outcome(const Output& output, std::size_t band, Outcome outcome) override {
    Judged j = start(output, band);
    j.residual.outcome = outcome;
    j.ill_posed = outcome == Outcome::ill_posed;
    j.failed = !j.ill_posed && !leaves_open(outcome) && outcome != Outcome::outside_domain;
    // A call without a result ends the case.
    if (outcome == Outcome::refused || outcome == Outcome::crashed) recorded_ = ~0u;
    judged.push_back(j);
  }
  double limit(const Output& output, std::size_t band) const override {
    return budget(index(output), band)->limit;
  }
  bool ordinary(const Output& output) const override { return limits_[index(output)].ordinary; }
  /// Ends a case: each of the outputs (bit i for output i) that has no record is unmeasured, or what `as` says.
  void close(std::uint32_t outputs, Outcome as = Outcome::unmeasured) {
    for (std::size_t i = 0; i < limits_.size(); ++i)
      if ((outputs & ~recorded_) >> i & 1) {
        Judged j;
        j.residual.output = static_cast<std::uint16_t>(i);
        j.residual.outcome = as;
        j.budget = limits_[i].budgets[0];
        judged.push_back(j);
      }
    recorded_ |= outputs;
  }
  /// Forgets the case.
  void clear() {
    judged.clear();
    recorded_ = 0;
  }

  std::vector<Judged> judged;

 private:
  std::size_t index(const Output& output) const {
    std::size_t i = 0;
    while (limits_.at(i).definition != output.definition) ++i;
    return i;
  }
  const Budget* budget(std::size_t output, std::size_t band) const {
    return limits_[output].budgets[bands_[band].region == Region::to_pi ? 0 : 1];
  }
  Judged start(const Output& output, std::size_t band) {
    const std::size_t i = index(output);
    recorded_ |= 1u << i;
    Judged j;
    j.residual.output = static_cast<std::uint16_t>(i);
    j.residual.band = static_cast<std::uint16_t>(band);
    j.budget = budget(i, band);
    return j;
  }
  /// Throws Undecided if the exact value may be on either side of the limit.
  static void decided(double value, double limit, double accuracy) {
    if (accuracy > 0 && value > 0 && std::fabs(value - limit) <= 2 * accuracy * std::max(1.0, limit))
      throw oracles::Undecided();
  }
  const Limits& limits_;
  const Bands& bands_;
  double eps_, accuracy_;
  bool every_kappa_;
  std::uint32_t recorded_ = 0;  ///< the outputs with a record in this case
};

/// Whether both oracles give the same verdicts, and errors and condition numbers that agree within the
/// accuracy of the fast one. A condition number below 1 counts as 1. A condition number that only one oracle
/// computed is not compared, and neither is the error of an ill-posed case.
inline bool agree(const std::vector<Judged>& fast, const std::vector<Judged>& slow) {
  if (fast.size() != slow.size()) return false;
  for (std::size_t i = 0; i < fast.size(); ++i) {
    const Residual &a = fast[i].residual, &b = slow[i].residual;
    if (a.output != b.output || a.band != b.band || a.outcome != b.outcome ||
        fast[i].failed != slow[i].failed || fast[i].ill_posed != slow[i].ill_posed)
      return false;
    if (a.outcome != Outcome::measured || slow[i].ill_posed) continue;
    if (a.error != b.error &&
        !(std::fabs(a.error - b.error) <= 1.01 * oracles::error_accuracy * std::max(1.0, b.error)))
      return false;
    const bool asked = a.kappa > 0 && b.kappa > 0;
    if (asked && !(std::fabs(std::max(1.0, a.kappa) - std::max(1.0, b.kappa)) <= kappa_accuracy * b.kappa))
      return false;
  }
  return true;
}

}  // namespace liecheck::properties

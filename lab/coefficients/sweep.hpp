#pragma once
// The sweep compares each scalar coefficient of scalar/stumpff.hpp, in float at every float argument, with
// oracles/scalar_coefficients.hpp. The result bounds all errors; it is not just the largest error found.
//
// The argument is x = theta^2 as a float; if theta <= pi, x is in [0, pi^2]. An error is measured at the
// exact value of that float. For a given theta the rounding of x adds another error. One rounding of x by
// eps/2 adds at most `square_eps`: to first order, the maximum of |x F'(x)| / 2 or |x F'(x) / F(x)| / 2. A
// sum of three squares adds up to three times as much. HalfAngle corrects this error by the low part of x,
// which is 0 here. Above the limit of the series, pi^2 (1 + 8 eps), the code uses sines, which are not swept.
//
// The two coefficients of the logarithm are swept at cosine = 1 over every finite float
// squared_sine = tan^2 h, that is every half angle h in [0, pi/2) of quaternions whose w is a power of two.
// Other w round differently (alpha once more), and there are too many pairs (w, tan^2 h) to sweep. `along` is
// consistent with alpha by design and has no bound.

#include <atomic>
#include <coefficients/library_coefficients.hpp>
#include <cstdint>
#include <functional>
#include <vector>

namespace liecheck::properties {

struct SweepOptions {
  std::vector<Coefficient> coefficients;  ///< empty: all
  unsigned jobs = 1;
  std::uint32_t stride = 1;           ///< only floats whose bits are a multiple of `stride`
  std::atomic<bool>* stop = nullptr;  ///< if set to true, the sweep ends early
  std::function<void(double share)> progress = [](double) {};
};

struct SweptCoefficient {
  const CoefficientClaim* claim;
  std::uint64_t evaluated = 0;  ///< floats whose result is known
  std::uint64_t constant = 0;   ///< those in intervals over which the code provably returns one value
  double max_eps = 0;           ///< the largest error measured
  float max_at = 0;             ///< the smallest argument with that error
  double oracle_bound_eps = 0;  ///< bound of the oracle's own error
  double square_eps = 0;        ///< added by the rounding of theta^2; 0 for the logarithm's coefficients
  double bound_eps = 0;         ///< upper bound of the error over the floats evaluated
};

struct SweepResult {
  std::vector<SweptCoefficient> coefficients;
  std::uint32_t stride = 1;
  bool complete = false;
  double elapsed = 0;  ///< [s]
  /// Do the bounds hold for every float? Otherwise they hold for the evaluated floats.
  bool upper_bound() const { return complete && stride == 1; }
  /// True if a sweep of every float does not prove the documented bound, or another sweep refutes it.
  bool failed(const SweptCoefficient& c) const;
  bool failed() const;
};

/// The result does not depend on the number of jobs.
SweepResult sweep(const SweepOptions& options,
                  const std::vector<CoefficientCode>& code = library_coefficients());

}  // namespace liecheck::properties

#pragma once
// Every float: the scalar coefficients of scalar/stumpff.hpp in float, at every argument that float has, against
// oracles/scalar_coefficients.hpp. What comes out is not the largest error found but an upper bound of every
// error there is.
//
// The argument is x itself: the code forms x = theta^2 rounded, and [0, pi^2] holds every x that any rotation
// vector brings here. Each coefficient is measured at the exact float x. Seen from theta, the rounding of one
// square (eps/2 of x) adds to first order at most `square_eps`, the greatest |x F'(x)| / 2 or |x F'(x) / F(x)| / 2;
// the sum of three squares up to three times that. HalfAngle takes it back with x_low, 0 here. From the limit of
// the series on, pi^2 (1 + 8 eps), the code takes the sine forms, which are not covered. The logarithm's two are
// swept at cosine = 1 over every finite float squared_sine = tan^2 h, with this machine's atan2: every half angle
// of [0, pi/2), for quaternions whose w is a power of two; other w differ in roundings (alpha by one more) and
// have too many pairs to sweep. `along` is consistent with alpha by design and has no bound of its own.

#include <atomic>
#include <cstdint>
#include <functional>
#include <oracles/scalar_coefficients.hpp>
#include <string>
#include <vector>

namespace liecheck::properties {

using oracles::Coefficient;

/// What the docstrings of stumpff.hpp claim.
struct CoefficientClaim {
  Coefficient coefficient;
  const char* name;
  const char* equation;
  const char* argument;
  double documented_eps;
  const char* reason;
};
const std::vector<CoefficientClaim>& coefficient_claims();

/// Coefficients that one call computes together.
struct CoefficientCode {
  std::vector<Coefficient> outputs;
  /// The last argument swept, a float; the first is 0.
  float last;
  /// out[k][i], k an output, i < n; reads and writes up to 7 floats beyond n.
  std::function<void(const float* x, std::size_t n, float* const* out)> evaluate;
  /// Where every argument from low to high provably returns the same floats: those. Else false.
  std::function<bool(float low, float high, float* out)> constant;
};
/// The library's.
const std::vector<CoefficientCode>& library_coefficients();

struct SweepOptions {
  std::vector<Coefficient> coefficients;  ///< none: all
  unsigned jobs = 1;
  std::uint32_t stride = 1;           ///< only floats whose bits are a multiple
  std::atomic<bool>* stop = nullptr;  ///< set it, and the sweep ends early
  std::function<void(double share)> progress = [](double) {};
};

struct SweptCoefficient {
  const CoefficientClaim* claim;
  std::uint64_t evaluated = 0;  ///< floats whose result is known
  std::uint64_t constant = 0;   ///< of them, in runs over which the code was shown to return one value
  double max_eps = 0;           ///< the largest error measured
  float max_at = 0;             ///< the smallest argument that errs so
  double oracle_bound_eps = 0;  ///< how far the oracle itself may be off
  double square_eps = 0;        ///< what the rounding of theta^2 adds; 0 for the logarithm's
  double bound_eps = 0;         ///< no error over the floats evaluated is larger
};

struct SweepResult {
  std::vector<SweptCoefficient> coefficients;
  std::uint32_t stride = 1;
  bool complete = false;
  double elapsed = 0;
  /// Only of every float is the bound one.
  bool upper_bound() const { return complete && stride == 1; }
  /// Of every float: is its bound above what is documented? Else: was a larger error than that found?
  bool failed(const SweptCoefficient& c) const;
  bool failed() const;
};

/// The figures do not depend on the number of jobs.
SweepResult sweep(const SweepOptions& options,
                  const std::vector<CoefficientCode>& code = library_coefficients());

}  // namespace liecheck::properties

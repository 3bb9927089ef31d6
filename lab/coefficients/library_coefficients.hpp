#pragma once
// The scalar coefficients of scalar/stumpff.hpp: their documented error bounds, and their code in float.

#include <functional>
#include <oracles/scalar_coefficients.hpp>
#include <vector>

namespace liecheck::properties {

using oracles::Coefficient;

/// The error bound that stumpff.hpp documents.
struct CoefficientClaim {
  Coefficient coefficient;
  const char* name;
  const char* equation;
  const char* argument;
  double documented_eps;
  const char* reason;
};
/// In the order of the enumeration.
const std::vector<CoefficientClaim>& coefficient_claims();

/// Coefficients that one call computes together.
struct CoefficientCode {
  std::vector<Coefficient> outputs;
  float last;  ///< the largest argument swept; the smallest is 0
  /// Sets out[k][i] to output k at x[i] for i < n. Reads and writes up to 3 floats beyond n.
  std::function<void(const float* x, std::size_t n, float* const* out)> evaluate;
  /// If all arguments in [low, high] provably have the same results, sets out[k] to them and returns true.
  std::function<bool(float low, float high, float* out)> constant;
};
const std::vector<CoefficientCode>& library_coefficients();

}  // namespace liecheck::properties

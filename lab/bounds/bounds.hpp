#pragma once
// Proved upper bounds of the errors of whole operations of liecheck in double, compiled without fused multiply-adds.
//
// The set of inputs is divided into boxes. An operation is evaluated once for a box, on a scalar that carries a bound of
// its own rounding error (bounded.hpp). The box with the largest bound is divided again and again. At any time, the
// largest bound of the boxes that are left holds for every input.

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace liecheck::properties {

struct ProvedBound {
  std::string operation, block;  ///< as in the table of limits
  std::string inputs;            ///< the set for which the bound holds
  double bound = 0;              ///< eps; infinity if a box has none
  std::uint64_t boxes = 0;       ///< evaluated
  std::string worst;             ///< the box with the largest bound
  double hunted = 0;             ///< eps: largest_error_of_hard_cases() of hunted.hpp
  double limit = 0;              ///< eps: of the table of limits

  /// A search found a larger error than the proof allows: one of the two is wrong.
  bool contradicted() const { return bound < hunted; }
};

struct BoundOptions {
  std::vector<std::string> operations;  ///< empty: all that have a proof
  std::uint64_t boxes = 100'000;        ///< to evaluate for each operation
  double wanted = 0;                    ///< stop if the bound is not above this [eps]
  unsigned jobs = 1;                    ///< operations at a time; the results are the same
  /// The share of the work that is done, and the operation and its bound so far. Threads call it one after another.
  std::function<void(double, const std::string&, double)> progress;
};

/// The operations that have a proof.
std::vector<std::string> proved_operations();

/// What is proved of an operation, without a bound. Throws std::invalid_argument that names an unknown operation.
ProvedBound statement_of(const std::string& operation);

/// Calls `done` for each operation, in order. At stop_requested the bounds so far are given, which hold, too, for the
/// operations that have begun. Throws std::invalid_argument that names an unknown operation.
void prove_bounds(const BoundOptions& options, const std::function<void(const ProvedBound&)>& done);

/// The bound [eps] for a tiny box about one input, for tests. The operations of rotations ignore rho; log3_quaternion takes
/// the quaternion of phi.
double bound_at(const std::string& operation, const std::array<double, 3>& phi,
                const std::array<double, 3>& rho);

}  // namespace liecheck::properties

#pragma once
// Whole operations in float at every angle about one axis: a slice of their inputs. Its maximum is certain, since
// every float theta in [0, pi] is evaluated; phi is theta n, rounded to float.

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace liecheck::properties {

struct SliceOptions {
  std::vector<std::string> operations;  ///< empty: all of slice_operations()
  std::vector<std::array<double, 3>>
      axes;                  ///< empty: x, and for each operation the worst of `tried` random axes
  unsigned tried = 500;      ///< random axes, each with 500 random angles
  std::uint32_t stride = 1;  ///< only every `stride`-th float, a lower bound
  unsigned jobs = 1;
  std::uint64_t seed = 42;
  std::atomic<bool>* stop = nullptr;
  std::function<void(double share)> progress = [](double) {};
};

struct Slice {
  std::string operation, block;
  std::array<float, 3> axis, rho;  ///< rho only where the operation has one
  std::uint64_t evaluated = 0;
  double max_eps = 0;  ///< the largest error; it includes the reference's own, below 1e-5 eps
  float max_at = 0;    ///< the smallest theta with that error
  double limit = 0;    ///< liecheck's budget
  bool complete = false;
  /// A budget below the largest error of a slice is wrong.
  bool failed() const { return !(max_eps <= limit); }
};

/// "exp3_quaternion", ...: operations with a reference in oracles/slice_reference.hpp.
std::vector<std::string> slice_operations();

/// The result does not depend on the number of jobs. Throws std::invalid_argument naming an unknown operation.
std::vector<Slice> sweep_slices(const SliceOptions& options);

/// The error of one operation at phi = theta axis and rho, in eps; for tests.
double slice_error(const std::string& operation, float theta, const std::array<float, 3>& axis,
                   const std::array<float, 3>& rho);

}  // namespace liecheck::properties

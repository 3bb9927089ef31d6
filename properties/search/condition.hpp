#pragma once
// The simplest condition on one feature of a call that separates the inputs that fail from those that pass.

#include <campaign/series.hpp>
#include <functional>
#include <optional>
#include <search/features.hpp>
#include <string>

namespace liecheck::properties {

/// feature >= low and feature < high.
struct Condition {
  Feature feature = Feature::one;
  double low = 0, high = 0;
  std::uint64_t failed = 0, cases = 0;                ///< where it holds
  std::uint64_t failed_elsewhere = 0, elsewhere = 0;  ///< where it does not
  /// Of the failing inputs: the feature, ascending, and the error, which is 1 if all digits are lost.
  std::vector<std::pair<double, double>> errors;
  bool in_bands = false;  ///< it separates the inputs of the failing bands only
  bool holds(const Features& f) const { return f[feature] >= low && f[feature] < high; }
};

/// In words: "w < 0", "|p| >= 1.2e+05 m", "3 joints".
std::string text_of(const Condition& condition, const Scalar& scalar);

/// The condition, of those that are no angle, that holds for nearly all failing inputs of an output and for few others; of all
/// inputs, or else of those in the bands for which `fails_in` is true, if it is given. None if no condition separates, or if
/// fewer than three inputs fail or pass. It measures the first 1000 cases of the seed, or 2000 if fewer than 20 of these
/// fail, for at most 3 s, then searches each border between a failing and a passing input by bisection.
std::optional<Condition> condition_of(const Series& series, std::size_t output, std::uint64_t seed,
                                      const std::function<bool(std::size_t band)>& fails_in = {});

}  // namespace liecheck::properties

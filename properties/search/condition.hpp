#pragma once
// The simplest condition on the features of a call that separates the inputs that fail from those that pass: one feature, or
// two at once.

#include <campaign/series.hpp>
#include <functional>
#include <optional>
#include <search/features.hpp>
#include <string>

namespace liecheck::properties {

struct Condition {
  std::string text;  ///< "Q.w < 0", "a joint is prismatic and v is not 0"
  /// The one of its features whose border was measured, else the first; `one` for a feature of the operation's arguments.
  Feature feature = Feature::one;
  double low = 0, high = 0;                           ///< that feature is at least `low` and below `high`
  std::uint64_t failed = 0, cases = 0;                ///< where it holds
  std::uint64_t failed_elsewhere = 0, elsewhere = 0;  ///< where it does not
  /// Of the failing inputs for which its other part holds: the feature, ascending, and the error, which is 1 if all digits
  /// are lost.
  std::vector<std::pair<double, double>> errors;
  bool in_bands = false;  ///< it separates the inputs of the failing bands only

  /// What stands before the text: nothing if three quarters of the inputs with it fail; "only if " if a quarter does, and none
  /// without it; else "mostly if ", for inputs that were not drawn may then fail without it.
  const char* degree() const {
    if (4 * failed >= 3 * cases) return "";
    return failed_elsewhere == 0 && 4 * failed > cases ? "only if " : "mostly if ";
  }
};

/// The condition, of those that are no angle, that holds for nearly all failing inputs of an output and for few others; or
/// without which none fails, and with which significantly more do. Of all inputs, or else of those in the bands for which
/// `fails_in` is true, if it is given. None if no condition separates, or if fewer than three inputs fail or pass. It
/// measures the first 1000 cases of the seed, or 2000 if fewer than 20 of these fail, for at most 3 s of an idle machine, then searches each
/// border between a failing and a passing input by bisection.
std::optional<Condition> condition_of(const Series& series, std::size_t output, std::uint64_t seed,
                                      const std::function<bool(std::size_t band)>& fails_in = {});

}  // namespace liecheck::properties

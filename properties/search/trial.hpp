#pragma once
// Inputs of a law and what became of them: measured, with the features of the calls of one output's operation.

#include <campaign/series.hpp>
#include <chrono>
#include <search/feature_names.hpp>

namespace liecheck::properties {

/// What became of one input in one call.
struct Tried {
  std::vector<double> input;
  std::vector<double> features;  ///< by TrialOfFeatures::names(); NaN, or none at the end, where the call has none
  bool failed = false;
  double error = 0;  ///< [eps]
  std::size_t band = 0;
  double operator[](std::size_t feature) const {
    return feature < features.size() ? features[feature] : std::numeric_limits<double>::quiet_NaN();
  }
};

/// So many seconds of an idle machine, by the load of this one: what is measured in them shall not depend on it.
std::chrono::duration<double> at_this_load(double seconds);

/// Measures inputs of a law, and looks at the calls.
class TrialOfFeatures {
 public:
  TrialOfFeatures(const Series& series, std::size_t output);

  /// One for each measurement of the output, if each has its own call; else one, the worst. None if nothing was measured.
  std::vector<Tried> operator()(const std::vector<double>& x);

  /// The features: those of every call, then those of the operation's arguments.
  const std::vector<FeatureName>& names() const { return names_; }

 private:
  std::vector<double> features_of(const NumberFunction& function, const void* arguments,
                                  const Context& context);

  const Series& series_;
  std::size_t output_;
  bool of_tree_;
  std::vector<FeatureName> names_ = fixed_names();
};

/// An input between two of the same size: of rotations along an arc, of all else along a line. Empty if a group that has no
/// values between differs.
std::vector<double> input_between(const Series& series, const std::vector<double>& a,
                                  const std::vector<double>& b, double t);

/// The tree of an input without its last joint; empty if the law has no trees, or the tree has one joint.
std::vector<double> without_last_joint(const Series& series, const std::vector<double>& x);

}  // namespace liecheck::properties

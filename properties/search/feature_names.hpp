#pragma once
// How the features of calls are named and written: those of every call (search/features.hpp), and those of the arguments of
// one operation, by their own names: "p_Y.z", "|omega|", "R[1,1]".

#include <search/features.hpp>
#include <string>
#include <vector>

namespace liecheck::properties {

/// How a feature is written. `scale`: its values are log2 of a size over the largest exponent of the scalar. `flag`: 1 where
/// it holds, else 0. `sign`: only its sign is looked at.
enum class Written { number, scale, flag, count, sign };

struct FeatureName {
  Feature feature;  ///< `one` for a feature of the arguments of one operation
  std::string name;
  /// Of a flag, what holds where it is 0, or "" if that is no condition; of a count of joints, what one of them is, or "".
  std::string unit;
  Written written;
  bool angle = false;         ///< it follows from an angle, of which bands tell
  std::string argument = "";  ///< the part of the arguments that it is of
  bool negated = false;       ///< a flag that tells little where it is 0, such as that a number is not zero
  bool of_several = false;    ///< the largest of several arguments, if none of them tells by itself
};

/// Those of every call, the simplest first. Angles are left out.
const std::vector<FeatureName>& fixed_names();

/// Those of the arguments of one operation.
std::vector<FeatureName> argument_names(const NumberFunction& function);
/// Their values in a call, in the same order.
std::vector<double> argument_features(const NumberFunction& function, const std::vector<double>& arguments,
                                      bool floating);

/// Whether rounding errors alone tell a range of a feature from its other values; beside bands of angles, they tell less.
bool is_rounding(const FeatureName& name, double low, double high, bool in_bands);

/// A feature from `low` up to but not `high`, in words: "Q.w < 0", "|p_Y| >= 1e+03 m", "a joint is prismatic".
std::string text_of(const FeatureName& name, double low, double high, const Scalar& scalar);

/// Borders of natural ranges: {0} is [0, above_zero).
inline constexpr double above_zero = std::numeric_limits<double>::denorm_min(),
                        above_log_of_zero = std::numeric_limits<double>::lowest();

}  // namespace liecheck::properties

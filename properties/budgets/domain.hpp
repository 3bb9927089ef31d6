#pragma once
// The inputs on which a subject promises its limits: bounds of the quantities that its operations take.

#include <generators/input_layout.hpp>
#include <operations/description.hpp>
#include <span>
#include <string>
#include <vector>

namespace liecheck::properties {

/// The quantities that a domain can bound, each with its unit: docs/limits.md.
enum class Quantity {
  angle,  ///< of a rotation vector, or of the rotation whose logarithm the operation computes
  translation,
  linear_velocity,
  angular_velocity,
  force,
  moment,
  mass,
  inertia,
  joint_position,
  joint_velocity,
  joint_acceleration,
  quaternion_norm  ///< of operations that take a quaternion of any norm
};
/// In the order of Quantity: "angle", "linear velocity", ...
const std::vector<std::string>& quantity_names();

/// Whether an operation has an argument of this quantity.
bool takes(const Operation& operation, Quantity quantity);

struct DomainBound {
  const Operation* operation;  ///< null: every operation that has no bound of its own for this quantity
  Quantity quantity;
  double bound;        ///< of the norm of a vector or matrix
  bool lower = false;  ///< it may be 0 or not below the bound, in place of not above it
  std::string reason = {};
};

/// A domain for the inputs of one law.
class Domain {
 public:
  Domain() = default;  ///< has every input
  Domain(const std::vector<DomainBound>& bounds, const std::vector<Field>& fields,
         const std::vector<Output>& outputs);
  bool has_everything() const { return tests_.empty(); }
  /// By output: whether the input is outside the domain of its operation.
  std::vector<bool> outside(const std::vector<double>& input) const;
  /// The angle of an output's operation [rad], or a negative number if it has none. It is computed in double:
  /// for counting, not for measuring.
  double angle(const std::vector<double>& input, std::size_t output) const;

 private:
  struct Group {
    Kind kind;
    std::size_t from, size;
  };
  struct Test {
    double bound;
    bool lower, angle;
    std::vector<Group> groups;
    std::size_t output;
    bool excludes(const std::vector<double>& x) const;
  };
  std::vector<Test> tests_;
  std::vector<std::vector<Group>> angles_;  ///< by output
};

}  // namespace liecheck::properties

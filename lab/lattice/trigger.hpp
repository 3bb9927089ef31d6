#pragma once
// When a fault of the lattice acts: a range of one number that describes the arguments of a call. The
// generators of inputs know nothing of it.

#include <search/features.hpp>
#include <string>
#include <vector>

namespace liecheck::properties {

struct Trigger {
  std::string family;  ///< the group of triggers in the table that `lab lattice` prints
  std::string name;
  Feature feature = Feature::one;
  double low = 0, high = 0;

  bool fires(const Features& f) const { return f[feature] >= low && f[feature] < high; }
  bool applies(const Features& f) const { return f[feature] == f[feature]; }
  bool is_angle() const { return feature <= Feature::turn_minus_two_pi; }
  /// Whether it depends on earlier calls.
  bool is_habit() const { return feature >= Feature::call; }
};

/// All triggers, in the order of the table.
const std::vector<Trigger>& triggers();

}  // namespace liecheck::properties

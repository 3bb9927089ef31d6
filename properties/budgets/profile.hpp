#pragma once
// A profile judges a subject wherever it promises nothing of its own. It is a transformation of the budget
// table (budgets.hpp). docs/limits.md says what each one is for.

#include <budgets/budgets.hpp>
#include <optional>

namespace liecheck::properties {

enum class Profile {
  ours,     ///< the budget table itself: what liecheck promises
  careful,  ///< 64 eps, or 64 eps kappa, by the rule of each line
  half      ///< half of the digits: eps^(-1/2) of the same units
};
/// In the order of Profile.
const std::vector<std::string>& profile_names();
const std::string& name_of(Profile profile);
std::optional<Profile> profile_named(const std::string& name);

/// The lines that judge a subject under a profile, in a scalar with this eps.
const std::vector<Budget>& budgets(const std::string& subject, Profile profile, double eps);

}  // namespace liecheck::properties

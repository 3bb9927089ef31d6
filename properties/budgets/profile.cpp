#include <budgets/profile.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

namespace liecheck::properties {

const std::vector<std::string>& profile_names() {
  static const std::vector<std::string> names{"ours", "careful", "half"};
  return names;
}

const std::string& name_of(Profile profile) {
  return profile_names()[static_cast<std::size_t>(profile)];
}

std::optional<Profile> profile_named(const std::string& name) {
  const auto& known = profile_names();
  const auto at = std::find(known.begin(), known.end(), name);
  if (at == known.end()) return std::nullopt;
  return static_cast<Profile>(at - known.begin());
}

const std::vector<Budget>& budgets(const std::string& subject, Profile profile, double eps) {
  if (profile == Profile::ours) return budgets(subject);
  static std::mutex mutex;
  static std::map<std::pair<Profile, double>, std::vector<Budget>> tables;
  const std::lock_guard lock(mutex);
  const auto [table, is_new] = tables.try_emplace({profile, eps}, budgets(""));
  if (is_new)
    for (Budget& line : table->second) {
      line.limit = profile == Profile::careful ? 64 : 1 / std::sqrt(eps);
      line.reason = "profile " + name_of(profile);
    }
  return table->second;
}

}  // namespace liecheck::properties

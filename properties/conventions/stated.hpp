#pragma once
// The conventions that an adapter states, and the exact conversion of its arguments and results.

#include <map>
#include <operations/description.hpp>
#include <string>
#include <vector>

namespace liecheck::properties::conventions {

/// {"quaternion": "wxyz", "twist": "angular first"}
using Statements = std::map<std::string, std::string>;

/// A rearrangement: number i of liecheck's is number |order[i]| - 1 of the adapter's, negated if order[i] < 0.
using Order = std::vector<int>;

template <class S>
void encode(const Order& order, const S* from, S* to) {
  for (std::size_t i = 0; i < order.size(); ++i)
    to[std::abs(order[i]) - 1] = order[i] < 0 ? -from[i] : from[i];
}
template <class S>
void decode(const Order& order, const S* from, S* to) {
  for (std::size_t i = 0; i < order.size(); ++i)
    to[i] = order[i] < 0 ? -from[-order[i] - 1] : from[order[i] - 1];
}

/// Of the numbers of a call, whose poses are (p, Q) where the adapter states it: operations/quaternion_poses.hpp.
struct Rearranged {
  Order arguments, result;
};
/// Throws std::invalid_argument, which says in words what is unknown or cannot be converted exactly.
Rearranged rearranged(const Operation& operation, const Statements& stated);

/// The statement of what poses are. It changes how many numbers they have.
inline constexpr const char* pose_form = "pose form";
/// Whether poses are stated to be (p, Q).
bool has_quaternion_poses(const Statements& stated);

/// The arguments of a call as an adapter with these statements is given them.
std::vector<double> given(const Operation& operation, const Statements& stated,
                          const std::vector<double>& arguments, bool is_float);

}  // namespace liecheck::properties::conventions

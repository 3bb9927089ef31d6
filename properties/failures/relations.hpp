#pragma once
// How results of operations follow from those of others, as libraries compute them.

#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace liecheck::properties {

using Numbers = std::vector<double>;

/// A call of an operation with the arguments x, and a part of the operation, or any other one, as the subject computes it.
struct CallOf {
  const Numbers &x, &got;
  std::function<Numbers(const Numbers&)> part;
  std::function<Numbers(const char* operation, const Numbers&)> own;
};
/// How the result of an operation follows from one of its parts.
struct Relation {
  const char *of, *part;
  Numbers (*result)(const CallOf&);
};

/// What a relation has for a number that it does not predict.
constexpr double unknown_number = std::numeric_limits<double>::infinity();

/// The result of an operation from the oracle, each number rounded once. Throws what the oracle throws where it knows none.
Numbers exact(const char* operation, const Numbers& arguments);

/// R and p of the pose from the body at q0 to the body at q1, of the arguments of a difference.
Numbers relative_pose(const Numbers& arguments);

/// Of interpolation, other representations of rotations, extended poses, and preintegration.
std::span<const Relation> derived_relations();

/// Its parts are called at what their arguments are in an exact calculation.
std::span<const Relation> relations();

}  // namespace liecheck::properties

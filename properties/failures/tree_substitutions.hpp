#pragma once
// Wrong results of algorithms on trees of bodies that are right ones of another tree or state, or right but for one change.

#include <campaign/series.hpp>

namespace liecheck::properties {

/// "where it fails, the result is what an armature of 0 would give", if most wrong results of an output of a law on random
/// trees are those of one change of its tree, its state, or of the results themselves; else "".
std::string tree_substitution_of(const Series& series, std::size_t output);

/// "it is right with v = 0, so a term that is 0 then is wrong or missing", if most wrong results become right where a part of
/// the tree or of its state is left out; else "".
std::string needed_term_of(const Series& series, std::size_t output);

}  // namespace liecheck::properties

#pragma once
// A tree of bodies and its state as a person would draw it.

#include <campaign/series.hpp>
#include <string>

namespace liecheck::properties {

/// Lines for the case of a law on random trees: each joint with its kind, parent and what differs from the plainest one, then
/// q and v; "" for other laws, and for a tree of more than eight joints.
std::string drawn_tree(const Series& series, const CaseId& id);

}  // namespace liecheck::properties

#pragma once
// A tree of bodies and its state as a person would draw it.

#include <campaign/series.hpp>
#include <string>

namespace liecheck::properties {

/// Lines for the case of a law on random trees: each joint with its kind, parent and what differs from the plainest one, then
/// what the output's operation takes, but for vectors that are zero; "" for other laws, and for a tree of more than eight
/// joints. `seen` is the reference of a frame, or "".
std::string drawn_tree(const Series& series, const CaseId& id, const Output& output, const std::string& seen);

/// Whether the law of a series takes the gravity from its trees.
bool is_weightless(const Series& series);

}  // namespace liecheck::properties

#pragma once
// Simpler trees than a given one, for shrinking.

#include <generators/trees.hpp>
#include <optional>

namespace liecheck::properties::shrinks {

/// The tree without joint k, whose children, frame and wrench are moved to its parent. Empty if joint k is
/// absent, a mimic's primary or the only joint.
template <class S>
std::optional<std::vector<S>> without_joint(const std::vector<S>& x, int k) {
  const TreeLayout at{tree_slots};
  std::vector<S> y = x;
  const auto number = [&](int i) -> S& { return y[static_cast<std::size_t>(i)]; };
  int joints = 0;
  while (joints < at.slots && number(at.parents() + joints) >= S(-1)) ++joints;
  if (joints < 2 || k >= joints) return std::nullopt;
  const S removed(k), parent = number(at.parents() + k);
  const auto move_up = [&](S& joint) {
    joint = joint == removed ? parent : joint > removed ? joint - S(1) : joint;
  };
  for (int i = 0; i < joints; ++i) {
    if (number(at.primaries() + i) == removed) return std::nullopt;
    if (number(at.primaries() + i) > removed) number(at.primaries() + i) -= S(1);
    move_up(number(at.parents() + i));
  }
  move_up(number(at.frame()));
  if (number(at.frame()) < S(0)) number(at.frame()) = S(0);
  move_up(number(at.wrench()));
  for (int list : {at.parents(), at.kinds(), at.primaries(), at.masses()}) {
    const auto first = y.begin() + list;
    std::copy(first + k + 1, first + at.slots, first + k);
  }
  std::copy(y.begin() + at.slot(k + 1), y.end(), y.begin() + at.slot(k));
  const int last = at.slots - 1;
  number(at.parents() + last) = number(at.kinds() + last) = S(absent_joint);
  number(at.primaries() + last) = S(-1), number(at.masses() + last) = S(0);
  tree_detail::clear_slot(&number(at.slot(last)));
  return y;
}

/// The trees with one joint fewer, without the wrench, or with the frame on the first joint.
template <class S>
std::vector<std::vector<S>> simpler_trees(const std::vector<S>& x) {
  const TreeLayout at{tree_slots};
  std::vector<std::vector<S>> all;
  for (int k = at.slots - 1; k >= 0; --k)
    if (auto y = without_joint(x, k)) all.push_back(std::move(*y));
  for (const auto& [i, value] : {std::pair(at.wrench(), S(-1)), std::pair(at.frame(), S(0))})
    if (x[static_cast<std::size_t>(i)] != value) {
      all.push_back(x);
      all.back()[static_cast<std::size_t>(i)] = value;
    }
  return all;
}

}  // namespace liecheck::properties::shrinks

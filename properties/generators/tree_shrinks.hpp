#pragma once
// Simpler trees than a given one, for shrinking.

#include <generators/trees.hpp>
#include <optional>

namespace liecheck::properties::shrinks {

/// The number of joints of a tree.
template <class S>
int joints_of(const std::vector<S>& x) {
  const TreeLayout at = TreeLayout::of_size(x.size());
  int n = 0;
  while (n < at.slots && x[static_cast<std::size_t>(at.parent(n))] >= S(-1)) ++n;
  return n;
}

/// The tree without joint k, whose children, frame and wrench are moved to its parent. Empty if joint k is
/// absent, a mimic's primary or the only joint.
template <class S>
std::optional<std::vector<S>> without_joint(const std::vector<S>& x, int k) {
  const TreeLayout at = TreeLayout::of_size(x.size());
  std::vector<S> y = x;
  const auto number = [&](int i) -> S& { return y[static_cast<std::size_t>(i)]; };
  const int joints = joints_of(x);
  if (joints < 2 || k >= joints) return std::nullopt;
  const S removed(k), parent = number(at.parent(k));
  const auto move_up = [&](S& joint) {
    joint = joint == removed ? parent : joint > removed ? joint - S(1) : joint;
  };
  for (int i = 0; i < joints; ++i) {
    if (number(at.primary(i)) == removed) return std::nullopt;
    if (number(at.primary(i)) > removed) number(at.primary(i)) -= S(1);
    move_up(number(at.parent(i)));
  }
  move_up(number(at.frame()));
  if (number(at.frame()) < S(0)) number(at.frame()) = S(0);
  move_up(number(at.wrench()));
  for (int i = k; i + 1 < joints; ++i) tree_detail::copy_joint(at, y, i + 1, i);
  if (joints > at.listed)
    y.resize(TreeLayout::of_joints(joints - 1).size());
  else
    tree_detail::clear_joint(at, y, joints - 1);
  return y;
}

/// The first n joints of a tree with more joints. Frame and wrench of a removed joint move to the last one.
template <class S>
std::vector<S> first_joints(const std::vector<S>& x, int n) {
  const TreeLayout at = TreeLayout::of_joints(n);
  std::vector<S> y(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(at.size()));
  for (int i = n; i < at.slots; ++i) tree_detail::clear_joint(at, y, i);
  for (int i : {at.frame(), at.wrench()}) {
    S& joint = y[static_cast<std::size_t>(i)];
    if (joint >= S(n)) joint = S(n - 1);
  }
  return y;
}

/// The trees with half of the joints, if they are many, or with one joint fewer, without the wrench, or with
/// the frame on the first joint.
template <class S>
std::vector<std::vector<S>> simpler_trees(const std::vector<S>& x) {
  const TreeLayout at = TreeLayout::of_size(x.size());
  std::vector<std::vector<S>> all;
  const int joints = joints_of(x);
  if (joints > at.listed)
    for (int n : {at.listed, joints / 2}) all.push_back(first_joints(x, n));
  for (int k = joints - 1; k >= 0; --k)
    if (auto y = without_joint(x, k)) all.push_back(std::move(*y));
  for (const auto& [i, value] : {std::pair(at.wrench(), S(-1)), std::pair(at.frame(), S(0))})
    if (x[static_cast<std::size_t>(i)] != value) {
      all.push_back(x);
      all.back()[static_cast<std::size_t>(i)] = value;
    }
  return all;
}

}  // namespace liecheck::properties::shrinks

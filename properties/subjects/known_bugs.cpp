#include <subjects/known_bugs.hpp>

#include <subjects/planted_bugs.hpp>
#include <subjects/tree_bugs.hpp>

namespace liecheck::properties {
namespace {

template <class S>
std::vector<typename Bugs<S>::Entry> concatenated(
    std::initializer_list<typename Bugs<S>::Entries (*)()> groups) {
  typename Bugs<S>::Entries all;
  for (const auto group : groups)
    for (const auto& entry : group()) all.push_back(entry);
  return all;
}

template <class S>
const typename Bugs<S>::Entries& bugs_of_operations() {
  using B = Bugs<S>;
  static const auto all = concatenated<S>(
      {B::exp_of_rotations, B::log_of_rotations, B::exp_and_log_of_poses, B::jacobians, B::integration,
       B::differences, B::configuration_derivatives, B::robots, B::points_motions_and_forces, B::inertias});
  return all;
}

template <class S>
const typename Bugs<S>::Entries& look_alikes() {
  static const auto all =
      concatenated<S>({Bugs<S>::look_alikes_of_rotations, Bugs<S>::look_alikes_of_poses_and_bodies});
  return all;
}

}  // namespace

template <class S>
std::vector<Subject<S>> known_bugs(const Operations<S>& good) {
  Bugs<S>::good() = good;
  std::vector<Subject<S>> all;
  for (const auto& entry : bugs_of_operations<S>()) {
    all.push_back({std::string("bug:") + entry.name, "a known bug", good, {}});
    all.back().operations.tree = nullptr;  // has no fault
    entry.plant(all.back().operations);
  }
  for (const auto& entry : tree_bugs<S>()) {
    all.push_back({std::string("bug:") + entry.name, "a known bug", {}, {}});
    all.back().operations.tree = entry.tree;
  }
  for (const auto& entry : look_alikes<S>()) {
    all.push_back({std::string("alike:") + entry.name, "a look-alike", good, {}});
    all.back().operations.tree = nullptr;
    entry.plant(all.back().operations);
  }
  return all;
}

const std::vector<KnownBug>& known_bug_table() {
  static const std::vector<KnownBug> table = [] {
    std::vector<KnownBug> all;
    for (const auto& e : bugs_of_operations<double>())
      all.push_back({std::string("bug:") + e.name, e.fault, e.origin});
    for (const auto& e : tree_bugs<double>())
      all.push_back({std::string("bug:") + e.name, e.fault, e.origin});
    for (const auto& e : look_alikes<double>())
      all.push_back({std::string("alike:") + e.name, e.fault, e.origin});
    return all;
  }();
  return table;
}

template std::vector<Subject<float>> known_bugs(const Operations<float>&);
template std::vector<Subject<double>> known_bugs(const Operations<double>&);

}  // namespace liecheck::properties
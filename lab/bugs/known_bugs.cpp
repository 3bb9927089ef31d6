#include <bugs/known_bugs.hpp>

#include <bugs/planted_bugs.hpp>
#include <subjects/linked.hpp>

namespace liecheck::properties {
namespace {

template <class S>
struct BugKind {
  const char *prefix, *version;
  std::vector<typename Bugs<S>::Entries> groups;
};

template <class S>
const std::vector<BugKind<S>>& kinds() {
  using B = Bugs<S>;
  static const std::vector<BugKind<S>> all = {
      {"bug:",
       "a known bug",
       {B::exp_of_rotations(), B::log_of_rotations(), B::exp_and_log_of_poses(), B::jacobians(),
        B::integration(), B::differences(), B::configuration_derivatives(), B::robots(),
        B::points_motions_and_forces(), B::inertias(), B::dynamics_of_trees(), B::frames_of_trees(),
        B::relative_rotations(), B::euler_angles(), B::rates_and_planar_poses(), B::representations(),
        B::transforms_and_means(), B::navigation(), B::derivatives_of_trees()}},
      {"alike:", "a look-alike", {B::look_alikes_of_rotations(), B::look_alikes_of_poses_and_bodies()}}};
  return all;
}

}  // namespace

template <class S>
std::vector<TypedSubject<S>> known_bugs(const TypedOperations<S>& good) {
  Bugs<S>::good() = good;
  std::vector<TypedSubject<S>> all;
  for (const BugKind<S>& kind : kinds<S>())
    for (const auto& group : kind.groups)
      for (const auto& entry : group) {
        TypedSubject<S>& subject =
            all.emplace_back(TypedSubject<S>{kind.prefix + std::string(entry.name), kind.version, good});
        subject.operations.tree = nullptr;  // only bugs of trees have a faulty `tree`
        entry.plant(subject.operations);
      }
  return all;
}

const std::vector<KnownBug>& known_bug_table() {
  static const std::vector<KnownBug> table = [] {
    std::vector<KnownBug> all;
    for (const auto& kind : kinds<double>())
      for (const auto& group : kind.groups)
        for (const auto& entry : group)
          all.push_back({kind.prefix + std::string(entry.name), entry.fault, entry.origin});
    return all;
  }();
  return table;
}

template std::vector<TypedSubject<float>> known_bugs(const TypedOperations<float>&);
template std::vector<TypedSubject<double>> known_bugs(const TypedOperations<double>&);

namespace {

[[maybe_unused]] const bool linked =
    (linked_bugs<float> = &known_bugs<float>, linked_bugs<double> = &known_bugs<double>, true);

}  // namespace

}  // namespace liecheck::properties

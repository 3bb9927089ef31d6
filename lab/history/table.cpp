#include <algorithm>
#include <cmath>
#include <history/history.hpp>
#include <subjects/liecheck_trees.hpp>
#include <subjects/linked.hpp>

namespace liecheck::properties {

namespace {

std::vector<std::vector<HistoricBug> (*)()>& groups() {
  static std::vector<std::vector<HistoricBug> (*)()> all;
  return all;
}

std::vector<TypedSubject<double>> subjects_of_history(const TypedOperations<double>& good) {
  Bugs<double>::good() = good;
  std::vector<TypedSubject<double>> all;
  for (const HistoricBug& b : historic_bugs())
    for (const bool fixed : {false, true}) {
      const auto& plant = fixed ? b.forms.fixed : b.forms.faulty;
      if (plant) {
        TypedOperations<double>& o =
            all.emplace_back(TypedSubject<double>{b.subject(fixed), b.thread, {}}).operations;
        plant(o);
        o.check_quaternion = good.check_quaternion, o.check_rotation = good.check_rotation;
      }
    }
  return all;
}

[[maybe_unused]] const bool linked = (linked_history = &subjects_of_history, true);

}  // namespace

HistoryRows::HistoryRows(std::vector<HistoricBug> (*rows)()) {
  groups().push_back(rows);
}

const std::vector<HistoricBug>& historic_bugs() {
  static const std::vector<HistoricBug> table = [] {
    std::vector<HistoricBug> all;
    for (auto* rows : groups())
      for (HistoricBug& b : rows()) all.push_back(std::move(b));
    std::ranges::sort(all, {}, &HistoricBug::name);
    return all;
  }();
  return table;
}

TreeOperations<double> correct_tree(const Tree<double>& tree) {
  return liecheck_tree<double>(tree);
}

namespace history {

V3 log_by_atan2(const V4& Q) {
  const V3 v = Q.head<3>();
  const double s = v.stableNorm();
  if (s == 0) return V3::Zero();
  return (Q[3] < 0 ? -2 * std::atan2(s, -Q[3]) : 2 * std::atan2(s, Q[3])) / s * v;
}

V4 quaternion_by_pivot(const M3& R) {
  const V3 a = 2 * skew_part(R), d = R.diagonal();
  V4 Q;
  int i = 0;
  if (d.maxCoeff(&i) < R.trace()) {
    Q << a, 1 + R.trace();
  } else {
    Q = V4::Zero();
    for (int k = 0; k < 3; ++k) Q[k] = k == i ? 1 + 2 * d[i] - R.trace() : R(i, k) + R(k, i);
    Q[3] = a[i];
  }
  return Q[3] < 0 ? V4(-Q) : Q;
}

}  // namespace history

}  // namespace liecheck::properties

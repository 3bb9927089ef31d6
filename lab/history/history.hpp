#pragma once
// Bugs that somebody reported against a real library: the faulty formula, written anew from what the report
// says, and beside it the repaired form. `history:NAME` offers the faulty form and `history:NAME:fixed` the
// repaired one, each only for the operation of the report. `--subject all` selects none of them.
// docs/laboratory.md says how to read the table that `liecheck lab history` prints.
//
// A file of this folder adds rows with a static HistoryRows. No other file needs a change.

#include <algorithm>
#include <bugs/planted_bugs.hpp>
#include <cmath>

namespace liecheck::properties {

/// The two forms of one operation.
struct Forms {
  std::string operation;  ///< its name
  std::function<void(TypedOperations<double>&)> faulty, fixed;
};

enum class HistoryKind {
  bug,
  control,       ///< a wrong term that no double can see: a law that accuses it is wrong
  not_expressed  ///< no formula can be written; `wrong` says why
};

struct HistoricBug {
  std::string name;     ///< without history:
  std::string library;  ///< and the version or commit, if the report names it
  std::string thread;   ///< OWNER/REPOSITORY#NUMBER, or a commit
  std::string region;   ///< of inputs
  std::string symptom;
  std::string wrong;  ///< one sentence: what was wrong
  Forms forms = {};
  HistoryKind kind = HistoryKind::bug;
  std::string subject(bool fixed = false) const { return "history:" + name + (fixed ? ":fixed" : ""); }
};

/// All rows, by name.
const std::vector<HistoricBug>& historic_bugs();

/// A static object adds rows.
struct HistoryRows {
  explicit HistoryRows(std::vector<HistoricBug> (*rows)());
};

/// Both forms of an operation on values of fixed size.
template <class Operation>
Forms forms(const Operation& operation, typename Operation::template Function<double> faulty,
            typename Operation::template Function<double> fixed) {
  const auto plant = [&operation](auto function) {
    return [&operation, function](TypedOperations<double>& o) { o[operation] = function; };
  };
  return {std::string(operation.name), plant(faulty), plant(fixed)};
}

/// Both forms of an operation on a tree of bodies. A form takes the tree and liecheck's correct algorithms on
/// it, and returns the function.
template <class Operation>
using OnTree = std::function<typename Operation::template Function<double>(
    const Tree<double>& tree, const TreeOperations<double>& good)>;
TreeOperations<double> correct_tree(const Tree<double>& tree);
template <class Operation>
Forms tree_forms(const Operation& operation, std::type_identity_t<OnTree<Operation>> faulty,
                 std::type_identity_t<OnTree<Operation>> fixed) {
  const auto plant = [&operation](auto form) {
    return [&operation, form](TypedOperations<double>& o) {
      o.tree = [&operation, form](const Tree<double>& tree) {
        TreeOperations<double> only;
        only[operation] = form(tree, correct_tree(tree));
        return only;
      };
    };
  };
  return {std::string(operation.name), plant(faulty), plant(fixed)};
}

/// What makes the rows of one operation with one repaired form: row(name, library, thread, region, symptom, wrong, faulty).
template <class Form, class MakeForms>
auto rows_with(const MakeForms& make_forms) {
  return [make_forms](const char* name, const char* library, const char* thread, const char* region,
                      const char* symptom, const char* wrong, const Form& faulty) {
    return HistoricBug{name, library, thread, region, symptom, wrong, make_forms(faulty)};
  };
}
template <class Operation>
auto rows_of(const Operation& operation, typename Operation::template Function<double> fixed) {
  using Form = typename Operation::template Function<double>;
  return rows_with<Form>([&operation, fixed](const Form& faulty) { return forms(operation, faulty, fixed); });
}
template <class Operation>
auto tree_rows_of(const Operation& operation, std::type_identity_t<OnTree<Operation>> fixed) {
  using Form = OnTree<Operation>;
  return rows_with<Form>(
      [&operation, fixed](const Form& faulty) { return tree_forms(operation, faulty, fixed); });
}

// Short names for the files of rows.
namespace history {
using H = Bugs<double>;
using V3 = H::V3;
using V4 = H::V4;
using V6 = H::V6;
using V7 = H::V7;
using M3 = H::M3;
using M6 = H::M6;
using P = H::P;

/// 2 atan2(|v|, w)/|v| v, on the side of w's sign: repaired forms share it.
V3 log_by_atan2(const V4& Q);
/// The quaternion of a rotation matrix by its largest pivot (Shepperd 1978), not normalised, w >= 0.
V4 quaternion_by_pivot(const M3& R);
/// sin(theta)(n) of R = exp(theta [n]): half of the skew part.
inline V3 skew_part(const M3& R) {
  return V3(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1)) / 2;
}
/// theta of R by its trace.
inline double clamped_angle(const M3& R) {
  return std::acos(std::clamp((R.trace() - 1) / 2, -1., 1.));
}
inline V3 log_by_pivot(const M3& R) {
  return log_by_atan2(quaternion_by_pivot(R));
}
inline V4 joined(const V3& v, double w) {
  return {v[0], v[1], v[2], w};
}
inline V4 by_pivot(const M3& R) {
  return quaternion_by_pivot(R).normalized();
}
inline V3 differences(const M3& R) {
  return 2 * skew_part(R);
}
inline M3 matrix_of(const V4& Q) {
  const M3 v = hat<double>(Q.head<3>());
  return M3::Identity() + 2 / Q.squaredNorm() * (Q[3] * v + v * v);
}
}  // namespace history

}  // namespace liecheck::properties

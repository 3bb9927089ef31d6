#include <failures/tree_changes.hpp>
#include <failures/tree_numbers.hpp>

namespace liecheck::properties {

namespace {

using Span = TreeNumbers::Span;
using Eigen::Matrix3d, Eigen::Vector3d;

Matrix3d symmetric(Span I) {
  Matrix3d matrix;
  matrix << I[0], I[1], I[3], I[1], I[2], I[4], I[3], I[4], I[5];
  return matrix;
}
void set_symmetric(Span I, const Matrix3d& matrix) {
  I[0] = matrix(0, 0), I[1] = matrix(0, 1), I[2] = matrix(1, 1);
  I[3] = matrix(0, 2), I[4] = matrix(1, 2), I[5] = matrix(2, 2);
}

/// What becomes of the second half, whose origin is at 2 c and whose axes are turned by R.
struct SecondHalf {
  const char* text;
  bool moved;             ///< to its origin
  Matrix3d for_c, for_I;  ///< in place of R
};
/// The rotation by 2 pi / 3 about (1, 1, 1).
const Matrix3d& R() {
  static const Matrix3d one = Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5).toRotationMatrix();
  return one;
}

/// A body in place of the first half, and of the second one as `second` says.
void unite(const SecondHalf& second, double mass, Eigen::Map<Vector3d> c, Span I) {
  const Matrix3d half = symmetric(I) / 2, own = R().transpose() * half * R();
  const Vector3d other = (second.moved ? 2 : 0) * c - second.for_c * (R().transpose() * c), d = c - other;
  set_symmetric(I, half + second.for_I * own * second.for_I.transpose() +
                       mass / 4 * (d.squaredNorm() * Matrix3d::Identity() - d * d.transpose()));
  c = ((c + other) / 2).eval();
}

TreeChange change_of_halves(const char* text, const std::function<void(const TreeNumbers&, int)>& change) {
  const auto apply = [change](std::vector<double>& x) {
    const TreeNumbers tree(x);
    for (int i = 0; i < tree.joints(); ++i) change(tree, i);
  };
  return {text, text, false, apply, true};
}

}  // namespace

const std::vector<TreeChange>& changes_of_halves() {
  static const std::vector<TreeChange> all = [] {
    const Matrix3d one = Matrix3d::Identity(), back = R().transpose();
    std::vector<TreeChange> changes{
        change_of_halves("one body alone of those on a joint", [](const TreeNumbers& tree, int i) {
          tree.mass(i) /= 2;
          for (double& x : tree.of_joint(i, TreeSlot::I, 6)) x /= 2;
        })};
    for (const SecondHalf& second :
         {SecondHalf{"a body that is not turned into the axes of its joint", true, one, one},
          SecondHalf{"a body that is turned by R^T in place of R into the axes of its joint", true, back,
                     back},
          SecondHalf{"a body whose I_C is not turned into the axes of its joint", true, R(), one},
          SecondHalf{"a body whose I_C is turned by R^T in place of R into the axes of its joint", true, R(),
                     back},
          SecondHalf{"a body whose centre of mass is not turned into the axes of its joint", true, one, R()},
          SecondHalf{"a body whose centre of mass is turned by R^T in place of R into the axes of its joint",
                     true, back, R()},
          SecondHalf{"a body that is not moved to its place on the joint", false, R(), R()}})
      changes.push_back(change_of_halves(second.text, [second](const TreeNumbers& tree, int i) {
        unite(second, tree.mass(i), Eigen::Map<Vector3d>(tree.of_joint(i, TreeSlot::c, 3).data()),
              tree.of_joint(i, TreeSlot::I, 6));
      }));
    return changes;
  }();
  return all;
}

}  // namespace liecheck::properties

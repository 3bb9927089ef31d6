#pragma once
// A joint with its place in the tree, in q [nq], in v [nv] and among the columns of the motion subspaces.
// Segments are fixed-size: nothing is allocated.

#include <liecheck/multibody/model.hpp>

namespace liecheck::multibody_detail {

/// Throws std::invalid_argument with both numbers.
inline void checkSize(Eigen::Index actual, int expected, const char* what, const char* dimension) {
  if (actual != expected)
    throw std::invalid_argument(std::string(what) + " has " + std::to_string(actual) +
                                " numbers, the model's " + dimension + " is " + std::to_string(expected));
}

template <Scalar S, class J>
struct Place {
  static constexpr bool mimics = std::is_same_v<J, Mimic<S>>;
  static constexpr int columns = J::columns;
  using Coordinates = Eigen::Matrix<S, columns, 1>;

  const Model<S>& model;
  const J& joint;
  int index, idx_q, idx_v, column;  ///< idx_q and idx_v of a mimic are its primary's

  typename J::Configuration configuration(const VectorX<S>& q) const {
    return q.template segment<J::nq>(idx_q);
  }
  typename J::Tangent tangent(const VectorX<S>& v) const { return v.template segment<J::nv>(idx_v); }
  auto configuration(VectorX<S>& q) const { return q.template segment<J::nq>(idx_q); }
  auto tangent(VectorX<S>& v) const { return v.template segment<J::nv>(idx_v); }
  auto jacobian(MatrixX<S>& M) const { return M.template block<J::nv, J::nv>(idx_v, idx_v); }
  auto coefficientJacobian(MatrixX<S>& M) const { return M.template block<J::nq, J::nv>(idx_q, idx_v); }

  /// Pose in the parent joint's frame.
  SE3<S> transform(const VectorX<S>& q) const {
    const SE3<S>& X_PJ = model.jointPlacements[std::size_t(index)];
    if constexpr (mimics) {
      using std::atan2;
      const bool turns = model.nqs[std::size_t(joint.primary)] == 2;
      const S y = turns ? S(atan2(q[idx_q + 1], q[idx_q])) : q[idx_q];
      return joint.transform(X_PJ, Vector1<S>(y));
    } else {
      return joint.transform(X_PJ, configuration(q));
    }
  }
  /// S v [6]: the velocity relative to the parent, in the joint's axes, at its origin. For v' it is what v'
  /// adds to the acceleration: S is constant, so there is no more.
  Motion<S> motion(const VectorX<S>& v) const {
    if constexpr (columns == 0)
      return Motion<S>::Zero();
    else if constexpr (columns == 6)
      return Motion<S>(Vector6<S>(v.template segment<6>(idx_v)));
    else
      return Motion<S>(Vector6<S>(joint.subspace() * v.template segment<columns>(idx_v)));
  }
  /// S^T F [columns]: what the joint feels of a force.
  Coordinates project(const Force<S>& F) const {
    if constexpr (columns == 0)
      return {};
    else if constexpr (columns == 6)
      return F.to_vector();
    else
      return joint.subspace().transpose() * F.to_vector();
  }
};

/// f(place) of joint i.
template <Scalar S, class F>
decltype(auto) visitJoint(const Model<S>& model, std::size_t i, F f) {
  return std::visit(
      [&]<class J>(const J& joint) {
        return f(Place<S, J>{model, joint, int(i), model.idx_qs[i], model.idx_vs[i], model.idx_columns[i]});
      },
      model.joints[i]);
}

/// f(place) for every joint but the universe, parents first.
template <Scalar S, class F>
void forEachJoint(const Model<S>& model, F f) {
  for (std::size_t i = 1; i < model.joints.size(); ++i) visitJoint(model, i, f);
}

}  // namespace liecheck::multibody_detail

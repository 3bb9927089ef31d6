#pragma once
// A joint of a Model with its indices in the tree, in q [nq], in v [nv] and in the columns of the motion
// subspaces. Segments have a fixed size, so nothing is allocated.

#include <liecheck/multibody/model.hpp>
#include <new>
#include <type_traits>

namespace liecheck {

/// A vector argument: the scalar is deduced from the model alone, so any Eigen expression may be passed.
template <class S>
using In = const std::type_identity_t<VectorX<S>>&;

namespace multibody_detail {

/// Throws std::invalid_argument with both sizes if they differ.
inline void checkSize(Eigen::Index actual, int expected, const char* what, const char* dimension) {
  if (actual != expected)
    throw std::invalid_argument(std::string(what) + " has " + std::to_string(actual) +
                                " numbers, the model's " + dimension + " is " + std::to_string(expected));
}

/// Constructs to = f() in place. A copy would stall: its wide loads would follow narrow stores.
template <class T, class F>
[[gnu::always_inline]] inline void build(T& to, F f) {
  if constexpr (std::is_trivially_destructible_v<T>)
    ::new (static_cast<void*>(&to)) T(f());
  else
    to = f();
}

template <Scalar S, class J>
struct JointPlace {
  static constexpr bool mimics = std::is_same_v<J, Mimic<S>>;
  static constexpr int columns = J::columns;
  using Coordinates = Eigen::Matrix<S, columns, 1>;

  const Model<S>& model;
  const J& joint;
  int index, idx_q, idx_v, column;  ///< of the joint; a mimic has idx_q and idx_v of its primary

  typename J::Configuration configuration(const VectorX<S>& q) const {
    return q.template segment<J::nq>(idx_q);
  }
  typename J::Tangent tangent(const VectorX<S>& v) const { return v.template segment<J::nv>(idx_v); }
  auto configuration(VectorX<S>& q) const { return q.template segment<J::nq>(idx_q); }
  auto tangent(VectorX<S>& v) const { return v.template segment<J::nv>(idx_v); }
  auto jacobian(MatrixX<S>& M) const { return M.template block<J::nv, J::nv>(idx_v, idx_v); }
  auto coefficientJacobian(MatrixX<S>& M) const { return M.template block<J::nq, J::nv>(idx_q, idx_v); }

  /// The pose in the parent joint's frame.
  [[gnu::always_inline]] SE3<S> transform(const VectorX<S>& q) const {
    const SE3<S>& X_PJ = model.jointPlacements[std::size_t(index)];
    if constexpr (mimics) {
      using std::atan2;
      const bool continuous = model.nqs[std::size_t(joint.primary)] == 2;
      const S y = continuous ? S(atan2(q[idx_q + 1], q[idx_q])) : q[idx_q];
      return joint.transform(X_PJ, Vector1<S>(y));
    } else {
      return joint.transform(X_PJ, configuration(q));
    }
  }
  static constexpr bool rotates = rotates_about_axis<S, J>;  ///< S = (0, axis), as for most joints

  /// S v [6]: the velocity relative to the parent, in the joint's axes, at its origin. If v is the
  /// derivative of the velocity, the result is one term of the spatial acceleration.
  Motion<S> motion(const VectorX<S>& v) const {
    if constexpr (rotates)
      return {Vector3<S>::Zero(), Vector3<S>(v[idx_v] * joint.axis.to_vector())};
    else if constexpr (columns == 6)
      return Motion<S>(Vector6<S>(v.template segment<6>(idx_v)));
    else
      return Motion<S>(Vector6<S>(joint.subspace() * v.template segment<columns>(idx_v)));
  }
  /// V x (S v), given relative = S v.
  static Motion<S> velocityProduct(const Motion<S>& V, const Motion<S>& relative) {
    if constexpr (rotates) {
      const Vector3<S>& w = relative.angular();
      return {cross<S>(V.linear(), w), cross<S>(V.angular(), w)};
    } else {
      return V.cross(relative);
    }
  }
  /// The generalised force S^T F [columns].
  Coordinates project(const Force<S>& F) const {
    if constexpr (rotates)
      return Coordinates(joint.axis.to_vector().dot(F.angular()));
    else if constexpr (columns == 6)
      return F.to_vector();
    else
      return joint.subspace().transpose() * F.to_vector();
  }
  /// Sets the 6 x columns numbers at `to` to S in axes rotated by R, one by one, as in build() above.
  [[gnu::always_inline]] void subspaceIn(const Matrix3<S>& R, S* to) const {
    if constexpr (rotates) {
      const Vector3<S> w = joint.axis.in(R);
      to[0] = to[1] = to[2] = S(0);
      to[3] = w[0], to[4] = w[1], to[5] = w[2];
    } else if constexpr (columns == 6) {  // [R, 0; 0, R]
      for (int k = 0; k < 3; ++k, to += 6) {
        to[0] = to[21] = R(0, k), to[1] = to[22] = R(1, k), to[2] = to[23] = R(2, k);
        to[3] = to[4] = to[5] = to[18] = to[19] = to[20] = S(0);
      }
    } else {
      const auto subspace = joint.subspace();
      for (int k = 0; k < columns; ++k, to += 6) {
        const Vector3<S> u = R * subspace.template block<3, 1>(0, k),
                         w = R * subspace.template block<3, 1>(3, k);
        for (int i = 0; i < 3; ++i) to[i] = u[i], to[3 + i] = w[i];
      }
    }
  }
};

/// Calls f(place) for joint i unless it is the universe.
template <Scalar S, class F>
void visitJoint(const Model<S>& model, std::size_t i, F f) {
  std::visit(
      [&]<class J>(const J& joint) {
        if constexpr (!std::is_same_v<J, Universe<S>>)
          f(JointPlace<S, J>{model, joint, int(i), model.idx_qs[i], model.idx_vs[i], model.idx_columns[i]});
      },
      model.joints[i]);
}

/// Calls f(place) for every joint except the universe, parents first.
template <Scalar S, class F>
void forEachJoint(const Model<S>& model, F f) {
  for (std::size_t i = 1; i < model.joints.size(); ++i) visitJoint(model, i, f);
}

}  // namespace multibody_detail
}  // namespace liecheck

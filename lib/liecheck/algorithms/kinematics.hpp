#pragma once
// Poses, velocities and accelerations of the joints.
//
//   oM_i = oM_p liM_i,  v_i = X^-1 v_p + S qd,  a_i = X^-1 a_p + S qdd + v_i x S qd, X = liM_i, p = parent(i)
// Featherstone (2008), eqs. 4.7 to 4.10. v_i and a_i are in joint i's axes at its origin. a_i is the spatial
// acceleration, the derivative of v_i's numbers; frames.hpp computes the classical acceleration.

#include <liecheck/multibody/data.hpp>

namespace liecheck {

namespace algorithms_detail {
template <Scalar S>
[[gnu::always_inline]] inline Vector3<S> added(const Vector3<S>& a, const Vector3<S>& b) {
  return each<S>([&](int i) { return S(a[i] + b[i]); });
}
/// V x W, V x* F, I V and X^-1 V as the members of Motion, Inertia and SE3, inlined for the recursions below.
template <Scalar S>
[[gnu::always_inline]] inline Motion<S> crossed(const Motion<S>& V, const Motion<S>& W) {
  return {added(cross<S>(V.angular(), W.linear()), cross<S>(V.linear(), W.angular())),
          cross<S>(V.angular(), W.angular())};
}
template <Scalar S>
[[gnu::always_inline]] inline Force<S> crossed(const Motion<S>& V, const Force<S>& F) {
  return {cross<S>(V.angular(), F.linear()),
          added(cross<S>(V.angular(), F.angular()), cross<S>(V.linear(), F.linear()))};
}
template <Scalar S>
[[gnu::always_inline]] inline Force<S> momentum(const Inertia<S>& I, const Motion<S>& V) {
  const Vector3<S> moved = cross<S>(V.angular(), I.lever());
  const Vector3<S> f = each<S>([&](int i) { return S(I.mass() * S(V.linear()[i] + moved[i])); });
  return {f, added(product<S>(I.inertia(), V.angular()), cross<S>(I.lever(), f))};
}
template <Scalar S>
[[gnu::always_inline]] inline Motion<S> actInv(const SE3<S>& X, const Motion<S>& V) {
  const Vector3<S> moved = cross<S>(X.translation(), V.angular());
  const Vector3<S> u = each<S>([&](int i) { return S(V.linear()[i] - moved[i]); });
  return {transposed_product<S>(X.rotation(), u), transposed_product<S>(X.rotation(), V.angular())};
}
template <Scalar S>
[[gnu::always_inline]] inline Force<S> act(const SE3<S>& X, const Force<S>& F) {
  const Vector3<S> f = product<S>(X.rotation(), F.linear());
  return {f, added(product<S>(X.rotation(), F.angular()), cross<S>(X.translation(), f))};
}
/// Computes the pose of a joint in the frame of its parent p, and in the world. Returns the vector from the
/// parent's origin, in world axes [m], without the cancellation of a difference of two world positions.
template <class Place, Scalar S>
[[gnu::always_inline]] inline Vector3<S> placeJoint(const Place& joint, const VectorX<S>& q, std::size_t p,
                                                    SE3<S>& liMi, std::vector<SE3<S>>& oMi) {
  using multibody_detail::build;
  SE3<S>& X_WJ = oMi[std::size_t(joint.index)];
  build(
      liMi, [&]() __attribute__((always_inline)) { return joint.transform(q); });
  if (p == 0) {
    X_WJ = liMi;
    return liMi.translation();
  }
  const Vector3<S> r = product<S>(oMi[p].rotation(), liMi.translation());
  build(
      X_WJ, [&]() __attribute__((always_inline)) {
        return SE3<S>(product<S>(oMi[p].rotation(), liMi.rotation()), added<S>(oMi[p].translation(), r));
      });
  return r;
}
}  // namespace algorithms_detail

/// Poses of the joints. Updates liMi, oMi. q [nq].
template <Scalar S>
void forwardKinematics(const Model<S>& model, Data<S>& data, In<S> q) {
  data.begin(model, q);
  auto& liMi = data.liMi.scratch();
  auto& oMi = data.oMi.scratch();
  multibody_detail::forEachJoint(model, [&](const auto& joint) {
    const std::size_t i = std::size_t(joint.index), p = std::size_t(model.parents[i]);
    algorithms_detail::placeJoint(joint, q, p, liMi[i], oMi);
  });
  data.liMi.write(Level::Position), data.oMi.write(Level::Position);
}

/// Poses and velocities of the joints. Updates liMi, oMi, v. q [nq], v [nv].
template <Scalar S>
void forwardKinematics(const Model<S>& model, Data<S>& data, In<S> q, In<S> v) {
  using namespace algorithms_detail;
  data.begin(model, q, v);
  auto& liMi = data.liMi.scratch();
  auto& oMi = data.oMi.scratch();
  auto& V = data.v.scratch();
  multibody_detail::forEachJoint(model, [&](const auto& joint) {
    const std::size_t i = std::size_t(joint.index), p = std::size_t(model.parents[i]);
    placeJoint(joint, q, p, liMi[i], oMi);
    V[i] = joint.motion(v);
    if (p > 0) V[i] = actInv(liMi[i], V[p]) + V[i];
  });
  data.liMi.write(Level::Position), data.oMi.write(Level::Position);
  data.v.write(Level::Velocity);
}

/// Poses, velocities and accelerations of the joints. Updates liMi, oMi, v, a. q [nq], v [nv], a [nv].
template <Scalar S>
void forwardKinematics(const Model<S>& model, Data<S>& data, In<S> q, In<S> v, In<S> a) {
  using namespace algorithms_detail;
  data.begin(model, q, v, a);
  auto& liMi = data.liMi.scratch();
  auto& oMi = data.oMi.scratch();
  auto& V = data.v.scratch();
  auto& A = data.a.scratch();
  multibody_detail::forEachJoint(model, [&](const auto& joint) {
    const std::size_t i = std::size_t(joint.index), p = std::size_t(model.parents[i]);
    placeJoint(joint, q, p, liMi[i], oMi);
    const Motion<S> relative = joint.motion(v);
    V[i] = p == 0 ? relative : actInv(liMi[i], V[p]) + relative;
    A[i] = joint.motion(a) + joint.velocityProduct(V[i], relative);
    if (p > 0) A[i] = actInv(liMi[i], A[p]) + A[i];
  });
  data.liMi.write(Level::Position), data.oMi.write(Level::Position);
  data.v.write(Level::Velocity), data.a.write(Level::Acceleration);
}

namespace algorithms_detail {

/// Computes the pose, work.r and work.S_columns of every joint, then calls f(joint, R_WJ). Updates liMi, oMi.
template <Scalar S, class F>
void columnsInWorldAxes(const Model<S>& model, Data<S>& data, In<S> q, F f) {
  data.begin(model, q);
  auto& liMi = data.liMi.scratch();
  auto& oMi = data.oMi.scratch();
  multibody_detail::forEachJoint(model, [&](const auto& joint) {
    const std::size_t i = std::size_t(joint.index), p = std::size_t(model.parents[i]);
    multibody_detail::build(
        data.work.r[i], [&]()
                            __attribute__((always_inline)) { return placeJoint(joint, q, p, liMi[i], oMi); });
    joint.subspaceIn(oMi[i].rotation(), data.work.S_columns.data() + 6 * joint.column);
    f(joint, oMi[i].rotation());
  });
  data.liMi.write(Level::Position), data.oMi.write(Level::Position);
}
template <Scalar S>
void columnsInWorldAxes(const Model<S>& model, Data<S>& data, In<S> q) {
  columnsInWorldAxes(model, data, q, [](const auto&, const auto&) {});
}
/// Column k of the motion subspaces, 6 numbers each, in world axes at the joint's origin.
template <Scalar S>
[[gnu::always_inline]] inline Motion<S> column(const S* columns, int k) {
  const S* s = columns + 6 * k;
  return {Vector3<S>(s[0], s[1], s[2]), Vector3<S>(s[3], s[4], s[5])};
}
template <Scalar S>
[[gnu::always_inline]] inline Motion<S> column(const Matrix6X<S>& columns, int k) {
  return column(columns.data(), k);
}

/// V with its reference point moved by d [m]: the linear velocity u becomes u + omega x d.
template <Scalar S>
[[gnu::always_inline]] inline Motion<S> shifted(const Motion<S>& V, const Vector3<S>& d) {
  return {added(V.linear(), cross<S>(V.angular(), d)), V.angular()};
}
/// F with its reference point moved by -d [m]: the moment n becomes n + d x f.
template <Scalar S>
[[gnu::always_inline]] inline Force<S> shifted(const Force<S>& F, const Vector3<S>& d) {
  return {F.linear(), added(F.angular(), cross<S>(d, F.linear()))};
}
template <Scalar S>
void checkForces(const Model<S>& model, const External<S>& forces) {
  if (!forces.empty())
    multibody_detail::checkSize(Eigen::Index(forces.size()), model.njoints, "fext", "njoints");
}

}  // namespace algorithms_detail
// instantiations_*.cpp instantiates these for float and double.
extern template void forwardKinematics(const Model<float>&, Data<float>&, In<float>);
extern template void forwardKinematics(const Model<float>&, Data<float>&, In<float>, In<float>);
extern template void forwardKinematics(const Model<float>&, Data<float>&, In<float>, In<float>, In<float>);
extern template void forwardKinematics(const Model<double>&, Data<double>&, In<double>);
extern template void forwardKinematics(const Model<double>&, Data<double>&, In<double>, In<double>);
extern template void forwardKinematics(const Model<double>&, Data<double>&, In<double>, In<double>,
                                       In<double>);

}  // namespace liecheck

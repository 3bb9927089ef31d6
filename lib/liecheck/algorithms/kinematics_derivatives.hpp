#pragma once
// Derivatives of the velocity and the spatial acceleration of a frame with respect to q (along integrate), v and a.
//
// In the notation of derivatives.hpp, without gravity, for a supporting column s of joint j with parent p, and with V and A
// of the frame, all at the frame's origin in world axes, d = w and D = z + w x V are the changes that an observer who moves
// with the subtree sees:
//
//   dV/dq   LOCAL  R^T d     WORLD  d + s x V     LOCAL_WORLD_ALIGNED  d + (omega_s x u, omega_s x omega)
//   dA/dq   LOCAL  R^T D     WORLD  D + s x A     LOCAL_WORLD_ALIGNED  D + (omega_s x A_u, omega_s x A_omega)
//   dA/dv   y + s x V, in the axes and at the point of the reference
//   dV/dv = dA/da           the frame's Jacobian
//
// In LOCAL_WORLD_ALIGNED the reference point moves with the frame, so that the linear part of s does not appear.
// Carpentier & Mansard (2018), section III; Pinocchio issue 2702.

#include <liecheck/algorithms/derivatives.hpp>
#include <liecheck/algorithms/jacobians.hpp>

namespace liecheck {

/// The rates of all columns and the motions of all bodies, for the getters below. Updates liMi, oMi, motion_rates.
/// q [nq], v, a [nv].
template <Scalar S>
void computeForwardKinematicsDerivatives(const Model<S>& model, Data<S>& data, In<S> q, In<S> v, In<S> a) {
  using namespace algorithms_detail;
  data.require(Dense::Derivatives, "computeForwardKinematicsDerivatives");
  columnsInWorldAxes(model, data, q);
  data.begin(model, q, v, a);
  const VectorX<S> speed = v, acceleration = a;
  ratesOfColumns<false>(model, data, speed, acceleration, External<S>(), Vector3<S>(Vector3<S>::Zero()));
  // Exchanged with the workspace, which every algorithm fills before it reads.
  MotionRates<S>& rates = data.motion_rates.write(Level::Acceleration);
  auto& work = data.work;
  rates.columns.resize(24, model.ncolumns), rates.columns.swap(work.rates);
  const auto exchange = [n = model.joints.size()](auto& to, auto& from) {
    to.resize(n, from[0]), to.swap(from);
  };
  exchange(rates.velocity, work.bias), exchange(rates.acceleration, work.gravitated),
      exchange(rates.from_root, work.r);
}

namespace algorithms_detail {

/// Calls f(index in v, get) for each supporting column of a frame. get(RateColumn<S>::s), and likewise w, z and y, gives a rate
/// of the column about the point that is `at` [m] from the origin of the root of the branch.
template <Scalar S, class F>
[[gnu::always_inline]] inline void forEachRate(const Model<S>& model, const MotionRates<S>& rates,
                                               std::size_t joint, const Vector3<S>& at, F f) {
  for (std::size_t i = joint; i > 0; i = std::size_t(model.parents[i])) {
    const int begin = model.idx_columns[i], end = begin + model.column_counts[i];
    for (int k = begin; k < end; ++k) {
      const RateColumn<S> column{const_cast<S*>(rates.columns.data()) + 24 * k};
      f(
          model.column_to_v[std::size_t(k)], [&](int first) __attribute__((always_inline)) {
            return shifted(column.get(first), at);
          });
    }
  }
}
template <Scalar S>
[[gnu::always_inline]] inline Motion<S> sum(const Motion<S>& a, const Motion<S>& b) {
  return {added(a.linear(), b.linear()), added(a.angular(), b.angular())};
}
/// A frame's motions in the reference that is fixed when the code is compiled, and the changes of columns to it.
template <ReferenceFrame reference, Scalar S>
struct FrameRates {
  const MotionRates<S>& rates;
  Matrix3<S> R_WF;
  Vector3<S> at;  ///< of the point of the reference; of the frame in LOCAL
  Motion<S> V, A;
  FrameRates(const Data<S>& data, const Placed<S>& frame) : rates(data.motion_rates()) {
    const SE3<S>& X = data.oMi()[frame.joint];
    const Vector3<S>& r = rates.from_root[frame.joint];
    R_WF = product<S>(X.rotation(), frame.X_JF.rotation());
    at = reference == ReferenceFrame::WORLD ? Vector3<S>(r - X.translation())
                                            : added(r, product<S>(X.rotation(), frame.X_JF.translation()));
    V = shifted(rates.velocity[frame.joint], at), A = shifted(rates.acceleration[frame.joint], at);
  }
  /// Adds m to column k of a matrix.
  template <class Out>
  [[gnu::always_inline]] void put(Out& to, int k, const Motion<S>& m) const {
    S* const numbers = &to.coeffRef(0, k);
    Vector3<S> u = m.linear(), w = m.angular();
    if constexpr (reference == ReferenceFrame::LOCAL)
      u = transposed_product<S>(R_WF, u), w = transposed_product<S>(R_WF, w);
    for (int i = 0; i < 3; ++i) numbers[i] += u[i], numbers[3 + i] += w[i];
  }
  /// The change of a motion M in the reference, where d is the change that an observer sees who moves with the subtree.
  [[gnu::always_inline]] Motion<S> seen(const Motion<S>& d, const Motion<S>& s, const Motion<S>& M) const {
    if constexpr (reference == ReferenceFrame::LOCAL) return d;
    if constexpr (reference == ReferenceFrame::WORLD) return sum(d, crossed(s, M));
    return {added(d.linear(), cross<S>(s.angular(), M.linear())),
            added(d.angular(), cross<S>(s.angular(), M.angular()))};
  }
};
/// f(FrameRates) in the reference.
template <Scalar S, class F>
void inReference(const Data<S>& data, const Placed<S>& frame, ReferenceFrame reference, F f) {
  if (reference == ReferenceFrame::WORLD) return f(FrameRates<ReferenceFrame::WORLD, S>(data, frame));
  if (reference == ReferenceFrame::LOCAL) return f(FrameRates<ReferenceFrame::LOCAL, S>(data, frame));
  f(FrameRates<ReferenceFrame::LOCAL_WORLD_ALIGNED, S>(data, frame));
}

}  // namespace algorithms_detail

/// dV/dq and dV/dv [6 x nv] of a frame. Throws std::invalid_argument if a matrix has another size or there is no such
/// frame. Needs motion_rates.
template <Scalar S>
void getFrameVelocityDerivatives(const Model<S>& model, const Data<S>& data, int frame,
                                 ReferenceFrame reference, JacobianOut<S> dV_dq, JacobianOut<S> dV_dv) {
  using namespace algorithms_detail;
  Eigen::Ref<Matrix6X<S>> by_q = cleared(model, dV_dq), by_v = cleared(model, dV_dv);
  const Placed<S> F = placedFrame(model, data, frame);
  inReference(data, F, reference, [&](const auto& x) {
    forEachRate(
        model, x.rates, F.joint, x.at, [&](int k, auto get) __attribute__((always_inline)) {
          const Motion<S> s = get(RateColumn<S>::s);
          x.put(by_q, k, x.seen(get(RateColumn<S>::w), s, x.V)), x.put(by_v, k, s);
        });
  });
}
/// dA/dq, dA/dv and dA/da [6 x nv] of the spatial acceleration of a frame, as getFrameAcceleration gives it. Throws as above.
/// Needs motion_rates.
template <Scalar S>
void getFrameAccelerationDerivatives(const Model<S>& model, const Data<S>& data, int frame,
                                     ReferenceFrame reference, JacobianOut<S> dA_dq, JacobianOut<S> dA_dv,
                                     JacobianOut<S> dA_da) {
  using namespace algorithms_detail;
  Eigen::Ref<Matrix6X<S>> by_q = cleared(model, dA_dq), by_v = cleared(model, dA_dv),
                          by_a = cleared(model, dA_da);
  const Placed<S> F = placedFrame(model, data, frame);
  inReference(data, F, reference, [&](const auto& x) {
    forEachRate(
        model, x.rates, F.joint, x.at, [&](int k, auto get) __attribute__((always_inline)) {
          const Motion<S> s = get(RateColumn<S>::s),
                          D = sum(get(RateColumn<S>::z), crossed(get(RateColumn<S>::w), x.V));
          x.put(by_q, k, x.seen(D, s, x.A)), x.put(by_v, k, sum(get(RateColumn<S>::y), crossed(s, x.V))),
              x.put(by_a, k, s);
        });
  });
}

}  // namespace liecheck

#pragma once
// Derivatives of the momentum h_G about the centre of mass c, and of its rate, with respect to q (along integrate) and v.
//
// In the notation of derivatives.hpp, without gravity, with momentum h and force F of the subtree of a column s, about O:
//
//   dh/dq = s x* h + I w        dh'/dq = s x* F + I z + B w        dh'/dv = I y + B s
//
// About c the moment is k - c x l, and c moves: dc/dq = (I s)_linear / m. Pinocchio issues 1473 and 2093.
// Carpentier & Mansard (2018); Orin, Goswami & Lee (2013).

#include <liecheck/algorithms/centroidal.hpp>
#include <liecheck/algorithms/derivatives.hpp>
#include <liecheck/algorithms/jacobians.hpp>

namespace liecheck {

/// dh/dq, dh'/dq, dh'/dv and dh'/da = A_G [6 x nv] of computeCentroidalMomentum and its time variation. Updates liMi, oMi.
/// Throws std::invalid_argument if a matrix has another size, and std::domain_error if there is no mass.
template <Scalar S>
void computeCentroidalDynamicsDerivatives(const Model<S>& model, Data<S>& data, In<S> q, In<S> v, In<S> a,
                                          JacobianOut<S> dh_dq, JacobianOut<S> dhdot_dq,
                                          JacobianOut<S> dhdot_dv, JacobianOut<S> dhdot_da) {
  using namespace algorithms_detail;
  data.require(Dense::Derivatives, "computeCentroidalDynamicsDerivatives");
  const S mass = requireTotalMass(model);
  columnsInWorldAxes(model, data, q);
  data.begin(model, q, v, a);
  const VectorX<S> speed = v, acceleration = a;
  ratesOfColumns(model, data, speed, acceleration, External<S>(), Vector3<S>(Vector3<S>::Zero()));
  auto& work = data.work;
  const std::size_t n = model.joints.size();
  const auto& oMi = data.oMi();
  Vector3<S> l = Vector3<S>::Zero(), push = l, c = l;  // of all branches; c is from the root of one
  for (std::size_t j = n - 1; j > 0; --j) {
    const std::size_t p = std::size_t(model.parents[j]);
    if (p == 0)
      l += work.moving[j].f, push += work.force[j].linear();
    else
      work.moving[p] += work.moving[j], work.force[p] = work.force[p] + work.force[j];
  }
  std::size_t seen_from = 0;
  const auto set_centre = [&](std::size_t root) {
    if (seen_from == root) return;
    Vector3<S> first_moment = Vector3<S>::Zero();
    for (std::size_t j = 1; j < n; ++j)
      if (model.parents[j] == 0)
        first_moment +=
            work.moving[j].h + work.moving[j].mass * (oMi[j].translation() - oMi[root].translation());
    c = first_moment / mass, seen_from = root;
  };
  Eigen::Ref<Matrix6X<S>> h_q = cleared(model, dh_dq), f_q = cleared(model, dhdot_dq),
                          f_v = cleared(model, dhdot_dv), f_a = cleared(model, dhdot_da);
  // The rate of F about c, where c moves by dc.
  const auto about_centre = [&](const Force<S>& dF, const Vector3<S>& momentum, const Vector3<S>& dc) {
    Vector6<S> x;
    x << dF.linear(), dF.angular() - cross<S>(c, dF.linear()) - cross<S>(dc, momentum);
    return x;
  };
  const Vector3<S> still = Vector3<S>::Zero();
  for (int k = 0; k < model.ncolumns; ++k) {
    const std::size_t j = std::size_t(model.column_to_joint[std::size_t(k)]);
    std::size_t root = j;
    while (model.parents[root] > 0) root = std::size_t(model.parents[root]);
    set_centre(root);
    const RateColumn<S> column_k{work.rates.data() + 24 * k};
    const MovingInertia<S>& moving = work.moving[j];
    const Motion<S> s = column_k.get(RateColumn<S>::s), w = column_k.get(RateColumn<S>::w);
    const Force<S> I_s = moving.momentum(s), h(moving.f, moving.n);
    const Vector3<S> dc = I_s.linear() / mass;
    const int at = model.column_to_v[std::size_t(k)];
    h_q.col(at) += about_centre(crossed(s, h) + moving.momentum(w), l, dc);
    f_q.col(at) +=
        about_centre(crossed(s, work.force[j]) + moving.force(column_k.get(RateColumn<S>::z), w), push, dc);
    f_v.col(at) += about_centre(moving.force(column_k.get(RateColumn<S>::y), s), push, still);
    f_a.col(at) += about_centre(I_s, push, still);
  }
}

}  // namespace liecheck

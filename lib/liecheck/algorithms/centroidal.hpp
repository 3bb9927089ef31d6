#pragma once
// Centroidal quantities: centre of mass c, momentum h_G about c in world axes, and A_G with h_G = A_G v.
// Orin, Goswami & Lee (2013). Bodies fixed to the world are excluded. If the total mass is not positive and
// finite, c is not defined: every algorithm below then throws std::domain_error, and changes no field.

#include <liecheck/algorithms/crba.hpp>

namespace liecheck {

/// Total mass of the bodies that are not fixed to the world [kg]; 0 if there are none.
template <Scalar S>
S computeTotalMass(const Model<S>& model) {
  S mass(0);
  for (std::size_t i = 1; i < model.joints.size(); ++i) mass += model.inertias[i].mass();
  return mass;
}

namespace algorithms_detail {

/// The total mass. Throws std::domain_error unless it is positive and finite.
template <Scalar S>
S requireTotalMass(const Model<S>& model) {
  const S mass = computeTotalMass(model);
  if (mass > S(0) && finite<S>(mass)) return mass;
  throw std::domain_error("model '" + model.name +
                          "' has no centre of mass: the total mass of its moving bodies is " +
                          (mass > S(0)    ? "not finite"
                           : mass < S(0)  ? "negative"
                           : mass == S(0) ? "0"
                                          : "NaN"));
}
/// sum m_i x(i) / m.
template <Scalar S, class F>
Vector3<S> massAverage(const Model<S>& model, const S& mass, F x) {
  S sum[3] = {S(0), S(0), S(0)};
  for (std::size_t i = 1; i < model.joints.size(); ++i) {
    const Vector3<S> x_i = x(i);
    for (int k = 0; k < 3; ++k) sum[k] = mul_add(model.inertias[i].mass(), x_i[k], sum[k]);
  }
  return Vector3<S>(sum[0] / mass, sum[1] / mass, sum[2] / mass);
}
/// The centre of mass. Updates com. Needs oMi.
template <Scalar S>
Vector3<S> averageOfCentres(const Model<S>& model, Data<S>& data, const S& mass) {
  return data.com.write(Level::Position) = massAverage(model, mass, [&](std::size_t i) -> Vector3<S> {
           return data.oMi[i].act(model.inertias[i].lever());
         });
}

/// The velocity of the centre of mass. Needs oMi, v.
template <Scalar S>
Vector3<S> averageOfVelocities(const Model<S>& model, const Data<S>& data, const S& mass) {
  return massAverage(model, mass, [&](std::size_t i) -> Vector3<S> {
    return product<S>(data.oMi[i].rotation(), shifted(data.v[i], model.inertias[i].lever()).linear());
  });
}

}  // namespace algorithms_detail

/// The centre of mass c [m]. Updates liMi, oMi, com. q [nq].
template <Scalar S>
Vector3<S> centerOfMass(const Model<S>& model, Data<S>& data, In<S> q) {
  const S mass = algorithms_detail::requireTotalMass(model);
  forwardKinematics(model, data, q);
  return algorithms_detail::averageOfCentres(model, data, mass);
}
/// Computes c [m] and c_dot [m/s]; returns c. Updates liMi, oMi, v, com, vcom. q [nq], v [nv].
template <Scalar S>
Vector3<S> centerOfMass(const Model<S>& model, Data<S>& data, In<S> q, In<S> v) {
  using namespace algorithms_detail;
  const S mass = requireTotalMass(model);
  forwardKinematics(model, data, q, v);
  data.vcom.write(Level::Velocity) = averageOfVelocities(model, data, mass);
  return averageOfCentres(model, data, mass);
}
/// Computes c, c_dot and c_ddot [m, m/s, m/s^2]; returns c. Updates liMi, oMi, v, a, com, vcom, acom.
/// q [nq], v, a [nv].
template <Scalar S>
Vector3<S> centerOfMass(const Model<S>& model, Data<S>& data, In<S> q, In<S> v, In<S> a) {
  using namespace algorithms_detail;
  const S mass = requireTotalMass(model);
  forwardKinematics(model, data, q, v, a);
  data.vcom.write(Level::Velocity) = averageOfVelocities(model, data, mass);
  data.acom.write(Level::Acceleration) = massAverage(model, mass, [&](std::size_t i) -> Vector3<S> {
    const Vector3<S>& c = model.inertias[i].lever();  // the classical acceleration of c
    const Vector3<S> omega_u = cross<S>(data.v[i].angular(), shifted(data.v[i], c).linear());
    return product<S>(data.oMi[i].rotation(), added(shifted(data.a[i], c).linear(), omega_u));
  });
  return averageOfCentres(model, data, mass);
}

/// A_G [6 x nv]: h_G = A_G v. Column k is the momentum Ic_j s_k about c. Updates liMi, oMi, com, Ag. q [nq].
template <Scalar S>
const Matrix6X<S>& computeCentroidalMap(const Model<S>& model, Data<S>& data, In<S> q) {
  using namespace algorithms_detail;
  requireTotalMass(model);
  compositeInertias(model, data, q);
  const Vector3<S> c = data.com.write(Level::Position) = data.work.inertia[0].c;
  auto& Ag = data.Ag.write(Level::Position);
  Ag.setZero();
  for (int k = 0; k < model.ncolumns; ++k) {
    const std::size_t i = std::size_t(model.column_to_joint[std::size_t(k)]);
    const Force<S> h = ColumnMomentum<S>(data.work.inertia[i], data.work.S_columns.data() + 6 * k).force();
    Ag.col(model.column_to_v[std::size_t(k)]) +=
        shifted(h, Vector3<S>(data.oMi[i].translation() - c)).to_vector();
  }
  return Ag;
}
/// Jcom [3 x nv], c_dot = Jcom v: the linear rows of A_G / mass. Column k is the momentum m_j (u + omega x c_j) of the subtree
/// of its joint over the mass. Updates liMi, oMi, com, Jcom. q [nq].
template <Scalar S>
const Matrix3X<S>& jacobianCenterOfMass(const Model<S>& model, Data<S>& data, In<S> q) {
  using namespace algorithms_detail;
  const S mass = requireTotalMass(model);
  auto& subtree = data.work.inertia;  // mass and centre alone
  subtree[0].mass = S(0), subtree[0].c = Vector3<S>::Zero();
  columnsInWorldAxes(model, data, q, [&](const auto& joint, const Matrix3<S>& R) {
    const std::size_t i = std::size_t(joint.index);
    subtree[i].mass = model.inertias[i].mass(), subtree[i].c = product<S>(R, model.inertias[i].lever());
  });
  for (std::size_t i = model.joints.size() - 1; i > 0; --i)
    subtree[std::size_t(model.parents[i])].joinCentre(subtree[i], data.work.r[i], data.work.joined[i]);
  data.com.write(Level::Position) = subtree[0].c;
  auto& J = data.Jcom.write(Level::Position);
  if (model.has_mimics) J.setZero();
  const S over_mass = S(1) / mass;
  for (int k = 0; k < model.ncolumns; ++k) {
    const CompositeInertia<S>& I = subtree[std::size_t(model.column_to_joint[std::size_t(k)])];
    const S share = I.mass * over_mass;
    const Vector3<S> u = shifted(column(data.work.S_columns, k), I.c).linear();
    S* const to = J.data() + 3 * model.column_to_v[std::size_t(k)];
    for (int i = 0; i < 3; ++i) to[i] = mul_add(share, u[i], model.has_mimics ? to[i] : S(0));
  }
  return J;
}

/// The momentum h_G about c [kg m/s, kg m^2/s]. Updates liMi, oMi, v, com, vcom, hg. q [nq], v [nv].
template <Scalar S>
Force<S> computeCentroidalMomentum(const Model<S>& model, Data<S>& data, In<S> q, In<S> v) {
  using namespace algorithms_detail;
  const Vector3<S> c = centerOfMass(model, data, q, v);
  Force<S>& hg = data.hg.write(Level::Velocity);
  hg = Force<S>::Zero();
  for (std::size_t i = 1; i < model.joints.size(); ++i)
    hg = hg + SE3<S>(data.oMi[i].rotation(), Vector3<S>(data.oMi[i].translation() - c))
                  .act(model.inertias[i] * data.v[i]);
  return hg;
}
/// Computes h_G and its rate [N, N m], the sum of the forces I a + v x* I v about c; returns the rate.
/// Updates liMi, oMi, v, a, com, vcom, acom, hg, dhg. q [nq], v, a [nv].
template <Scalar S>
Force<S> computeCentroidalMomentumTimeVariation(const Model<S>& model, Data<S>& data, In<S> q, In<S> v,
                                                In<S> a) {
  using namespace algorithms_detail;
  computeCentroidalMomentum(model, data, q, v);
  const Vector3<S> c = centerOfMass(model, data, q, v, a);
  Force<S>& dhg = data.dhg.write(Level::Acceleration);
  dhg = Force<S>::Zero();
  for (std::size_t i = 1; i < model.joints.size(); ++i) {
    const Inertia<S>& I = model.inertias[i];
    const Force<S> f = I * data.a[i] + data.v[i].cross(I * data.v[i]);
    dhg = dhg + SE3<S>(data.oMi[i].rotation(), Vector3<S>(data.oMi[i].translation() - c)).act(f);
  }
  return dhg;
}

// instantiations_*.cpp instantiates these for float and double.
extern template decltype(computeCentroidalMap<float>) computeCentroidalMap<float>;
extern template decltype(computeCentroidalMomentum<float>) computeCentroidalMomentum<float>;
extern template decltype(computeCentroidalMap<double>) computeCentroidalMap<double>;
extern template decltype(computeCentroidalMomentum<double>) computeCentroidalMomentum<double>;

}  // namespace liecheck

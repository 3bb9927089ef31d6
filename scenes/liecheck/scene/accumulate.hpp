#pragma once
// Compensated summation of many small increments (Kahan 1965), also on the group SE(3).
//
//   v:  (v, v_low) += dv, by two_sum
//   q:  (q, q_low) := q exp(delta); for a free-flyer q_low = (rounding error of p, in the world's axes [m];
//       rotation vector from the stored Q to the accumulated rotation, in the body's axes [rad])
//
// The accumulated state is q exp(q_low) and v + v_low, with |q_low| <= 2 eps |q|. The remaining error is the
// rounding error of each increment, eps |delta|.

#include <liecheck/multibody/joint_place.hpp>
#include <liecheck/multibody/se3_configuration.hpp>

namespace liecheck::scene {

/// Adds dx to the compensated sum x + low.
template <Scalar S>
[[gnu::always_inline]] inline void accumulate(S& x, S& low, const S& dx) {
  const auto [sum, rest] = two_sum<S>(x, S(dx + low));
  x = sum;
  low = rest;
}

/// Calls accumulate for each element of a vector.
template <class V>
[[gnu::always_inline]] inline void accumulateAll(V& x, V& low, const V& dx) {
  for (int i = 0; i < x.size(); ++i) accumulate<typename V::Scalar>(x[i], low[i], dx[i]);
}

/// Q exp(low) := Q exp(low) step. Q is the rounded product, low the rotation vector of its rounding error.
template <Scalar S>
void accumulateRotation(Eigen::Ref<Vector4<S>> Q, Eigen::Ref<Vector3<S>> low, const SO3<S>& step) {
  const auto product = se3_configuration_detail::Product<S, Precision::standard>(
                           SO3<S>(Vector4<S>(Q)).numbers(), step.numbers())
                           .sum;
  const Quad<S> low_part = product.low();
  Vector4<S> high, rest;
  for (int i = 0; i < 4; ++i) high[i] = product.high.v[i], rest[i] = low_part.v[i];
  // With b = step: Q exp(low) b - Q b = Q b (exp(R_b^T low) - 1) = Q b (R_b^T low / 2, 0), since low is tiny.
  const Vector3<S> low_b = step.template actInv<Precision::fast>(Vector3<S>(low));
  const SO3<S> change = SO3<S>(high) * SO3<S>(Vector3<S>(low_b / S(2)), S(0));
  for (int i = 0; i < 4; ++i) rest[i] += change.to_vector()[i];
  const auto square = [&](int i) { return S((high[i] + rest[i]) * (high[i] + rest[i])); };
  const S newton = (S(1) - ((square(0) + square(1)) + (square(2) + square(3)))) / S(2);
  Vector4<S> Q1, Q1_low;
  for (int i = 0; i < 4; ++i) {
    const auto [sum, e] = two_sum<S>(high[i], mul_add(newton, high[i], rest[i]));
    Q1[i] = sum, Q1_low[i] = e;
  }
  const SO3<S> half_low = SO3<S>(Q1).inverse() * SO3<S>(Q1_low);
  Q = Q1;
  low = S(2) * half_low.vec();
}

/// (q, low) := q exp(delta) for a free-flyer.
template <Scalar S>
void accumulateSE3(Vector7<S>& q, Vector6<S>& low, const Vector6<S>& delta) {
  const Vector3<S> phi(delta[3], delta[4], delta[5]), rho(delta[0], delta[1], delta[2]);
  with_coefficients<S, Precision::standard>(phi, [&](const auto& k) {
    const S s = sign<S>(k.cosine_half), sine = s * k.sine_half;
    const SO3<S> Q0(Vector4<S>(q[3], q[4], q[5], q[6]));
    const Vector3<S> step = Q0.act(exp_log_detail::arc(k, rho));
    for (int i = 0; i < 3; ++i) accumulate<S>(q[i], low[i], step[i]);
    accumulateRotation<S>(
        q.template tail<4>(), low.template tail<3>(),
        SO3<S>(Vector3<S>(sine * k.axis[0], sine * k.axis[1], sine * k.axis[2]), S(s * k.cosine_half)));
  });
}

/// (q, low) := q exp(delta) for one joint, low [nv]. Continuous and planar joints are not compensated.
template <Scalar S, class J>
void accumulateOf(const J& joint, typename J::Configuration& q, typename J::Tangent& low,
                  const typename J::Tangent& delta) {
  if constexpr (std::is_same_v<J, FreeFlyer<S>>) {
    accumulateSE3<S>(q, low, delta);
  } else if constexpr (std::is_same_v<J, Spherical<S>>) {
    accumulateRotation<S>(q, low, quaternion::exp3<S>(delta));
  } else if constexpr (J::nq == J::nv) {
    for (int i = 0; i < J::nv; ++i) accumulate<S>(q[i], low[i], delta[i]);
  } else {
    q = joint.integrate(q, delta);
  }
}

}  // namespace liecheck::scene

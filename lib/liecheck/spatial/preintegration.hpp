#pragma once
// Preintegration of inertial measurements: the rotation dR, position dp and velocity dv from measurements of the angular
// velocity omega and the specific force a in body axes, each held for the time dt, without gravity and without the initial
// velocity; and their derivatives by constant biases that are subtracted from the measurements.
//
//   Forster et al. 2017, eqs. 35 and 63-70     dp += dv dt + 1/2 dR a dt^2,      dv += dR a dt,      dR <- dR exp(omega dt)
//   Brossard et al. 2022, eqs. 28-33           dp += dv dt + dR G2 a dt^2,       dv += dR G1 a dt,   dR <- dR exp(omega dt)
//
// G1 = J_l(phi) = I + c2 [phi] + c3 [phi]^2 and G2 = I/2 + c3 [phi] + c4 [phi]^2 at phi = omega dt are exact for a
// measurement that is constant in body axes (c_k: scalar/stumpff.hpp).

#include <liecheck/spatial/extended_pose.hpp>

namespace liecheck {

template <Scalar S>
struct Preintegrated {
  ExtendedPose<S> delta{Matrix3<S>::Identity(), Vector3<S>::Zero(),
                        Vector3<S>::Zero()};  ///< dR, dp [m], dv [m/s]
  /// Derivatives by the biases of omega (g) and a (a). That of dR is on the right: dR exp(R_g b_g).
  Matrix3<S> R_g = Matrix3<S>::Zero(), p_g = R_g, p_a = R_g, v_g = R_g, v_a = R_g;

  /// dR row by row, dp, dv, shape 15.
  Eigen::Matrix<S, 15, 1> increment() const { return delta.to_vector(); }
  /// R_g, p_g, p_a, v_g, v_a one below the other, 15 x 3.
  Eigen::Matrix<S, 15, 3> by_biases() const {
    return (Eigen::Matrix<S, 15, 3>() << R_g, p_g, p_a, v_g, v_a).finished();
  }
};

namespace preintegration_detail {

/// G a = first a + c_k phi x a + c_{k+1} phi x (phi x a), its matrix G, and its derivative by phi.
template <Scalar S>
struct Integral {
  Vector3<S> value;
  Matrix3<S> matrix, by_phi;
  Integral(const std::array<S, 7>& c, int k, const S& first, const Vector3<S>& phi, const Vector3<S>& a) {
    const auto at = [&](int i) { return c[std::size_t(i)]; };
    const auto slope = [&](int i) { return S((S(i) * at(i + 2) - at(i + 1)) / S(2)); };  // d c_i / d theta^2
    const Matrix3<S> P = skew<S>(phi);
    const Vector3<S> once = cross<S>(phi, a), twice = cross<S>(phi, once);
    value = first * a + at(k) * once + at(k + 1) * twice;
    matrix = first * Matrix3<S>::Identity() + at(k) * P + at(k + 1) * P * P;
    by_phi = -at(k) * skew<S>(a) +
             at(k + 1) *
                 (S(phi.dot(a)) * Matrix3<S>::Identity() + phi * a.transpose() - S(2) * a * phi.transpose()) +
             S(2) * (slope(k) * once + slope(k + 1) * twice) * phi.transpose();
  }
};

template <bool exact, Scalar S, std::size_t N>
Preintegrated<S> preintegrated(const Eigen::Matrix<S, int(3 * N), 1>& gyro,
                               const Eigen::Matrix<S, int(3 * N), 1>& accelerometer, const S& dt) {
  Preintegrated<S> x;
  for (int n = 0; n < int(N); ++n) {
    const Vector3<S> phi = dt * gyro.template segment<3>(3 * n), a = accelerometer.template segment<3>(3 * n);
    const Matrix3<S> R = x.delta.R;
    Vector3<S> once = a, twice = a / S(2);
    Matrix3<S> G1 = Matrix3<S>::Identity(), G2 = G1 / S(2), once_phi = Matrix3<S>::Zero(),
               twice_phi = once_phi;
    if constexpr (exact) {
      const auto c = stumpff_functions<S>(phi.squaredNorm());
      const Integral<S> first(c, 2, S(1), phi, a), second(c, 3, S(1) / S(2), phi, a);
      once = first.value, G1 = first.matrix, once_phi = first.by_phi;
      twice = second.value, G2 = second.matrix, twice_phi = second.by_phi;
    }
    x.p_g += dt * x.v_g - dt * dt * (R * (skew<S>(twice) * x.R_g + dt * twice_phi));
    x.p_a += dt * x.v_a - dt * dt * (R * G2);
    x.v_g -= dt * (R * (skew<S>(once) * x.R_g + dt * once_phi));
    x.v_a -= dt * (R * G1);
    const Matrix3<S> step = exp3<S>(phi);
    x.R_g = step.transpose() * x.R_g - dt * rightJacobian<S>(phi);
    x.delta.p += dt * x.delta.v + dt * dt * (R * twice);
    x.delta.v += dt * (R * once);
    x.delta.R = R * step;
  }
  return x;
}

}  // namespace preintegration_detail

/// Of N measurements [3 N each; rad/s, m/s^2], one after the other, as Forster et al. define it. Error 4 N eps of the rotation
/// and of the sums of |a| dt and |a| dt^2 (N - n + 1/2), for |omega dt| <= pi; beyond pi, |omega dt| eps more.
template <Scalar S, std::size_t N>
Preintegrated<S> preintegratedForster(const Eigen::Matrix<S, int(3 * N), 1>& gyro,
                                      const Eigen::Matrix<S, int(3 * N), 1>& accelerometer, const S& dt) {
  return preintegration_detail::preintegrated<false, S, N>(gyro, accelerometer, dt);
}
/// The same as Brossard et al. define it: exact if each measurement is constant in body axes.
/// Throws std::invalid_argument if |omega dt|^2 is not finite.
template <Scalar S, std::size_t N>
Preintegrated<S> preintegratedBrossard(const Eigen::Matrix<S, int(3 * N), 1>& gyro,
                                       const Eigen::Matrix<S, int(3 * N), 1>& accelerometer, const S& dt) {
  return preintegration_detail::preintegrated<true, S, N>(gyro, accelerometer, dt);
}

}  // namespace liecheck

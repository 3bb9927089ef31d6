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
    const S &c1 = at(k), &c2 = at(k + 1), s1 = S(2) * slope(k), s2 = S(2) * slope(k + 1),
            along = c2 * dot<S>(phi, a);
    const Vector3<S> once = cross<S>(phi, a), twice = cross<S>(phi, once);
    const Vector3<S> moved = each<S>([&](int i) { return S(c2 * phi[i]); });
    // The factor of phi^T in by_phi.
    const Vector3<S> rate =
        each<S>([&](int i) { return mul_add(s1, once[i], S(s2 * twice[i] - S(2) * c2 * a[i])); });
    value = each<S>([&](int i) { return mul_add(first, a[i], mul_add(c1, once[i], S(c2 * twice[i]))); });
    const auto fill =
        [](const S& d0, const S& d1, const S& d2, const S& by, const Vector3<S>& v, const Vector3<S>& x,
           const Vector3<S>& y, const Vector3<S>& z, const Vector3<S>& w) __attribute__((always_inline)) {
      // diag(d) + by [v] + x y^T + z w^T
      const auto entry = [&](int i, int j, const S& n) __attribute__((always_inline)) {
        return mul_add(x[i], y[j], mul_add(z[i], w[j], n));
      };
      const S v0 = by * v[0], v1 = by * v[1], v2 = by * v[2];
      return rows<S>(entry(0, 0, d0), entry(0, 1, S(-v2)), entry(0, 2, v1), entry(1, 0, v2), entry(1, 1, d1),
                     entry(1, 2, S(-v0)), entry(2, 0, S(-v1)), entry(2, 1, v0), entry(2, 2, d2));
    };
    const S xx = moved[0] * phi[0], yy = moved[1] * phi[1], zz = moved[2] * phi[2];
    const auto quadratic = [&](int i, int j) __attribute__((always_inline)) {
      return S(moved[i] * phi[j]);
    };
    matrix = rows<S>(first - (yy + zz), quadratic(0, 1) - c1 * phi[2], quadratic(0, 2) + c1 * phi[1],
                     quadratic(0, 1) + c1 * phi[2], first - (xx + zz), quadratic(1, 2) - c1 * phi[0],
                     quadratic(0, 2) - c1 * phi[1], quadratic(1, 2) + c1 * phi[0], first - (xx + yy));
    by_phi = fill(along, along, along, S(-c1), a, moved, a, rate, phi);
  }
};

template <bool exact, Scalar S, std::size_t N>
Preintegrated<S> preintegrated(const Eigen::Matrix<S, int(3 * N), 1>& gyro,
                               const Eigen::Matrix<S, int(3 * N), 1>& accelerometer, const S& dt) {
  // Entry by entry: blocks of Eigen that were just written would be loaded again.
  const auto scaled_sum =
      [](const Matrix3<S>& A, const S& b, const Matrix3<S>& B) __attribute__((always_inline)) {
    Matrix3<S> m;
    for (int i = 0; i < 9; ++i) m.data()[i] = mul_add(b, B.data()[i], A.data()[i]);
    return m;
  };
  Preintegrated<S> x;
  const S square = dt * dt;
  for (int n = 0; n < int(N); ++n) {
    const Vector3<S> phi = dt * gyro.template segment<3>(3 * n), a = accelerometer.template segment<3>(3 * n);
    const Matrix3<S> R = x.delta.R;
    Vector3<S> once = a, twice = a / S(2);
    x.p_g = scaled_sum(x.p_g, dt, x.v_g), x.p_a = scaled_sum(x.p_a, dt, x.v_a);
    if constexpr (exact) {
      const auto c = stumpff_functions<S>(phi.squaredNorm());
      const Integral<S> first(c, 2, S(1), phi, a), second(c, 3, S(1) / S(2), phi, a);
      once = first.value, twice = second.value;
      x.p_g = scaled_sum(x.p_g, S(-square),
                         product<S>(R, scaled_sum(product<S>(skew<S>(twice), x.R_g), dt, second.by_phi)));
      x.v_g = scaled_sum(x.v_g, S(-dt),
                         product<S>(R, scaled_sum(product<S>(skew<S>(once), x.R_g), dt, first.by_phi)));
      x.p_a = scaled_sum(x.p_a, S(-square), product<S>(R, second.matrix));
      x.v_a = scaled_sum(x.v_a, S(-dt), product<S>(R, first.matrix));
    } else {
      const Matrix3<S> turned = product<S>(R, product<S>(skew<S>(a), x.R_g));
      x.p_g = scaled_sum(x.p_g, S(-square / S(2)), turned), x.v_g = scaled_sum(x.v_g, S(-dt), turned);
      x.p_a = scaled_sum(x.p_a, S(-square / S(2)), R), x.v_a = scaled_sum(x.v_a, S(-dt), R);
    }
    // exp [phi] and J_r(phi) = I - c2 [phi] + c3 [phi]^2.
    with_coefficients<S, Precision::standard>(phi, [&](const auto& k) {
      const Matrix3<S> step = exp_log_detail::matrix(k);
      x.R_g = scaled_sum(transposed_product<S>(step, x.R_g), S(-dt),
                         exp_log_detail::quadratic<S>(k.axis, S(-k.k2), k.k3));
      x.delta.R = product<S>(R, step);
      return 0;
    });
    const Vector3<S> moved = product<S>(R, twice), pushed = product<S>(R, once);
    for (int i = 0; i < 3; ++i) {
      x.delta.p[i] += mul_add(dt, x.delta.v[i], S(square * moved[i]));
      x.delta.v[i] += dt * pushed[i];
    }
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

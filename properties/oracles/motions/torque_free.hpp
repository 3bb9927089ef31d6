#pragma once
// Torque-free bodies: the first two motions need no elliptic functions.

#include <oracles/motions/state.hpp>

namespace liecheck::oracles {

/// Constant twist: the body rotates about a principal axis, or about any axis if its moments are equal. Then
/// omega x I omega = 0 and R = R0 exp([omega] t).
template <class T>
AttitudeState<T> constant_twist(const AttitudeState<T>& initial, const T& t) {
  return {quaternion_product(initial.Q, rotation_by<T>(t * initial.omega)), initial.omega};
}

/// Two equal principal moments I_t, and the moment I_a about the axis a (unit, in B).
///   omega = L/I_t + (1 - I_a/I_t) (a . omega) a, so that
///   R(t) = exp([L_W / I_t] t) R0 exp([a] Omega t),   Omega = (1 - I_a/I_t) (a . omega0), constant
///   omega(t) = exp(-[a] Omega t) omega0
/// Landau and Lifshitz, Mechanics, section 33 (regular precession).
template <class T = Real>
struct AxisymmetricBody {
  T transverse, axial;  ///< I_t, I_a [kg m^2]
  Vec3<T> axis;         ///< unit, in the axes of B
  AttitudeState<T> initial;

  AttitudeState<T> at(const T& t) const {
    const T spin = dot(axis, initial.omega), rate = (1 - axial / transverse) * spin;
    const Vec3<T> L_over_It = rotate(initial.Q, initial.omega + T((axial / transverse - 1) * spin) * axis);
    const Quaternion<T> about_axis = rotation_by<T>(T(rate * t) * axis);
    return {quaternion_product(rotation_by<T>(t * L_over_It), quaternion_product(initial.Q, about_axis)),
            rotate(about_axis, initial.omega, true)};
  }
};

/// A torque-free body with three different principal moments. Jacobi's functions solve Euler's equations, and
/// the elliptic integral of the third kind gives the attitude.
///
/// The principal axes are named so that L circulates about c, b has the middle moment, and a is the third
/// one. With s = lambda t + s0:
///   L_a = A cn s,  L_b = sigma B sn s,  L_c = tau C dn s             (signs from L' = L x omega)
///   lambda = |1/I_c - 1/I_b| B C / A,   k^2 = (B/C)^2 (1/I_b - 1/I_a) / (1/I_c - 1/I_a)
/// A^2, B^2 and C^2 are sums of squares with positive factors; only 1 - k^2 is a difference. The azimuth of
/// axis a about the constant L grows by
///   phi = L t / I_a + L (2T - L^2/I_a) / (C^2 lambda) [Pi(-A^2/C^2; am s | k) from s0 to s],
/// because L^2 - L_a^2 = C^2 (1 + (A/C)^2 sn^2), which does not vanish. Let M be the normalised triad (L x a,
/// L x (L x a), L) in the axes of B. Then R(t) = exp([L_W/L] phi) R0 M(0) M(t)^T.
/// Landau and Lifshitz, Mechanics, section 37; Whittaker (1937), section 69.
template <class T = Real>
class TriaxialBody {
 public:
  /// Principal moments along the axes of B [kg m^2]. Throws std::domain_error if two of them are equal, if L
  /// is along a principal axis, or if the motion is on the separatrix L^2 = 2 T I_b to the last digit of T.
  TriaxialBody(const Vec3<T>& moments, const AttitudeState<T>& initial);

  AttitudeState<T> at(const T& t) const;

  /// The period 4 K / lambda of omega [s]. L_b = 0 every 2 K / lambda, for k near 1 the middle of a flip
  /// (Dzhanibekov).
  T period() const;
  /// The n-th time > 0 at which L_b = 0, the middle of a flip between +b and -b [s]; n = 0, 1, ...
  T flip_time(int n) const;

 private:
  Vec3<T> momentum_at(const T& sn, const T& cn, const T& dn) const;
  Mat3<T> triad(const Vec3<T>& L) const;

  int a_, b_, c_;
  T A_, B_, C_;  ///< B_ and C_ with their signs
  T k_, lambda_, s0_, pi0_, drift_, factor_, L_;
  Vec3<T> moments_, L_W_unit_;
  Mat3<T> R0_M0_;
};

}  // namespace liecheck::oracles

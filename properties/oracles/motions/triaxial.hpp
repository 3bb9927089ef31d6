#pragma once
// A torque-free body with three different principal moments. Jacobi's functions solve Euler's equations, and
// the elliptic integral of the third kind gives the attitude.
//
// The principal axes are named so that L circulates about c, b has the middle moment, and a is the third one.
// With s = lambda t + s0:
//   L_a = A cn s,  L_b = sigma B sn s,  L_c = tau C dn s             (signs from L' = L x omega)
//   lambda = |1/I_c - 1/I_b| B C / A,   k^2 = (B/C)^2 (1/I_b - 1/I_a) / (1/I_c - 1/I_a)
// A^2, B^2 and C^2 are sums of squares with positive factors; only 1 - k^2 is a difference. The azimuth of
// axis a about the constant L grows by
//   phi = L t / I_a + L (2T - L^2/I_a) / (C^2 lambda) [Pi(-A^2/C^2; am s | k) from s0 to s],
// because L^2 - L_a^2 = C^2 (1 + (A/C)^2 sn^2), which does not vanish. Let M be the normalised triad (L x a,
// L x (L x a), L) in the axes of B. Then R(t) = exp([L_W/L] phi) R0 M(0) M(t)^T.
// Landau and Lifshitz, Mechanics, section 37; Whittaker (1937), section 69.

#include <oracles/motions/state.hpp>

namespace liecheck::oracles {

template <class T = Real>
class TriaxialBody {
 public:
  /// Principal moments along the axes of B [kg m^2]. Throws std::domain_error if two of them are equal, if L
  /// is along a principal axis, or if L^2 = 2 T I_b up to rounding (the separatrix).
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

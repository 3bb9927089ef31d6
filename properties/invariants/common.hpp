#pragma once
// Helpers that several invariants share.

#include <array>
#include <invariants/property.hpp>
#include <oracles/condition.hpp>
#include <oracles/error.hpp>
#include <oracles/jacobians.hpp>
#include <oracles/spatial_formulas.hpp>

namespace liecheck::properties {

using oracles::Real;

/// Calls `measured`, which records the error, if the computed value is finite and the oracle resolved the
/// exact value. Otherwise records the outcome for each output. A NaN is an error whatever the exact value is.
template <class M, class F>
void judged_value(Recorder& r, std::initializer_list<Output> outputs, std::size_t band, const M& computed,
                  bool resolved, F measured) {
  if (!oracles::all_finite(computed) || !resolved) {
    const bool finite = oracles::all_finite(computed);
    for (const Output& o : outputs) r.outcome(o, band, finite ? Outcome::unresolved : Outcome::not_finite);
    return;
  }
  measured();
}

/// |x| or ||v||. In ball arithmetic it is an upper bound of this norm.
template <class T>
double at_most(const T& x) {
  if constexpr (oracles::BallNumber<T>)
    return x.size() + x.r;
  else
    return std::fabs(static_cast<double>(x));
}
template <int N, class T>
double at_most(const oracles::Vec<N, T>& v) {
  if constexpr (oracles::BallNumber<T>) {
    const oracles::Length l = oracles::length(v);
    return l.value + l.radius;
  } else {
    return static_cast<double>(norm(v));
  }
}

/// The numbers of vectors and matrices of the oracles, one after another.
template <class V, class... W>
auto to_list(const V& v, const W&... others) {
  std::vector<typename decltype(v.x)::value_type> all(v.x.begin(), v.x.end());
  (all.insert(all.end(), others.x.begin(), others.x.end()), ...);
  return all;
}
template <int N, class T>
oracles::Vec<N, T> from_list(const std::vector<T>& x, std::size_t first = 0) {
  oracles::Vec<N, T> v;
  for (int i = 0; i < N; ++i) v[i] = x[first + static_cast<std::size_t>(i)];
  return v;
}

template <class T>
oracles::PoseOf<T> exact_pose(const Pose<double>& X) {
  return {oracles::exact_matrix<3, 3, T>(X.R), oracles::exact_vector<3, T>(X.p)};
}

/// Whether a computed and an exact value can be compared. If not, records not_finite or unresolved.
template <class M>
bool comparable(Recorder& r, const Output& output, const M& computed, bool resolved) {
  const bool finite = oracles::all_finite(computed);
  if (!finite || !resolved) r.outcome(output, 0, finite ? Outcome::unresolved : Outcome::not_finite);
  return finite && resolved;
}

/// Records the error of a vector. kappa is that of the results first ... first + N - 1 of `formula` at x().
/// `degree`: the formula is homogeneous of this degree in some of its numbers x_i. Then kappa >= degree, because
/// degree ||y|| = ||sum_i dy/dx_i x_i|| <= sum_i ||dy/dx_i|| |x_i| (Euler's theorem); 0.99 covers rounding.
template <int N, class T, class Formula, class Numbers>
void record_vector(Recorder& r, const Output& output, const Vec<double, N>& computed,
                   const oracles::Vec<N, T>& exact, bool resolved, const Formula& formula, const Numbers& x,
                   int degree, int first = 0) {
  if (!comparable(r, output, computed, resolved)) return;
  const auto kappa = [&] {
    const T size = oracles::larger(norm(exact), T(r.scalar().least_denominator()));
    return std::max(1.0,
                    oracles::condition_number(oracles::movements<T>(formula, x(), {{first, N}})[0], size));
  };
  const bool normal = at_most(exact) > 2 * r.scalar().least_denominator();
  r.record(output, 0, oracles::vector_error(r.scalar(), oracles::exact_vector<N, T>(computed), exact),
           Kappa(kappa, normal ? 0.99 * degree : 1));
}

/// Records the error of a sum of rotated vectors: kappa = terms / ||exact||, where `terms` is the sum of
/// their norms. A rotation mixes the numbers of a vector, so each vector is known to eps of its norm in any
/// direction, whatever the representation of the rotation: docs/measuring.md, section Models of rounding.
template <int N, class T>
void record_sum(Recorder& r, const Output& output, const Vec<double, N>& computed,
                const oracles::Vec<N, T>& exact, bool resolved, const T& terms) {
  if (!comparable(r, output, computed, resolved)) return;
  r.record(output, 0, oracles::vector_error(r.scalar(), oracles::exact_vector<N, T>(computed), exact), [&] {
    const T size = oracles::larger(norm(exact), T(r.scalar().least_denominator()));
    return std::max(1.0, oracles::condition_number(terms, size));
  });
}

/// The band of ||phi||. Below 2^-900, the ball of the norm is wider than one ulp. There 2^600 ||phi|| is
/// compared with 2^600 times the border of the band; 2^600 phi is exact.
template <class T>
std::size_t band_of_angle(const oracles::Scalar& scalar, const oracles::Vec3<T>& phi, const T& theta) {
  if constexpr (oracles::BallNumber<T>) {
    double largest = 0;
    for (const T& x : phi.x) largest = std::max(largest, x.size());
    if (largest > 0 && largest < 0x1p-900) {
      oracles::Vec3<T> scaled = phi;
      for (T& x : scaled.x) x = power_scaled(x, 600);
      const double edge = scalar.min * 0x1p600;
      return Bands::of(scalar).underflowing(norm(scaled) < T(edge));
    }
  }
  return Bands::of(scalar).classify(theta);
}
template <class T>
std::size_t band_of_angle(const oracles::Scalar& scalar, const oracles::Vec3<T>& phi) {
  return band_of_angle(scalar, phi, norm(phi));
}

/// Whether the three numbers that start at `first` are a direction: of length 1, |v|^2 up to 8 eps.
inline bool unit_direction_at(const oracles::Scalar& scalar, const std::vector<double>& input,
                              std::size_t first) {
  return abs(Real(squared_norm(oracles::exact_vector<3>(input.data() + first)) - 1)) <=
         Real(8 * scalar.epsilon);
}

/// What a correct form may err by [rad] since two quaternions or directions are not unit. 2 asin(|Q0 - Q1| / 2) of the stored numbers errs by
/// up to twice the difference of the norms, which is at most half of the sum of the defects ||Q|^2 - 1|. Of normalised
/// ones, each is rounded along itself by up to eps, in the norm and in the quotient, which counts twice in an angle. Equal
/// quaternions, and unit ones, which a division by the norm does not change, cost nothing.
template <int N>
Real cost_of_defects(const oracles::Scalar& scalar, const oracles::Vec<N>& a, const oracles::Vec<N>& b) {
  const Real defects = abs(Real(squared_norm(a) - 1)) + abs(Real(squared_norm(b) - 1));
  if (defects == 0 || a.x == b.x || a.x == oracles::Vec<N>(Real(-1) * b).x) return Real(0);
  return defects + 4 * Real(scalar.epsilon);
}
/// x, moved towards `to` by at most `by`.
inline Real nearer(const Real& x, const Real& to, const Real& by) {
  const Real apart = x - to;
  if (abs(apart) <= by) return to;
  return apart > 0 ? Real(x - by) : Real(x + by);
}

/// Two blocks of an operation.
using TwoOutputs = std::array<Output, 2>;
consteval TwoOutputs rotation_and_norm(const Operation& o) {
  return {o[block::rotation], o[block::norm_defect]};
}
consteval TwoOutputs rotation_and_defect(const Operation& o) {
  return {o[block::rotation], o[block::orthogonality_defect]};
}

/// The band of the angle of a stored quaternion, which need not be exact: a band only groups cases.
template <class T>
std::size_t band_of_rotation(const oracles::Scalar& scalar, const oracles::Quaternion<T>& Q) {
  double v = 0;
  const auto number = [](const T& x) {
    if constexpr (oracles::BallNumber<T>)
      return x.head();
    else
      return static_cast<double>(x);
  };
  for (int i = 0; i < 3; ++i) v = std::hypot(v, number(Q[i]));
  const double w = std::fabs(number(Q[3])), theta = 2 * std::atan2(v, w);
  return w == 0 ? Bands::of(scalar).at_pi() : Bands::of(scalar).classify(T(theta));
}

/// Records a rotation that was computed as a quaternion, and its norm.
template <class T>
void record_rotation(Recorder& r, const TwoOutputs& outputs, std::size_t band, const Vec<double, 4>& computed,
                     const oracles::Resolved<oracles::Quaternion<T>>& exact) {
  judged_value(r, {outputs[0], outputs[1]}, band, computed, exact.resolved, [&] {
    const auto Q = oracles::exact_vector<4, T>(computed);
    r.record(outputs[0], band, oracles::rotation_error(r.scalar(), Q, exact.value));
    r.record(outputs[1], band, oracles::norm_defect(r.scalar(), Q));
  });
}
/// Records a rotation that was computed as a matrix, and how far the matrix is from orthogonal.
template <class T>
void record_rotation(Recorder& r, const TwoOutputs& outputs, std::size_t band, const Mat<double, 3>& computed,
                     const oracles::Resolved<oracles::Quaternion<T>>& exact) {
  judged_value(r, {outputs[0], outputs[1]}, band, computed, exact.resolved, [&] {
    const auto errors =
        oracles::matrix_errors(r.scalar(), oracles::exact_matrix<3, 3, T>(computed), exact.value);
    r.record(outputs[0], band, errors.rotation);
    r.record(outputs[1], band, errors.defect);
  });
}

/// The band of a logarithm's angle.
template <class T>
std::size_t band_of_log(const oracles::Scalar& scalar, const oracles::LogValue<T>& log) {
  // A ball cannot distinguish such a theta from pi, and no other border of a band is that near to pi.
  if constexpr (oracles::BallNumber<T>)
    if (log.pi_minus_theta.head() + log.pi_minus_theta.r < 1e-25) return Bands::of(scalar).at_pi();
  return log.at_pi ? Bands::of(scalar).at_pi() : Bands::of(scalar).classify(log.theta);
}

/// The band of difference(q0, q1). If products of the vector parts v0 and v1 would underflow, v0 and v1 are
/// multiplied by 2^500 first. Then theta is nearly 2 ||w0 v1 - w1 v0 - v0 x v1|| / |w0 w1|. The radius is
/// widened by v0 x v1, which is not computed, and by the error of this formula.
template <class T>
std::size_t band_of_difference(const oracles::Scalar& scalar, const oracles::Vec<7, T>& q0,
                               const oracles::Vec<7, T>& q1, const oracles::LogValue<T>& log) {
  if constexpr (oracles::BallNumber<T>) {
    using namespace oracles;
    constexpr int shift = 500;
    double largest = 0, unlike = 0, opposed = 0;
    Vec3<T> v[2];
    for (int i = 0; i < 3; ++i) {
      const T &a = q0[3 + i], &b = q1[3 + i];
      largest = std::max({largest, a.size(), b.size()});
      unlike = std::max(unlike, std::fabs(a.head() - b.head()));
      opposed = std::max(opposed, std::fabs(a.head() + b.head()));
      v[0][i] = power_scaled(a, shift), v[1][i] = power_scaled(b, shift);
    }
    if (largest > 0 && largest < 0x1p-450) {
      Vec3<T> relative = q0[6] * v[1] - q1[6] * v[0];
      if (unlike > 0 && opposed > 0)  // otherwise v0 x v1 = 0
        for (T& x : relative.x) x.r += 2 * largest * std::ldexp(largest, shift);
      T scaled = T(2) * norm(relative) / abs(q0[6] * q1[6]);
      if (scaled.exactly_zero()) return Bands::of(scalar).classify(T(0));
      scaled.r += scaled.size() * 0x1p-800;  // bounds atan(x) - x and the omitted terms of w
      const double edge = std::ldexp(scalar.min, shift);
      if (scaled.size() < std::ldexp(1.0, shift - 900))
        return Bands::of(scalar).underflowing(scaled < T(edge));
    }
  }
  return band_of_log(scalar, log);
}

/// | |Q|^2 - 1 | in eps, for the quaternion Q that starts at `first`.
inline double norm_defect_at(const oracles::Scalar& scalar, const std::vector<double>& input,
                             std::size_t first) {
  oracles::Quaternion<> Q;
  for (int i = 0; i < 4; ++i) Q[i] = oracles::exact<Real>(input[first + static_cast<std::size_t>(i)]);
  return oracles::norm_defect(scalar, Q);
}

consteval TwoOutputs jacobian_outputs(const Operation& o) {
  return {o[block::jacobian], o[block::coupling]};
}
consteval TwoOutputs linear_angular(const Operation& o) {
  return {o[block::linear], o[block::angular]};
}

/// Records the errors of the 3 x 3 rotation and coupling blocks of a 6 x 6 Jacobian. The lower left block
/// must be zero. Both diagonal blocks have the same exact value. If `by_rho`, as beyond pi, the denominator of the coupling
/// block is at least rho min(1, ||J||).
template <class T>
void record_jacobian6(Recorder& r, const TwoOutputs& outputs, std::size_t band, const Mat<double, 6>& J,
                      const oracles::Jacobian6Value<T>& exact, const T& rho, bool by_rho,
                      Kappa kappa_rotation = nullptr, Kappa kappa_coupling = nullptr) {
  judged_value(r, {outputs[0], outputs[1]}, band, J, exact.resolved, [&] {
    const auto all = oracles::exact_matrix<6, 6, T>(J);
    double error = std::max(oracles::vector_error(r.scalar(), oracles::block(all, 0, 0), exact.J),
                            oracles::vector_error(r.scalar(), oracles::block(all, 1, 1), exact.J));
    if (!J.block<3, 3>(3, 0).isZero(0)) error = std::numeric_limits<double>::infinity();
    r.record(outputs[0], band, error, kappa_rotation);
    T scale(0);
    if (by_rho) {
      const T size = oracles::norm(exact.J);
      scale = rho * oracles::smaller(size, T(1));
    }
    r.record(outputs[1], band, oracles::vector_error(r.scalar(), oracles::block(all, 0, 1), exact.C, scale),
             kappa_coupling);
  });
}

}  // namespace liecheck::properties

#include <oracles/motions/elliptic.hpp>
#include <oracles/motions/torque_free.hpp>

#include <stdexcept>
#include <utility>

namespace liecheck::oracles {

template <class T>
TriaxialBody<T>::TriaxialBody(const Vec3<T>& moments, const AttitudeState<T>& initial) : moments_(moments) {
  int low = 0, high = 2, middle = 1;
  if (moments[low] > moments[middle]) std::swap(low, middle);
  if (moments[middle] > moments[high]) std::swap(middle, high);
  if (moments[low] > moments[middle]) std::swap(low, middle);
  if (moments[low] == moments[middle] || moments[middle] == moments[high])
    throw std::domain_error("TriaxialBody: two principal moments are equal");
  const auto gap = [&](int i, int j) -> T { return 1 / moments[i] - 1 / moments[j]; };
  Vec3<T> L;
  for (int i = 0; i < 3; ++i) L[i] = moments[i] * initial.omega[i];
  // L^2/I_b - 2T has two terms of opposite sign; c is the axis of the larger one.
  const T of_low = L[low] * L[low] * gap(low, middle), of_high = L[high] * L[high] * gap(middle, high);
  const bool about_high = of_high > of_low;
  a_ = about_high ? low : high, b_ = middle, c_ = about_high ? high : low;
  const T La2 = L[a_] * L[a_], Lb2 = L[b_] * L[b_], Lc2 = L[c_] * L[c_];
  const T A2 = La2 + Lb2 * (gap(b_, c_) / gap(a_, c_)), B2 = Lb2 + La2 * (gap(a_, c_) / gap(b_, c_));
  const T C2 = Lc2 + Lb2 * (gap(b_, a_) / gap(c_, a_));
  if (A2 == 0 || of_high == of_low)
    throw std::domain_error("TriaxialBody: a spin about a principal axis, or the separatrix");
  const bool cyclic = (a_ + 1) % 3 == b_;
  const T rise = cyclic ? gap(c_, b_) : gap(b_, c_);  // L_a' = rise L_b L_c
  const int tau = L[c_] < 0 ? -1 : 1, sigma = (rise > 0 ? -1 : 1) * tau;
  A_ = sqrt(A2), B_ = sigma * sqrt(B2), C_ = tau * sqrt(C2);
  lambda_ = abs(T(rise * B_ * C_ / A_));
  k_ = sqrt(T(B2 / C2 * (gap(b_, a_) / gap(c_, a_))));
  s0_ = first_kind<T>(atan2(T(L[b_] / B_), T(L[a_] / A_)), k_);
  factor_ = -A2 / C2;
  pi0_ = third_kind<T>(factor_, jacobi<T>(s0_, k_).am, k_);
  L_ = norm(L);
  drift_ = L_ * (Lb2 * gap(b_, a_) + Lc2 * gap(c_, a_)) / (C2 * lambda_);
  L_W_unit_ = rotate(initial.Q, T(1 / L_) * L);
  R0_M0_ = rotation_matrix(normalized(initial.Q)) * triad(L);
}

template <class T>
Vec3<T> TriaxialBody<T>::momentum_at(const T& sn, const T& cn, const T& dn) const {
  Vec3<T> L;
  L[a_] = A_ * cn, L[b_] = B_ * sn, L[c_] = C_ * dn;
  return L;
}

template <class T>
Mat3<T> TriaxialBody<T>::triad(const Vec3<T>& L) const {
  Vec3<T> a = zero_vector<3, T>();
  a[a_] = 1;
  const Vec3<T> third = T(1 / norm(L)) * L, across = cross(third, a);
  const Vec3<T> first = T(1 / norm(across)) * across, second = cross(third, first);
  Mat3<T> M;
  for (int i = 0; i < 3; ++i) M(i, 0) = first[i], M(i, 1) = second[i], M(i, 2) = third[i];
  return M;
}

template <class T>
AttitudeState<T> TriaxialBody<T>::at(const T& t) const {
  const Jacobi<T> e = jacobi<T>(lambda_ * t + s0_, k_);
  const Vec3<T> L = momentum_at(e.sn, e.cn, e.dn);
  const T phi = L_ * t / moments_[a_] + drift_ * (third_kind<T>(factor_, e.am, k_) - pi0_);
  const Mat3<T> R = R0_M0_ * transpose(triad(L));
  AttitudeState<T> state;
  state.Q = quaternion_product(rotation_by<T>(phi * L_W_unit_), quaternion_of(R));
  for (int i = 0; i < 3; ++i) state.omega[i] = L[i] / moments_[i];
  return state;
}

template <class T>
T TriaxialBody<T>::period() const {
  return 4 * first_kind<T>(acos(T(0)), k_) / lambda_;
}

template <class T>
T TriaxialBody<T>::flip_time(int n) const {
  const T two_K = period() * lambda_ / 2;  // sn vanishes at its multiples
  const T first = floor(T(s0_ / two_K)) + 1;
  return ((first + n) * two_K - s0_) / lambda_;
}

template class TriaxialBody<Real>;
template class TriaxialBody<Real100>;

}  // namespace liecheck::oracles

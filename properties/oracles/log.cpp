#include <oracles/log.hpp>

#include <oracles/closed_forms.hpp>

namespace liecheck::oracles {
namespace {

/// The second formula. With the dual number S = 1 + w + e d_w, sqrt(q) = (q + 1) / sqrt(2 S). After k roots
/// the vector part v + e d is small. The root's log is f(v.v) v, with f(x) = asin(sqrt x) / sqrt x =
/// sum_j a_j x^j. Every step adds only a few roundings to the relative errors of v and of d.
template <class T>
Vec6<T> log_by_square_roots(Quaternion<T> Q, const Vec3<T>& p) {
  Q = normalized(Q);
  if (Q[3] < 0) Q = -Q;
  Vec3<T> v = head3(Q);
  T w = Q[3];
  Vec3<T> d = cross(p, v);  // (p, 0)(v, w) / 2 = (w p + p x v, -p.v) / 2
  for (int i = 0; i < 3; ++i) d[i] = (d[i] + w * p[i]) / 2;
  T d_w = -dot(p, v) / 2;

  constexpr int roots = 10;  // ||v|| <= sin(pi / 2^11): x < 2^-18
  for (int k = 0; k < roots; ++k) {
    const T S = 1 + w;
    const T scale = 1 / sqrt(2 * S);
    const T half_ratio = d_w / (2 * S);
    for (int i = 0; i < 3; ++i) d[i] = (d[i] - half_ratio * v[i]) * scale;
    v = scale * v;
    w = S * scale;
    d_w = d_w * scale / 2;
  }

  constexpr int terms = bits < T >> 200 ? 20 : 10;
  static const std::array<T, 20> a = [] {  // a_j = (2j)! / (4^j (j!)^2 (2j+1))
    std::array<T, 20> c;
    T central(1);
    for (int j = 0; j < 20; ++j) {
      c[static_cast<std::size_t>(j)] = central / (2 * j + 1);
      central = central * (2 * j + 1) / (2 * j + 2);
    }
    return c;
  }();
  const T x = squared_norm(v);
  T f(0), df(0);
  for (int j = terms - 1; j >= 0; --j) {
    df = df * x + f;
    f = f * x + a[static_cast<std::size_t>(j)];
  }
  const T back = ldexp(T(1), roots + 1);
  const T along = 2 * df * dot(v, d);
  return stack(back * (f * d + along * v), T(back * f) * v);
}

/// The unit quaternion, w >= 0, of a rotation matrix by its largest pivot (Shepperd 1978). The relative
/// accuracy of its vector part is that of the antisymmetric part of R.
template <class T>
Quaternion<T> quaternion_of(const Mat3<T>& R) {
  const T trace = R(0, 0) + R(1, 1) + R(2, 2);
  int pivot = 3;
  T largest = trace;
  for (int i = 0; i < 3; ++i)
    if (R(i, i) > largest) {
      largest = R(i, i);
      pivot = i;
    }
  Quaternion<T> q;
  if (pivot == 3) {
    q[3] = sqrt(1 + trace) / 2;
    const Vec3<T> k = vee(R);
    for (int i = 0; i < 3; ++i) q[i] = k[i] / (2 * q[3]);
  } else {
    const int i = pivot, j = (i + 1) % 3, k = (i + 2) % 3;
    q[i] = sqrt(1 + R(i, i) - R(j, j) - R(k, k)) / 2;
    q[j] = (R(i, j) + R(j, i)) / (4 * q[i]);
    q[k] = (R(i, k) + R(k, i)) / (4 * q[i]);
    q[3] = (R(k, j) - R(j, k)) / (4 * q[i]);
  }
  return q[3] < 0 ? -q : q;
}

}  // namespace

LogResult log_of(const Quaternion<Real100>& Q, const Vec3<Real100>& p) {
  using T = Real100;
  const Vec6<T> value = closed_log(Q, p);
  const Vec3<T> v = head3(Q), phi = tail3(value);
  const T w = abs(Q[3]), s = norm(v);
  LogResult r;
  r.rho = cast<Real>(head3(value));
  r.phi = cast<Real>(phi);
  r.theta = Real(norm(phi));
  r.pi_minus_theta = Real(T(2 * atan2(w, s)));
  r.at_pi = w < T(1e-60) * s;
  r.other = r.at_pi ? cast<Real>(closed_log(Q[3] < 0 ? Q : -Q, p, true)) : r.value();
  r.resolved = confirmed(true, [&]<class S>(S) {
    const Vec6<S> a = log_by_square_roots(cast<S>(Q), cast<S>(p)), b = cast<S>(value);
    return agree(tail3(a), tail3(b)) && agree(head3(a), head3(b));
  });
  return r;
}

NearestQuaternion nearest_quaternion(const Mat3<Real100>& R) {
  using T = Real100;
  static const T half = T(1) / 2, converged = pow(T(10), -55);
  Mat3<T> X = R;
  bool last = false;
  for (int i = 0; i < 30; ++i) {  // quadratic convergence: five steps from 1e-3, four from 1e-8
    const Mat3<T> C = cofactors(X);
    const T by_det = 1 / determinant(X, C);
    const Mat3<T> next = half * (X + by_det * C);
    const T step = norm(next - X);
    X = next;
    if (last) break;
    last = step < converged;
  }
  const Quaternion<T> Q = quaternion_of(X);
  // X is the polar factor if it is orthogonal (Q is unit and X is its matrix) and X^T R is symmetric and
  // positive. X^T R is positive because R is near a rotation.
  const Mat3<T> B = transpose(X) * R;
  const T sine = norm(head3(Q));
  const T asymmetry = norm(vee(B));
  const T defect = norm(transpose(R) * R - identity<3, T>());
  const bool near = defect < half && determinant(R, cofactors(R)) > 0;
  return {Q, last && near && asymmetry <= T(agreement) * sine && abs(squared_norm(Q) - 1) <= T(agreement) &&
                 agree(rotation_matrix(Q), X)};
}

LogResult log_se3(const Quaternion<>& Q, const Vec3<>& p) {
  return log_of(cast<Real100>(Q), cast<Real100>(p));
}

LogResult log_so3(const Quaternion<>& Q) {
  return log_of(cast<Real100>(Q), zero_vector<3, Real100>());
}

LogResult log_se3_matrix(const Mat3<>& R, const Vec3<>& p) {
  const NearestQuaternion nearest = nearest_quaternion(cast<Real100>(R));
  LogResult r = log_of(nearest.Q, cast<Real100>(p));
  r.resolved = r.resolved && nearest.resolved;
  return r;
}

}  // namespace liecheck::oracles

#include <oracles/representations.hpp>

#include <oracles/exp.hpp>

namespace liecheck::oracles {
namespace {

using Wide = Real100;
using M3 = Mat3<Wide>;

/// (I + X)(I - X)^-1.
M3 cayley(const M3& X) {
  const M3 one = identity<3, Wide>();
  return (one + X) * inverse<Wide>(one - X);
}
Resolved<Quaternion<>> confirmed_by(const M3& R, const Quaternion<Wide>& Q) {
  return {cast<Real>(Q), agree(R, rotation_matrix(Q))};
}

}  // namespace

Resolved<Quaternion<>> quaternion_from_matrix(const Mat3<>& R) {
  const NearestQuaternion nearest = nearest_quaternion(cast<Wide>(R));
  return {cast<Real>(nearest.Q), nearest.resolved};
}

Resolved<Quaternion<>> unit_product(const Quaternion<>& Q0, const Quaternion<>& Q1) {
  const Quaternion<Wide> a = normalized(cast<Wide>(Q0)), b = normalized(cast<Wide>(Q1));
  return confirmed_by(rotation_matrix(a) * rotation_matrix(b), quaternion_product(a, b));
}

Resolved<Vec3<>> gibbs(const Quaternion<>& Q) {
  const Quaternion<Wide> q = normalized(cast<Wide>(Q));
  if (q[3] == 0) return {zero_vector<3, Real>(), false};
  const Vec3<Wide> g = representation_formulas::divided(head3(q), q[3]);
  const M3 E = rotation_minus_identity(q);
  const Vec3<Wide> second = vee(M3(E * inverse<Wide>(Wide(2) * identity<3, Wide>() + E)));
  return {cast<Real>(g), agree(second, g)};
}

Resolved<Quaternion<>> from_gibbs(const Vec3<>& g) {
  const Vec3<Wide> x = cast<Wide>(g);
  return confirmed_by(cayley(hat(x)), normalized(Quaternion<Wide>{{x[0], x[1], x[2], Wide(1)}}));
}

Resolved<Vec3<>> modified_rodrigues(const Quaternion<>& Q) {
  const Vec3<> s = cast<Real>(representation_formulas::modified_rodrigues(cast<Wide>(Q)));
  const LogResult log = log_so3(Q);
  if (log.theta == 0) return {s, log.resolved};
  const Vec3<> second = Real(tan(Real(log.theta / 4)) / log.theta) * log.phi;
  return {s, log.resolved && (agree(second, s) || (log.at_pi && agree(Vec3<>(-second), s)))};
}

Resolved<Quaternion<>> from_modified_rodrigues(const Vec3<>& s) {
  const Quaternion<> Q = cast<Real>(representation_formulas::from_modified_rodrigues(cast<Wide>(s)));
  const Real n = norm(s);
  if (n == 0) return {Q, true};
  const ExpResult e = exp_so3(Real(4 * atan(n) / n) * s);
  return {Q, e.resolved && (agree(e.Q, Q) || agree(Quaternion<>(-e.Q), Q))};
}

Resolved<Quaternion<>> gram_schmidt(const Mat3<>& A) {
  const M3 a = cast<Wide>(A), G = transpose(a) * a;
  const auto column = [&](int j) { return Vec3<Wide>{{a(0, j), a(1, j), a(2, j)}}; };
  const auto unit = [](const Vec3<Wide>& v) { return Wide(1 / norm(v)) * v; };
  const Vec3<Wide> x = unit(column(0)), y = unit(column(1) - dot(x, column(1)) * x), z = cross(x, y);
  M3 R, L = zeros<3, 3, Wide>();
  for (int i = 0; i < 3; ++i) R(i, 0) = x[i], R(i, 1) = y[i], R(i, 2) = z[i];
  for (int j = 0; j < 3; ++j)
    for (int i = j; i < 3; ++i) {
      Wide sum = G(i, j);
      for (int k = 0; k < j; ++k) sum -= L(i, k) * L(j, k);
      L(i, j) = i == j ? Wide(sqrt(sum)) : Wide(sum / L(j, j));
    }
  const NearestQuaternion nearest = nearest_quaternion(R);
  const Resolved<Quaternion<>> result = confirmed_by(M3(a * inverse<Wide>(transpose(L))), nearest.Q);
  return {result.value, result.resolved && nearest.resolved};
}

}  // namespace liecheck::oracles

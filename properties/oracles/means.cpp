#include <oracles/means.hpp>

#include <cmath>
#include <numbers>
#include <oracles/closed_forms.hpp>
#include <oracles/exp.hpp>
#include <oracles/zeta.hpp>

namespace liecheck::oracles {
namespace {

using Wide = Real100;
using M4 = Mat<4, 4, Wide>;

/// sum_i w_i Q_i Q_i^T / sum_i w_i of unit quaternions.
M4 second_moment(const std::vector<Quaternion<>>& all, const std::vector<Real>& weights) {
  M4 M = zeros<4, 4, Wide>();
  Wide sum(0);
  for (std::size_t n = 0; n < all.size(); ++n) {
    const Quaternion<Wide> q = normalized(cast<Wide>(all[n]));
    sum += Wide(weights[n]);
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) M(i, j) += Wide(weights[n]) * q[i] * q[j];
  }
  return Wide(1 / sum) * M;
}

/// Jacobi's rotations: D becomes diagonal, the columns of V are the eigenvectors.
void diagonalise(M4& D, M4& V) {
  V = identity<4, Wide>();
  for (int sweep = 0; sweep < 40; ++sweep) {
    Wide off(0);
    for (int p = 0; p < 4; ++p)
      for (int q = p + 1; q < 4; ++q) {
        if (D(p, q) == 0) continue;
        off += abs(D(p, q));
        const Wide h = (D(q, q) - D(p, p)) / (2 * D(p, q)), root = sqrt(1 + h * h),
                   t = h < 0 ? Wide(1 / (h - root)) : Wide(1 / (h + root)), c = 1 / sqrt(1 + t * t),
                   s = t * c;
        const auto turn = [&](Wide& x, Wide& y) {
          const Wide old = x;
          x = c * old - s * y, y = s * old + c * y;
        };
        for (int i = 0; i < 4; ++i) turn(D(i, p), D(i, q));
        for (int i = 0; i < 4; ++i) turn(D(p, i), D(q, i));
        for (int i = 0; i < 4; ++i) turn(V(i, p), V(i, q));
      }
    if (off < Wide(1e-90)) return;
  }
}
/// Whether a symmetric matrix has no negative pivot.
bool is_positive(M4 A) {
  for (int k = 0; k < 4; ++k) {
    if (A(k, k) < 0) return false;
    for (int i = k + 1; i < 4 && A(k, k) > 0; ++i)
      for (int j = k + 1; j < 4; ++j) A(i, j) -= A(i, k) * A(k, j) / A(k, k);
  }
  return true;
}

using Matrix6 = std::array<std::array<double, 6>, 6>;

/// H += w J_l(xi)^-1, by its series sum_k B_k ad^k / k! in ad = [[[phi], [rho]], [0, [phi]]], for |phi| <= 2.
void add_inverse_jacobian(Matrix6& H, const Vec6<>& xi, double w) {
  const auto product = [](const Matrix6& a, const Matrix6& b) {
    Matrix6 c{};
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t k = 0; k < 6; ++k)
        for (std::size_t j = 0; j < 6; ++j) c[i][j] += a[i][k] * b[k][j];
    return c;
  };
  Matrix6 ad{}, power{};
  for (int half = 0; half < 2; ++half) {
    const Mat3<> m = hat(half ? head3(xi) : tail3(xi));
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const auto r = static_cast<std::size_t>(i), c = static_cast<std::size_t>(j);
        if (half)
          ad[r][3 + c] = static_cast<double>(m(i, j));
        else
          ad[r][c] = ad[3 + r][3 + c] = static_cast<double>(m(i, j));
      }
  }
  for (std::size_t i = 0; i < 6; ++i) power[i][i] = 1;
  // B_2k / (2k)! = 2 (-1)^(k + 1) zeta(2k) / (2 pi)^2k.
  static const std::array<double, 32> bernoulli = [] {
    std::array<double, 32> c{1, -.5};
    for (std::size_t k = 2; k < 32; k += 2)
      c[k] = (k % 4 ? 2 : -2) * zeta(double(k)) / std::pow(2 * std::numbers::pi, double(k));
    return c;
  }();
  for (std::size_t k = 0; k < 32; ++k) {
    if (k < 2 || k % 2 == 0)
      for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j) H[i][j] += w * bernoulli[k] * power[i][j];
    power = product(power, ad);
  }
}
/// H^-1 b by elimination; H is near the identity.
Vec6<> solved(Matrix6 H, const Vec6<>& b) {
  Vec6<> x = b;
  for (std::size_t k = 0; k < 6; ++k)
    for (std::size_t i = 0; i < 6; ++i) {
      if (i == k) continue;
      const double l = H[i][k] / H[k][k];
      for (std::size_t j = k; j < 6; ++j) H[i][j] -= l * H[k][j];
      x[static_cast<int>(i)] -= Real(l) * x[static_cast<int>(k)];
    }
  for (std::size_t k = 0; k < 6; ++k) x[static_cast<int>(k)] /= Real(H[k][k]);
  return x;
}

Vec7<> pose_numbers(const Quaternion<Wide>& Q, const Vec3<Wide>& p) {
  const Quaternion<> q = cast<Real>(Q);
  return {{Real(p[0]), Real(p[1]), Real(p[2]), q[0], q[1], q[2], q[3]}};
}

}  // namespace

MeanRotation chordal_mean(const std::vector<Quaternion<>>& all, const std::vector<Real>& weights) {
  const M4 M = second_moment(all, weights);
  M4 D = M, V;
  diagonalise(D, V);
  int first = 0;
  for (int i = 1; i < 4; ++i)
    if (D(i, i) > D(first, first)) first = i;
  Wide next(-1);
  for (int i = 0; i < 4; ++i)
    if (i != first && D(i, i) > next) next = D(i, i);
  const Wide largest = D(first, first);
  const Quaternion<Wide> Q =
      normalized(Quaternion<Wide>{{V(0, first), V(1, first), V(2, first), V(3, first)}});
  const Vec<4, Wide> residual = M * Q - largest * Q;
  return {cast<Real>(Q), Real(Wide((largest - next) / largest)),
          norm(residual) < Wide(agreement * 1e-10) &&
              is_positive(Wide(largest * (1 + Wide(1e-60))) * identity<4, Wide>() - M)};
}

MeanPose geodesic_mean(const std::vector<Vec7<>>& all, const std::vector<Real>& weights,
                       const Quaternion<>& start) {
  Real sum(0), size(0);
  for (std::size_t i = 0; i < all.size(); ++i) {
    sum += weights[i];
    size = larger(size, Real(norm(head3(all[i]))));
  }
  Quaternion<Wide> Q = normalized(cast<Wide>(start));
  Vec3<Wide> p = cast<Wide>(head3(all[0]));
  const auto at = [&](std::size_t i) {
    return std::pair{conjugate_product(Q, normalized(cast<Wide>(quaternion_of(all[i])))),
                     Vec3<Wide>(transpose(rotation_matrix(Q)) * (cast<Wide>(head3(all[i])) - p))};
  };
  for (int step = 0; step < 60; ++step) {
    Vec6<> mean = zero_vector<6, Real>();
    Matrix6 H{};
    for (std::size_t i = 0; i < all.size(); ++i) {
      const auto [turn, lever] = at(i);
      const Vec6<> log = cast<Real>(closed_log(turn, lever));
      mean = mean + Real(weights[i] / sum) * log;
      add_inverse_jacobian(H, log, static_cast<double>(Real(weights[i] / sum)));
    }
    if (norm(tail3(mean)) < Real(1e-43) && norm(head3(mean)) <= Real(1e-43) * size) {
      bool resolved = true;
      for (std::size_t i = 0; i < all.size(); ++i) {
        const auto [turn, lever] = at(i);
        resolved = resolved && log_of(turn, lever).resolved;
      }
      return {cast<Real>(Q), cast<Real>(p), resolved};
    }
    const UnitPose<Wide> e = closed_exp(cast<Wide>(solved(H, mean)));
    p = p + rotation_matrix(Q) * e.p;
    Q = normalized(quaternion_product(Q, e.Q));
  }
  return {cast<Real>(Q), cast<Real>(p), false};
}

Interpolated interpolate(const Vec7<>& q0, const Vec7<>& q1, const Real& t) {
  const Quaternion<Wide> Q0 = normalized(cast<Wide>(quaternion_of(q0))),
                         Q1 = normalized(cast<Wide>(quaternion_of(q1)));
  const Vec3<Wide> p0 = cast<Wide>(head3(q0)),
                   p = transpose(rotation_matrix(Q0)) * (cast<Wide>(head3(q1)) - p0);
  const LogResult log = log_of(conjugate_product(Q0, Q1), p);
  const auto at = [&](const Vec6<>& xi) {
    IntegrateResult r = integrate(pose_numbers(Q0, p0), t * xi);
    return r;
  };
  Interpolated r;
  r.pi_minus_theta = log.pi_minus_theta;
  r.pose = at(log.value());
  r.resolved = log.resolved && r.pose.resolved;
  // exp of the opposite axis by 2 pi - theta is the same pose.
  r.other = r.pose;
  if (log.at_pi) {
    r.other = at(log.other);
  } else if (log.pi_minus_theta < Real(1) / 1000) {
    const Vec3<> phi = Real(-(log.theta + 2 * log.pi_minus_theta) / log.theta) * log.phi;
    // V(phi) rho = p: V^-1 = V^T + ..., solved by its matrix V = I + (1 - cos)/theta^2 [phi] + ...
    const Real theta = norm(phi), square = theta * theta;
    const Mat3<> K = hat(phi), V = identity<3, Real>() + Real((1 - cos(theta)) / square) * K +
                                   Real((theta - sin(theta)) / (square * theta)) * (K * K);
    r.other = at(stack(inverse(V) * cast<Real>(p), phi));
  }
  return r;
}

Between angle_between(const Vec3<>& a, const Vec3<>& b) {
  const auto unit = [](const Vec3<>& v) {
    const Vec3<Wide> x = cast<Wide>(v);
    return Vec3<Wide>(Wide(1 / norm(x)) * x);
  };
  const Vec3<Wide> x = unit(a), y = unit(b);
  Vec3<Wide> terms;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    terms[i] = abs(x[j] * y[k]) + abs(x[k] * y[j]);
  }
  const Wide theta = 2 * atan2(norm(x - y), norm(x + y)), second = atan2(norm(cross(x, y)), dot(x, y));
  return {Real(theta), Real(norm(terms)), Real(Wide(2 * atan2(norm(x + y), norm(x - y)))),
          agree(second, theta, agreement, Wide(1e-40))};
}

Resolved<Vec3<>> slerp_directions(const Vec3<>& a, const Vec3<>& b, const Real& t) {
  const Vec3<Wide> x = Wide(1 / norm(cast<Wide>(a))) * cast<Wide>(a),
                   y = Wide(1 / norm(cast<Wide>(b))) * cast<Wide>(b), n = cross(x, y);
  const Wide sine = norm(n), theta = atan2(sine, dot(x, y)), at(t);
  if (sine < Wide(1e-60)) return {cast<Real>(x), dot(x, y) > 0};
  const Vec3<Wide> value =
      Wide(sin(Wide((1 - at) * theta)) / sine) * x + Wide(sin(Wide(at * theta)) / sine) * y;
  const ExpResult turn = exp_so3(cast<Real>(Vec3<Wide>(Wide(at * theta / sine) * n)));
  const Vec3<> exact = cast<Real>(value);
  return {exact, turn.resolved && agree(turn.R * cast<Real>(x), exact)};
}

}  // namespace liecheck::oracles

// The exact results of representations, transforms, means and inertial navigation.

#include <conventions/formulas.hpp>
#include <oracles/means.hpp>
#include <oracles/navigation.hpp>
#include <oracles/normalisation.hpp>
#include <oracles/representations.hpp>

namespace liecheck::properties::conventions {

using namespace formula_detail;

namespace {

/// Axis and angle, the angle in [0, pi]. The axis of the identity is x.
oracles::Vec<4, Real> pair_of(const LogResult& log) {
  if (log.theta == 0) return {{Real(1), Real(0), Real(0), Real(0)}};
  const Vec3<> n = Real(1 / log.theta) * log.phi;
  return {{n[0], n[1], n[2], log.theta}};
}
}  // namespace

Formulas<Real> representations() {
  using V3 = Vec3<>;
  using V4 = Quaternion<>;
  using M3 = Mat3<>;
  const auto turn = [](const V3& axis, const Real& angle) {
    return exp_so3(Real(angle / norm(axis)) * axis).Q;
  };
  const auto matrix_of = [](const Resolved<V4>& Q) { return rotation_matrix(Q.value); };
  return {
      {"quaternion_from_matrix", of<Real, M3>([](const M3& R) { return quaternion_from_matrix(R); })},
      {"matrix_from_quaternion", of<Real, V4>([](const V4& Q) { return matrix_from_quaternion(Q); })},
      {"quaternion_product", of<Real, V4, V4>([](const V4& a, const V4& b) { return unit_product(a, b); })},
      {"quaternion_inverse", of<Real, V4>([](const V4& Q) {
         const V4 unit = normalized(Q);
         return V4{{Real(-unit[0]), Real(-unit[1]), Real(-unit[2]), unit[3]}};
       })},
      {"axis_angle_from_quaternion", of<Real, V4>([](const V4& Q) { return pair_of(log_so3(Q)); })},
      {"axis_angle_from_matrix",
       of<Real, M3>([](const M3& R) { return pair_of(log_se3_matrix(R, zero_vector<3, Real>())); })},
      {"quaternion_from_axis_angle", of<Real, V3, Real>(turn)},
      {"matrix_from_axis_angle", of<Real, V3, Real>([turn](const V3& axis, const Real& angle) {
         return rotation_matrix(turn(axis, angle));
       })},
      {"gibbs_from_quaternion", of<Real, V4>([](const V4& Q) { return gibbs(Q); })},
      {"quaternion_from_gibbs", of<Real, V3>([](const V3& g) { return from_gibbs(g); })},
      {"mrp_from_quaternion", of<Real, V4>([](const V4& Q) { return modified_rodrigues(Q); })},
      {"quaternion_from_mrp", of<Real, V3>([](const V3& s) { return from_modified_rodrigues(s); })},
      {"nearest_rotation",
       of<Real, M3>([matrix_of](const M3& A) { return matrix_of(quaternion_from_matrix(A)); })},
      {"gram_schmidt",
       of<Real, M3>([matrix_of](const M3& A) { return matrix_of(oracles::gram_schmidt(A)); })}};
}
Formulas<Real> transforms() {
  using V3 = Vec3<>;
  using V4 = Quaternion<>;
  using V6 = Vec6<>;
  using V7 = Vec7<>;
  using P = oracles::Pose;
  const auto Ad = [](const P& X) { return assemble(X.R, hat(X.p) * X.R, zeros<3, 3, Real>(), X.R); };
  const auto mean = [](const std::vector<V7>& poses, const V3& w) {
    const std::vector<Real> weights{w[0], w[1], w[2]};
    std::vector<V4> rotations;
    for (const V7& pose : poses) rotations.push_back(oracles::quaternion_of(pose));
    const MeanPose m = oracles::geodesic_mean(poses, weights, oracles::chordal_mean(rotations, weights).Q);
    return std::pair(m.p, m.Q);
  };
  const auto turned = [](const V4& Q) { return V7{{Real(0), Real(0), Real(0), Q[0], Q[1], Q[2], Q[3]}}; };
  return {{"adjoint", of<Real, P>(Ad)},
          {"coadjoint",
           of<Real, P>([](const P& X) { return assemble(X.R, zeros<3, 3, Real>(), hat(X.p) * X.R, X.R); })},
          {"small_adjoint", of<Real, V6>([](const V6& V) {
             return assemble(hat(tail3(V)), hat(head3(V)), zeros<3, 3, Real>(), hat(tail3(V)));
           })},
          {"transport_covariance", of<Real, P, Mat6<>>([Ad](const P& X, const Mat6<>& Sigma) {
             return Ad(X) * Sigma * transpose(Ad(X));
           })},
          {"screw_parameters", of<Real, V6>([](const V6& V) {
             const V3 u = head3(V), w = tail3(V);
             const Real n = norm(w);
             return std::pair(std::pair(Real(1 / n) * w, Real(dot(u, w) / (n * n))),
                              Real(1 / (n * n)) * cross(w, u));
           })},
          {"mean_rotation", of<Real, V4, V4, V4, V3>([](const V4& a, const V4& b, const V4& c, const V3& w) {
             return chordal_mean({a, b, c}, {w[0], w[1], w[2]}).Q;
           })},
          {"geodesic_mean", of<Real, V4, V4, V4, V3>([=](const V4& a, const V4& b, const V4& c, const V3& w) {
             return mean({turned(a), turned(b), turned(c)}, w).second;
           })},
          {"mean_pose", of<Real, V7, V7, V7, V3>([mean](const V7& a, const V7& b, const V7& c, const V3& w) {
             return mean({a, b, c}, w);
           })},
          {"interpolate", of<Real, V7, V7, Real>([](const V7& a, const V7& b, const Real& t) {
             const auto pose = oracles::interpolate(a, b, t).pose;
             return std::pair(pose.p, pose.Q);
           })},
          {"angle_between",
           of<Real, V3, V3>([](const V3& a, const V3& b) { return oracles::angle_between(a, b).theta; })},
          {"slerp_directions", of<Real, V3, V3, Real>([](const V3& a, const V3& b, const Real& t) {
             return oracles::slerp_directions(a, b, t);
           })}};
}

namespace {

/// [[J, 0, A], [0, J, B], [0, 0, J]].
oracles::Mat<9, 9, Real> three_by_three(const Mat3<>& J, const Mat3<>& A, const Mat3<>& B) {
  auto m = zeros<9, 9, Real>();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      for (int b = 0; b < 9; b += 3) m(b + i, b + j) = J(i, j);
      m(i, 6 + j) = A(i, j), m(3 + i, 6 + j) = B(i, j);
    }
  return m;
}
}  // namespace

Formulas<Real> navigation() {
  using V3 = Vec3<>;
  using V9 = oracles::Vec<9, Real>;
  using M3 = Mat3<>;
  const auto jacobian = [](auto of_pose) {
    return of<Real, V3, V3, V3>([of_pose](const V3& rho, const V3& nu, const V3& phi) {
      const auto x = of_pose(stack(rho, phi)), y = of_pose(stack(nu, phi));
      return three_by_three(x.J, x.C, y.C);
    });
  };
  const auto samples = [](const V9& x) {
    return Samples{V3{{x[0], x[1], x[2]}}, V3{{x[3], x[4], x[5]}}, V3{{x[6], x[7], x[8]}}};
  };
  const auto increment = [samples](bool exact) {
    return of<Real, V9, V9, Real>([samples, exact](const V9& w, const V9& a, const Real& dt) {
      const auto x = preintegrated(samples(w), samples(a), dt, exact);
      return std::pair(std::pair(x.R, x.p), x.v);
    });
  };
  const auto biases = [samples](bool exact) {
    return of<Real, V9, V9, Real>([samples, exact](const V9& w, const V9& a, const Real& dt) {
      const auto x = preintegrated(samples(w), samples(a), dt, exact);
      return std::pair(std::pair(x.R_g, std::pair(x.p_g, x.p_a)), std::pair(x.v_g, x.v_a));
    });
  };
  return {{"se23_exp", of<Real, V3, V3, V3>([](const V3& rho, const V3& nu, const V3& phi) {
             const auto x = exp_se3(stack(rho, phi)), y = exp_se3(stack(nu, phi));
             return std::pair(std::pair(rotation_matrix(x.Q), x.p), y.p);
           })},
          {"se23_log", of<Real, M3, V3, V3>([](const M3& R, const V3& p, const V3& v) {
             const auto x = log_se3_matrix(R, p), y = log_se3_matrix(R, v);
             return std::pair(std::pair(x.rho, y.rho), x.phi);
           })},
          {"se23_left_jacobian", jacobian([](const Vec6<>& xi) { return left_jacobian_se3(xi); })},
          {"se23_right_jacobian", jacobian([](const Vec6<>& xi) { return right_jacobian_se3(xi); })},
          {"se23_adjoint", of<Real, M3, V3, V3>([](const M3& R, const V3& p, const V3& v) {
             return three_by_three(R, hat(p) * R, hat(v) * R);
           })},
          {"preintegrate_forster", increment(false)},
          {"preintegrate_brossard", increment(true)},
          {"forster_bias_jacobians", biases(false)},
          {"brossard_bias_jacobians", biases(true)}};
}

}  // namespace liecheck::properties::conventions

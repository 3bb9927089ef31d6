// Known bugs in representations of rotations, adjoint matrices, means, and between poses and directions.

#include <bugs/planted_bugs.hpp>

#include <cmath>

namespace liecheck::properties {

// Longer than 80 lines: a list of independent bugs.
template <class S>
auto Bugs<S>::representations() -> Entries {
  return {
      {"quaternion_of_matrix_by_trace", "4 w^2 = 1 + tr R is the only pivot", "rbdl/rbdl issue 107",
       op::quaternion_from_matrix,
       [](const M3& R) -> V4 {
         const S w = std::sqrt(S(1) + R.trace()) / S(2);
         return V4((R(2, 1) - R(1, 2)) / (S(4) * w), (R(0, 2) - R(2, 0)) / (S(4) * w),
                   (R(1, 0) - R(0, 1)) / (S(4) * w), w);
       }},
      {"quaternion_of_matrix_conjugate", "the conjugate where the trace is negative",
       "CesiumGS/cesium issue 340", changed<op::quaternion_from_matrix>([](V4& Q, const M3& R) {
         if (R.trace() < S(0)) Q = conjugate(Q);
       })},
      {"quaternion_of_matrix_sizes", "roots without signs", "adamlwgriffiths/Pyrr issue 42",
       changed<op::quaternion_from_matrix>([](V4& Q, const M3&) { Q = Q.cwiseAbs().eval(); })},
      {"quaternion_of_matrix_not_unit", "not normalised: |Q| is 1/2 to 1", "ungerik/go3d issue 37",
       changed<op::quaternion_from_matrix>([](V4& Q, const M3&) { Q *= std::abs(Q.maxCoeff()); })},
      {"quaternion_of_matrix_half_turn", "identity for a half turn", "nalgebra, from_matrix near pi",
       changed<op::quaternion_from_matrix>([](V4& Q, const M3&) {
         if (std::abs(Q[3]) < S(1e-3)) Q = V4(V4::Unit(3));
       })},
      {"drifted_matrix_nan", "acos of a trace above 3, of a matrix that has drifted",
       "strasdat/Sophus issue 365", op::log3_matrix,
       [](const M3& R) -> V3 {
         V3 phi = good()[op::log3_matrix](R);
         if (R.trace() > S(3)) phi *= std::acos((R.trace() - S(1)) / S(2));
         return phi;
       }},
      {"matrix_of_quaternion_sign", "one sign of w x is wrong", "sympy/sympy issue 15193",
       changed<op::matrix_from_quaternion>([](M3& R, const V4& Q) { R(1, 2) += S(4) * Q[3] * Q[0]; })},
      {"matrix_of_quaternion_transposed", "R^T", "raysan5/raylib issue 1765",
       changed<op::matrix_from_quaternion>([](M3& R, const V4&) { R = R.transpose().eval(); })},
      {"product_commutes", "the cross product is left out", "bjornbytes/maf issue 2", op::quaternion_product,
       [](const V4& a, const V4& b) -> V4 {
         V4 q = multiply(a, b);
         q.template head<3>() -= V3(a.template head<3>()).cross(V3(b.template head<3>()));
         return q;
       }},
      {"product_exchanged", "Q1 Q0", "adamlwgriffiths/Pyrr issue 34", op::quaternion_product,
       [](const V4& a, const V4& b) -> V4 { return multiply(b, a); }},
      {"inverse_negated", "-Q for Q^-1", "Dav1dde/gl3n issue 95", op::quaternion_inverse,
       [](const V4& Q) -> V4 { return -Q; }},
      {"axis_angle_half", "the angle is atan2(|v|, w)", "sympy/sympy issue 24925",
       changed<op::axis_angle_from_quaternion>([](V4& a, const V4&) { a[3] /= S(2); })},
      {"axis_angle_acos", "2 acos(w), and the axis divided by sqrt(1 - w^2)", "JOML-CI/JOML issue 202",
       op::axis_angle_from_quaternion,
       [](const V4& Q) -> V4 {
         const V4 q = Q[3] < S(0) ? V4(-Q) : Q;
         const S n = std::sqrt(S(1) - q[3] * q[3]);
         return V4(q[0] / n, q[1] / n, q[2] / n, S(2) * std::acos(q[3]));
       }},
      {"axis_angle_of_matrix_at_pi", "the axis of the skew part, which vanishes at pi",
       "dimforge/nalgebra issue 1382", op::axis_angle_from_matrix,
       [](const M3& R) -> V4 {
         const V3 d(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
         const S n = d.norm();
         if (n == S(0)) return good()[op::axis_angle_from_matrix](R);
         return V4(d[0] / n, d[1] / n, d[2] / n, std::atan2(n / S(2), (R.trace() - S(1)) / S(2)));
       }},
      {"from_axis_angle_whole_sine", "sin(angle) for sin(angle/2)", "rustgd/cgmath issue 33",
       op::quaternion_from_axis_angle,
       [](const V3& a, const S& t) -> V4 {
         const S s = std::sin(t);
         return V4(s * a[0], s * a[1], s * a[2], std::cos(t / S(2)));
       }},
      {"rodrigues_formula_copy", "one product of the axis is a copy of another",
       "jvanverth/essentialmath issue 57",
       changed<op::matrix_from_axis_angle>([](M3& R, const V3& a, const S& t) {
         const S d = (S(1) - std::cos(t)) * a[2] * (a[0] - a[1]);
         R(1, 2) += d, R(2, 1) += d;
       })},
      {"gibbs_of_half", "v/(1 + w), which is that of a quarter of the angle", "AVSLab/basilisk issue 881",
       op::gibbs_from_quaternion,
       [](const V4& Q) -> V3 {
         return Q.template head<3>() / (S(1) + std::abs(Q[3])) * (Q[3] < S(0) ? -1 : 1);
       }},
      {"gibbs_not_squared", "1 + |g| for 1 + |g|^2", "JuliaGeometry/Rotations.jl issue 152",
       op::quaternion_from_gibbs,
       [](const V3& g) -> V4 { return V4(g[0], g[1], g[2], S(1)) / std::sqrt(S(1) + g.norm()); }},
      {"mrp_without_shadow", "v/(1 + w) for every w", "AVSLab/basilisk commit dbe604b",
       op::mrp_from_quaternion, [](const V4& Q) -> V3 { return Q.template head<3>() / (S(1) + Q[3]); }},
      {"mrp_of_gibbs", "(s, 1)/sqrt(1 + |s|^2): the formula of Gibbs parameters",
       "JuliaGeometry/Rotations.jl issue 152", op::quaternion_from_mrp,
       [](const V3& s) -> V4 { return V4(s[0], s[1], s[2], S(1)).normalized(); }},
      {"nearest_by_columns", "Gram and Schmidt's rotation is not the nearest", "scipy/scipy issue 22417",
       op::nearest_rotation, [](const M3& A) -> M3 { return good()[op::gram_schmidt](A); }},
      {"nearest_first_order", "A (3 I - A^T A)/2, one step of the iteration",
       "strasdat/Sophus, normalization of drifted matrices", op::nearest_rotation,
       [](const M3& A) -> M3 { return A * (S(3) * M3::Identity() - A.transpose() * A) / S(2); }},
      {"gram_schmidt_one_projection", "the third column is orthogonal to the second only",
       "datenwolf/linmath.h issue 32", op::gram_schmidt,
       [](const M3& A) -> M3 {
         M3 R = good()[op::gram_schmidt](A);
         const V3 c = A.col(2);
         R.col(2) = (c - R.col(1).dot(c) * R.col(1)).normalized();
         return R;
       }},
  };
}

template <class S>
auto Bugs<S>::transforms_and_means() -> Entries {
  return {
      {"adjoint_rows_of_R", "[p] R^T", "eeros-project/eeros-framework issue 68",
       changed<op::adjoint>(
           [](M6& Ad, const P& X) { Ad.template topRightCorner<3, 3>() = hat<S>(X.p) * X.R.transpose(); })},
      {"adjoint_lever_on_the_right", "R [p]", "the order of the factors of the lever arm",
       changed<op::adjoint>(
           [](M6& Ad, const P& X) { Ad.template topRightCorner<3, 3>() = X.R * hat<S>(X.p); })},
      {"coadjoint_of_motions", "Ad for Ad^-T", "ros2/geometry2 issue 538",
       changed<op::coadjoint>([](M6& Ad, const P&) { Ad.transposeInPlace(); })},
      {"small_adjoint_block", "the block [u] is below the diagonal", "artivis/manif pull 114",
       changed<op::small_adjoint>([](M6& ad, const V6&) {
         const M3 u = ad.template topRightCorner<3, 3>();
         ad.template bottomLeftCorner<3, 3>() = u, ad.template topRightCorner<3, 3>().setZero();
       })},
      {"covariance_on_one_side", "Sigma Ad^T", "mavlink/mavros issue 1998", op::transport_covariance,
       [](const P& X, const M6& Sigma) -> M6 { return Sigma * good()[op::adjoint](X).transpose(); }},
      {"covariance_not_moved", "rotated, but not moved by the lever arm", "ros2/geometry2 issue 431",
       op::transport_covariance,
       [](const P& X, const M6& Sigma) -> M6 {
         return good()[op::transport_covariance](P{X.R, V3(V3::Zero())}, Sigma);
       }},
      {"pitch_not_divided", "u . omega without a division by |omega|^2",
       "bdaiinstitute/spatialmath-python issue 61",
       changed<op::screw_parameters>([](V7& s, const V6& V) { s[3] = top(V).dot(low(V)); })},
      {"point_divided_once", "omega x u/|omega|", "bdaiinstitute/spatialmath-python, pole",
       changed<op::screw_parameters>([](V7& s, const V6& V) { s.template tail<3>() *= low(V).norm(); })},
      {"mean_of_signs", "the sum of quaternions of both signs", "mne-tools/mne-python issue 4895",
       op::mean_rotation,
       [](const V4& a, const V4& b, const V4& c, const V3& w) -> V4 {
         return (w[0] * a + w[1] * b + w[2] * c).normalized();
       }},
      {"mean_without_weights", "every weight is 1", "rlabbe/Kalman-and-Bayesian-Filters-in-Python issue 407",
       op::mean_rotation,
       [](const V4& a, const V4& b, const V4& c, const V3&) -> V4 {
         return good()[op::mean_rotation](a, b, c, V3(V3::Ones()));
       }},
      {"geodesic_mean_is_chordal", "the chordal mean", "borglab/gtsam, FindKarcherMean", op::geodesic_mean,
       [](const V4& a, const V4& b, const V4& c, const V3& w) -> V4 {
         return good()[op::mean_rotation](a, b, c, w);
       }},
      {"mean_pose_translations", "the translation is the mean of translations", "artivis/manif issue 298",
       changed<op::mean_pose>([](V7& q, const V7& a, const V7& b, const V7& c, const V3& w) {
         q.template head<3>() = (w[0] * a + w[1] * b + w[2] * c).template head<3>() / w.sum();
       })},
      {"interpolate_apart", "p0 + t (p1 - p0)", "the translation apart from the rotation",
       changed<op::interpolate>([](V7& q, const V7& a, const V7& b, const S& t) {
         q.template head<3>() = ((S(1) - t) * a + t * b).template head<3>();
       })},
      {"interpolate_in_parent", "(Q1 Q0*)^t on the wrong side", "wpilibsuite/allwpilib issue 8523",
       changed<op::interpolate>([](V7& q, const V7& a, const V7&, const S&) {
         const V4 start = rotation_of(a), turn = multiply(conjugate(start), rotation_of(q));
         q.template tail<4>() = multiply(turn, start);
       })},
      {"angle_between_acos", "acos(a . b)", "g-truc/glm issue 145", op::angle_between,
       [](const V3& a, const V3& b) -> S { return std::acos(a.dot(b)); }},
      {"angle_between_clamped", "acos of a cosine that is cut off", "dfki-ric/pytransform3d issue 47",
       op::angle_between,
       [](const V3& a, const V3& b) -> S { return std::acos(std::max(S(-1), std::min(S(1), a.dot(b)))); }},
      {"slerp_directions_parallel", "0/0 for equal directions", "toji/gl-matrix issue 500",
       op::slerp_directions,
       [](const V3& a, const V3& b, const S& t) -> V3 {
         const S theta = std::acos(std::max(S(-1), std::min(S(1), a.dot(b)))), s = std::sin(theta);
         return std::sin((S(1) - t) * theta) / s * a + std::sin(t * theta) / s * b;
       }},
      {"slerp_directions_axis", "a x b is not normalised", "godotengine/godot issue 27825",
       op::slerp_directions,
       [](const V3& a, const V3& b, const S& t) -> V3 {
         const S at = t * good()[op::angle_between](a, b);
         return std::cos(at) * a + std::sin(at) * V3(a.cross(b)).cross(a);
       }},
  };
}

template struct Bugs<float>;
template struct Bugs<double>;

}  // namespace liecheck::properties

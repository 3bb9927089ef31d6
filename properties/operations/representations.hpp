#pragma once
// Representations of one rotation: quaternion, matrix, axis and angle, Gibbs and modified Rodrigues parameters; the
// group of unit quaternions; and the rotation that is nearest to a matrix.

#include <operations/exponentials.hpp>
#include <operations/orientations.hpp>

namespace liecheck::properties::op {

inline constexpr std::string_view representations_header = "spatial/representations.hpp",
                                  shuster_source = "Shuster 1993, A survey of attitude representations";

inline constexpr Value<type::Scalar> angle{{"angle", {{"angle", 1, "rad"}}, "about `axis`, [-pi, pi]"}};
inline constexpr Value<type::Vector3> gibbs{{"gibbs", {{"gibbs", 3, "1"}}, "tan(theta/2) n"}},
    mrp{{"mrp", {{"mrp", 3, "1"}}, "tan(theta/4) n"}};
inline constexpr Value<type::Matrix3> A{{"A", {{"A", 9, "1"}}, "from B to A, not quite a rotation"}};

inline constexpr Value<type::Vector4> Q_of_matrix{{"Q", {{"Q", 4, "1"}}, "from B to A, as R; either sign"}},
    Q_product{{"Q", {{"Q", 4, "1"}}, "Q1 first, then Q0"}}, Q_inverse{{"Q", {{"Q", 4, "1"}}, "from A to B"}},
    axis_angle_result{{"(axis, angle)",
                       {{"axis", 3, "1"}, {"angle", 1, "rad"}},
                       "angle in [0, pi]; any axis of the identity, either at pi"}},
    Q_of_parameters{{"Q", {{"Q", 4, "1"}}, "from B to A"}};
inline constexpr Value<type::Matrix3> R_of_quaternion{{"R", {{"R", 9, "1"}}, "from B to A, as Q"}},
    nearest_result{{"R", {{"R", 9, "1"}}, "from B to A, as A"}};
inline constexpr Value<type::Vector3> gibbs_result{{"gibbs", {{"gibbs", 3, "1"}}, "body axes"}},
    mrp_result{{"mrp", {{"mrp", 3, "1"}}, "body axes; length at most 1, either sign at pi"}};

inline constexpr auto quaternion_from_matrix = operation<struct QuaternionFromMatrix>(
    {"quaternion_from_matrix", "Q of the rotation nearest to R, |Q| = 1",
     "Shepperd 1978, Quaternion from rotation matrix"},
    Q_of_matrix, {rotation_of_quaternion, norm_of_quaternion},
    {representations_header, "toQuaternion<S>(R).to_vector()"}, R);
inline constexpr auto matrix_from_quaternion = operation<struct MatrixFromQuaternion>(
    {"matrix_from_quaternion", "R(Q) of a unit quaternion Q", quaternion_source}, R_of_quaternion,
    {rotation_of_matrix, orthogonality_of_matrix}, {so3_header, "SO3<S>(Q).matrix()"}, Q);
inline constexpr auto quaternion_product =
    operation<struct QuaternionProduct>({"quaternion_product", "Q0 Q1 of unit quaternions: R(Q0) R(Q1)",
                                         "Sola 2017 (arXiv 1711.02508), eqs. 12 and 13"},
                                        Q_product, {rotation_of_quaternion, norm_of_quaternion},
                                        {so3_header, "(SO3<S>(Q0) * SO3<S>(Q1)).to_vector()"}, Q0, Q1);
inline constexpr auto quaternion_inverse = operation<struct QuaternionInverse>(
    {"quaternion_inverse", "Q^-1 of a unit quaternion: (-v, w)", quaternion_source}, Q_inverse,
    {rotation_of_quaternion, norm_of_quaternion}, {so3_header, "SO3<S>(Q).inverse().to_vector()"}, Q);

/// The product of both, so that an axis that is not of length 1 counts once, in its own block.
inline constexpr Block turn_of_pair{
    block::rotation_vector, "|angle axis/|axis| - phi_exact|; either sign at pi", "|phi_exact|", "rad"};
inline constexpr Block length_of_axis{block::norm_defect, "| |axis| - 1 |", "absolute", "1"};
inline constexpr auto axis_angle_from_quaternion = operation<struct AxisAngleFromQuaternion>(
    {"axis_angle_from_quaternion", "axis n and angle theta of Q/|Q| = +-(sin(theta/2) n, cos(theta/2))",
     shuster_source},
    axis_angle_result, {turn_of_pair, length_of_axis},
    {representations_header, "toAxisAngle<S>(SO3<S>(Q)).to_vector()"}, Q);
inline constexpr auto axis_angle_from_matrix = operation<struct AxisAngleFromMatrix>(
    {"axis_angle_from_matrix", "axis and angle of the rotation nearest to R", shuster_source},
    axis_angle_result, {turn_of_pair, length_of_axis},
    {representations_header, "toAxisAngle<S>(toQuaternion<S>(R)).to_vector()"}, R);
inline constexpr auto quaternion_from_axis_angle = operation<struct QuaternionFromAxisAngle>(
    {"quaternion_from_axis_angle", "Q = (sin(angle/2) axis, cos(angle/2)), |axis| = 1, |angle| <= pi",
     shuster_source},
    Q_of_parameters, {rotation_of_quaternion, norm_of_quaternion},
    {representations_header, "fromAxisAngle<S>({axis, angle}).to_vector()"}, axis, angle);
inline constexpr auto matrix_from_axis_angle = operation<struct MatrixFromAxisAngle>(
    {"matrix_from_axis_angle", "R = exp(angle [axis]), |axis| = 1, |angle| <= pi", shuster_source},
    R_of_angles, {rotation_of_matrix, orthogonality_of_matrix},
    {representations_header, "fromAxisAngle<S>({axis, angle}).matrix()"}, axis, angle);

inline constexpr auto gibbs_from_quaternion = operation<struct GibbsFromQuaternion>(
    {"gibbs_from_quaternion", "g = v/w = tan(theta/2) n of Q = (v, w), w != 0", shuster_source}, gibbs_result,
    {{block::parameters, "|g - g_exact|", "|g_exact|", "1"}},
    {representations_header, "toGibbs<S>(SO3<S>(Q))"}, Q);
inline constexpr auto quaternion_from_gibbs = operation<struct QuaternionFromGibbs>(
    {"quaternion_from_gibbs", "Q = (g, 1)/sqrt(1 + |g|^2)", shuster_source}, Q_of_parameters,
    {rotation_of_quaternion, norm_of_quaternion}, {representations_header, "fromGibbs<S>(gibbs).to_vector()"},
    gibbs);
inline constexpr auto mrp_from_quaternion = operation<struct MrpFromQuaternion>(
    {"mrp_from_quaternion", "s = sgn(w) v/(|Q| + |w|) = tan(theta/4) n, |s| <= 1", shuster_source},
    mrp_result, {{block::parameters, "|s - s_exact|; either sign at pi", "|s_exact|", "1"}},
    {representations_header, "toModifiedRodrigues<S>(SO3<S>(Q))"}, Q);
inline constexpr auto quaternion_from_mrp = operation<struct QuaternionFromMrp>(
    {"quaternion_from_mrp", "Q = (2 s, 1 - |s|^2)/(1 + |s|^2)", shuster_source}, Q_of_parameters,
    {rotation_of_quaternion, norm_of_quaternion},
    {representations_header, "fromModifiedRodrigues<S>(mrp).to_vector()"}, mrp);

inline constexpr auto nearest_rotation = operation<struct NearestRotation>(
    {"nearest_rotation",
     "the rotation R that minimises |R - A|, Frobenius: the polar factor, |A^T A - I| <= 0.4, det A > 0",
     "Higham 2008, section 8.1"},
    nearest_result, {rotation_of_matrix, orthogonality_of_matrix},
    {representations_header, "nearestRotation<S>(A)"}, A);
inline constexpr auto gram_schmidt =
    operation<struct GramSchmidt>({"gram_schmidt",
                                   "R with x along the first column of A, and y in the plane of the first "
                                   "two, |A^T A - I| <= 0.4, det A > 0",
                                   "Golub & Van Loan 2013, section 5.2.7"},
                                  nearest_result, {rotation_of_matrix, orthogonality_of_matrix},
                                  {representations_header, "orthonormalized<S>(A)"}, A);

// What a conversion gives for a matrix that has drifted from a rotation.
inline constexpr std::string_view drifted_source =
    "Bar-Itzhack 2000, New method for extracting the quaternion";
inline constexpr Operation quaternion_of_drifted_matrix =
    formed({"quaternion_of_drifted_matrix", "quaternion_from_matrix of A, 16 eps <= |A^T A - I| <= 1e-3",
            drifted_source},
           Q_of_matrix,
           {{block::rotation, "angle to the rotation nearest to A, beyond 4 |A^T A - I|", "absolute", "rad"},
            {block::norm_defect, "| |Q|^2 - 1 |, beyond 4 |A^T A - I|", "absolute", "1"}},
           {representations_header, "toQuaternion<S>(A).to_vector()"}, A);
inline constexpr Operation log_of_drifted_matrix = formed(
    {"log_of_drifted_matrix", "log3_matrix of A, 16 eps <= |A^T A - I| <= 1e-3", drifted_source}, phi_result,
    {{block::rotation, "angle of exp(phi) to the rotation nearest to A, beyond 4 sqrt(|A^T A - I|)",
      "absolute", "rad"}},
    {exp_log_header, "log3<S>(A)"}, A);

}  // namespace liecheck::properties::op

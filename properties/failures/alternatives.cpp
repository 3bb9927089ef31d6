#include <failures/alternatives.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <failures/calls.hpp>
#include <failures/relations.hpp>
#include <numbers>

namespace liecheck::properties {

namespace {

using Values = Eigen::VectorXd;
using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

/// Numbers of the arguments.
Values given(const Numbers& x, std::size_t from, Eigen::Index size) {
  return Eigen::Map<const Values>(&x.at(from), size);
}
/// Q1, or -Q1, whichever is nearer to Q0.
Values nearer(const Numbers& x) {
  const Values a = given(x, 0, 4), b = given(x, 4, 4);
  return a.dot(b) < 0 ? Values(-b) : b;
}
/// slerp from a to b, with the weights of the arc from a to `other`.
Values weighted(const Values& a, const Values& b, const Values& other, double t) {
  const double angle = std::atan2((a - other).norm() * (a + other).norm() / 2, a.dot(other));
  return (std::sin((1 - t) * angle) * a + std::sin(t * angle) * b) / std::sin(angle);
}

/// rho turned by `part` of the rotation phi, for xi = (rho, phi) at `from`: a chord as long as the arc.
Eigen::Vector3d turned_by(double part, const Numbers& x, std::size_t from) {
  const Eigen::Vector3d phi = part * given(x, from + 3, 3);
  const double angle = phi.norm();
  return Eigen::AngleAxisd(angle, angle > 0 ? Eigen::Vector3d(phi / angle) : Eigen::Vector3d::UnitX()) *
         Eigen::Vector3d(given(x, from, 3));
}
/// The same in the plane, for (rho, omega).
Eigen::Vector2d turned_in_plane(double part, const Numbers& x, std::size_t from) {
  return Eigen::Rotation2Dd(part * x.at(from + 2)) * Eigen::Vector2d(given(x, from, 2));
}
constexpr const char* half_way =
    "rho turned by half of the rotation (the midpoint rule) in place of V(phi) rho";
constexpr const char* whole_way = "R rho in place of V(phi) rho";

constexpr const char* moved_inertia =
    "m (|p|^2 1 - p p^T) is added to I_C, as if it were about the origin: about the centre of mass it does "
    "not "
    "change with p";
/// I_C of a moved inertia, from (X, I), with the term of parallel axes.
Values with_steiner(const char* operation, const Numbers& x) {
  Values I = given(exact(operation, x), 4, 9);
  const Eigen::Vector3d p = given(x, 9, 3);
  for (Eigen::Index i = 0; i < 3; ++i)
    for (Eigen::Index k = 0; k < 3; ++k)
      I[3 * i + k] += x.at(12) * ((i == k ? p.squaredNorm() : 0) - p[i] * p[k]);
  return I;
}

/// A after some steps of Newton's iteration X = (X + X^-T)/2 to the nearest rotation.
template <int steps>
Values newton_steps(const Numbers& x) {
  Eigen::Matrix3d X = RowMajor3(x.data());
  for (int k = 0; k < steps; ++k) X = (0.5 * (X + X.inverse().transpose())).eval();
  return Values(X.transpose().reshaped());
}
/// Gram and Schmidt's method for the columns of A, or its rows, from the given one on.
Values orthonormalised(const Numbers& x, bool rows, Eigen::Index first) {
  RowMajor3 R(x.data());
  if (rows) R.transposeInPlace();
  for (Eigen::Index i = 0; i < 3; ++i) {
    auto v = R.col((first + i) % 3);
    for (Eigen::Index k = 0; k < i; ++k) v -= R.col((first + k) % 3).dot(v) * R.col((first + k) % 3);
    v.normalize();
  }
  if (rows) R.transposeInPlace();
  return Values(Eigen::Map<const Values>(R.data(), 9));
}
template <bool rows, Eigen::Index first>
Values gram_schmidt(const Numbers& x) {
  return orthonormalised(x, rows, first);
}
constexpr const char* stops_early = "Newton's iteration to the nearest rotation ends too early";

/// The normalised sum of quaternions, each with the sign of the first one.
Values summed(const Numbers& x) {
  const Values first = given(x, 0, 4);
  Values sum = x.at(12) * first;
  for (const std::size_t i : {std::size_t(1), std::size_t(2)}) {
    const Values Q = given(x, 4 * i, 4);
    sum += (Q.dot(first) < 0 ? -x.at(12 + i) : x.at(12 + i)) * Q;
  }
  return sum.normalized();
}
/// The quaternion of R by the branch of its largest number k of x, y, z, with a difference of entries for number i in place of
/// their sum.
template <int k, int i, int sign>
Values with_difference(const Numbers& x) {
  const RowMajor3 R(x.data());
  constexpr int j = 3 - i - k;
  const double s = 2 * std::sqrt(1 + R(k, k) - R(i, i) - R(j, j));
  Values Q(4);
  Q[k] = s / 4, Q[i] = sign * (R(k, i) - R(i, k)) / s, Q[j] = (R(k, j) + R(j, k)) / s;
  Q[3] = (R((k + 2) % 3, (k + 1) % 3) - R((k + 1) % 3, (k + 2) % 3)) / s;
  return Q;
}
constexpr const char* difference_in_branch =
    "in the branch of one of the entries of the diagonal, a number of Q is a difference of two entries of R "
    "in place of their sum";

/// A formula that libraries have in place of the right one, for some numbers of the result.
struct Alternative {
  const char* operation;
  Eigen::Index from, size;
  Values (*result)(const Numbers& arguments);
  const char* text;
};
const Alternative alternatives[] = {
    {"nearest_rotation", 0, 9, newton_steps<1>, stops_early},
    {"nearest_rotation", 0, 9, newton_steps<2>, stops_early},
    {"nearest_rotation", 0, 9, newton_steps<3>, stops_early},
    {"nearest_rotation", 0, 9, gram_schmidt<false, 0>,
     "the columns are made orthonormal one after another (Gram and Schmidt), which is not the nearest "
     "rotation"},
    {"nearest_rotation", 0, 9, gram_schmidt<true, 0>,
     "the rows are made orthonormal one after another (Gram and Schmidt), which is not the nearest rotation"},
    {"mean_rotation", 0, 4, summed,
     "the sum of the quaternions, normalised, in place of the eigenvector that maximises sum_i w_i (Q . "
     "Q_i)^2"},
    {"quaternion_from_matrix", 0, 4, with_difference<0, 1, 1>, difference_in_branch},
    {"quaternion_from_matrix", 0, 4, with_difference<0, 1, -1>, difference_in_branch},
    {"quaternion_from_matrix", 0, 4, with_difference<0, 2, 1>, difference_in_branch},
    {"quaternion_from_matrix", 0, 4, with_difference<0, 2, -1>, difference_in_branch},
    {"quaternion_from_matrix", 0, 4, with_difference<1, 0, 1>, difference_in_branch},
    {"quaternion_from_matrix", 0, 4, with_difference<1, 0, -1>, difference_in_branch},
    {"quaternion_from_matrix", 0, 4, with_difference<1, 2, 1>, difference_in_branch},
    {"quaternion_from_matrix", 0, 4, with_difference<1, 2, -1>, difference_in_branch},
    {"quaternion_from_matrix", 0, 4, with_difference<2, 0, 1>, difference_in_branch},
    {"quaternion_from_matrix", 0, 4, with_difference<2, 0, -1>, difference_in_branch},
    {"quaternion_from_matrix", 0, 4, with_difference<2, 1, 1>, difference_in_branch},
    {"quaternion_from_matrix", 0, 4, with_difference<2, 1, -1>, difference_in_branch},
    {"gram_schmidt", 0, 9, gram_schmidt<true, 0>, "the rows are made orthonormal in place of the columns"},
    {"gram_schmidt", 0, 9, gram_schmidt<false, 1>,
     "the method begins with the second column in place of the first"},
    {"gram_schmidt", 0, 9, gram_schmidt<false, 2>,
     "the method begins with the third column in place of the first"},
    {"slerp", 0, 4,
     [](const Numbers& x) -> Values { return ((1 - x[8]) * given(x, 0, 4) + x[8] * nearer(x)).normalized(); },
     "linear interpolation, normalised, in place of slerp: its angle is not t times that between Q0 and Q1"},
    {"slerp", 0, 4, [](const Numbers& x) -> Values { return (1 - x[8]) * given(x, 0, 4) + x[8] * nearer(x); },
     "linear interpolation, which is not normalised, in place of slerp"},
    {"slerp", 0, 4,
     [](const Numbers& x) -> Values {
       return weighted(given(x, 0, 4), given(x, 4, 4), given(x, 4, 4), x[8]);
     },
     "the longer way is taken where Q0 . Q1 < 0: -Q1 is the same rotation, and nearer"},
    {"slerp", 0, 4,
     [](const Numbers& x) -> Values { return weighted(given(x, 0, 4), given(x, 4, 4), nearer(x), x[8]); },
     "the weights are those of slerp to the nearer one of Q1 and -Q1, but they multiply Q1"},
    {"slerp", 0, 4,
     [](const Numbers& x) -> Values { return weighted(given(x, 0, 4), nearer(x), given(x, 4, 4), x[8]); },
     "the weights are those of the longer way, but they multiply the nearer one of Q1 and -Q1"},
    {"integrate", 0, 3,
     [](const Numbers& x) -> Values {
       const Numbers right = exact("integrate", x);
       const Eigen::Quaterniond Q0(&x[3]), Q1(&right[3]);
       const Eigen::Vector3d turned =
           Q1 * (Q0.conjugate() * Eigen::Vector3d(given(right, 0, 3) - given(x, 0, 3)));
       return given(x, 0, 3) + turned;
     },
     "the step is turned by Q1, the orientation at its end, in place of Q0"},
    {"integrate", 0, 3,
     [](const Numbers& x) -> Values {
       return given(x, 0, 3) + Eigen::Quaterniond(&x[3]) * turned_by(0.5, x, 7);
     },
     half_way},
    {"integrate", 0, 3,
     [](const Numbers& x) -> Values {
       return given(x, 0, 3) + Eigen::Quaterniond(&x[3]) * turned_by(1, x, 7);
     },
     whole_way},
    {"exp6", 9, 3, [](const Numbers& x) -> Values { return turned_by(0.5, x, 0); }, half_way},
    {"exp6", 9, 3, [](const Numbers& x) -> Values { return turned_by(1, x, 0); }, whole_way},
    {"se2_exp", 0, 2, [](const Numbers& x) -> Values { return turned_in_plane(0.5, x, 0); }, half_way},
    {"se2_exp", 0, 2, [](const Numbers& x) -> Values { return turned_in_plane(1, x, 0); }, whole_way},
    {"se2_integrate", 0, 2,
     [](const Numbers& x) -> Values {
       return given(x, 0, 2) + Eigen::Rotation2Dd(std::atan2(x[3], x[2])) * turned_in_plane(0.5, x, 4);
     },
     half_way},
    {"se2_integrate", 0, 2,
     [](const Numbers& x) -> Values {
       return given(x, 0, 2) + Eigen::Rotation2Dd(std::atan2(x[3], x[2])) * turned_in_plane(1, x, 4);
     },
     whole_way},
    {"inverse", 9, 3,
     [](const Numbers& x) -> Values { return -RowMajor3(given(x, 0, 9).data()) * given(x, 9, 3); },
     "the translation is -R p in place of -R^T p"},
    {"inverse", 9, 3, [](const Numbers& x) -> Values { return -given(x, 9, 3); },
     "the translation is -p in place of -R^T p"},
    {"difference", 0, 3, [](const Numbers& x) -> Values { return given(relative_pose(x), 9, 3); },
     "the translation of the relative pose in place of the linear part of its logarithm"},
    {"difference", 0, 3,
     [](const Numbers& x) -> Values {
       const Numbers pose = relative_pose(x), phi = exact("log3_matrix", {pose.begin(), pose.begin() + 9});
       return RowMajor3(exact("left_jacobian3_inverse", phi).data()) * (given(x, 7, 3) - given(x, 0, 3));
     },
     "p1 - p0 is not turned into the frame of q0"},
    {"difference", 0, 3,
     [](const Numbers& x) -> Values {
       const Numbers pose = relative_pose(x), phi = exact("log3_matrix", {pose.begin(), pose.begin() + 9});
       const Eigen::Matrix3d R = RowMajor3(pose.data());
       return RowMajor3(exact("left_jacobian3_inverse", phi).data()) * (R.transpose() * given(pose, 9, 3));
     },
     "p1 - p0 is turned into the frame of q1 in place of q0"},
    {"act_inertia", 4, 9, [](const Numbers& x) -> Values { return with_steiner("act_inertia", x); },
     moved_inertia},
    {"act_inverse_inertia", 4, 9,
     [](const Numbers& x) -> Values { return with_steiner("act_inverse_inertia", x); }, moved_inertia},
    {"relative_angle", 0, 1,
     [](const Numbers& x) -> Values {
       return Values::Constant(1, 2 * std::numbers::pi - exact("relative_angle", x)[0]);
     },
     "where Q0 . Q1 < 0, the angle is 2 pi minus the right one: Q1 and -Q1 are the same rotation, and the "
     "nearer one counts"},
    {"se2_log", 2, 1,
     [](const Numbers& x) -> Values {
       return Values::Constant(1, std::asin(std::clamp(x[3] / std::hypot(x[2], x[3]), -1.0, 1.0)));
     },
     "the angle is asin(sin), which is wrong where cos < 0: atan2(sin, cos) is not"},
    {"se2_integrate", 0, 2,
     [](const Numbers& x) -> Values {
       const Numbers right = exact("se2_integrate", x);
       const auto turned = [](double angle, const Values& v) -> Values {
         return Eigen::Rotation2Dd(angle) * Eigen::Vector2d(v);
       };
       return given(x, 0, 2) + turned(x[6], given(right, 0, 2) - given(x, 0, 2));
     },
     "the step is turned by the heading at its end in place of that at its start"},
    {"twist_angle", 0, 1,
     [](const Numbers& x) -> Values {
       const Values v = given(x, 0, 3);
       return Values::Constant(
           1, std::remainder(std::copysign(2 * std::atan2(v.norm(), x[3]), v.dot(given(x, 4, 3))),
                             2 * std::numbers::pi));
     },
     "the angle is that of the whole rotation, 2 atan2(|v|, w), in place of 2 atan2(v . axis, w)"},
    {"se2_log", 2, 1, [](const Numbers& x) -> Values { return Values::Constant(1, std::atan(x[3] / x[2])); },
     "the angle is atan(sin / cos), which is wrong by pi on one half of the circle: atan2(sin, cos) is not"},
};

/// Whether an alternative gives the results of four of five calls that are wrong in its numbers by more than a millionth of
/// the result, or of a rad, to a share of the error; to a hundredth: an error of another formula agrees by chance once in a hundred calls at most.
bool gives_results(const Alternative& one, const std::vector<JudgedCall>& calls, double share) try {
  std::size_t explained = 0, wrong = 0;
  for (const auto& [call, right_numbers] : calls) {
    const Values right = given(right_numbers, 0, std::ssize(right_numbers)),
                 got = given(call.result, 0, right.size()).segment(one.from, one.size),
                 exact = right.segment(one.from, one.size);
    const auto apart = [&](const Values& x) {  // of quaternions, either sign is right
      return one.size == 4 ? std::min((got - x).norm(), (got + x).norm()) : (got - x).norm();
    };
    // Of a tiny angle, a right formula may lose digits that are far below a millionth of a rad.
    if (!(apart(exact) > 1e-6 * (one.size == 1 ? 1 : right.norm()))) continue;
    const Values other = one.result(call.arguments);
    const double distance = one.size == 4 ? std::min(apart(other), apart(other.normalized())) : apart(other);
    ++wrong, explained += distance < share * apart(exact);
  }
  return wrong >= 5 && 5 * explained >= 4 * wrong;
} catch (const std::exception&) {  // the oracle does not know these arguments
  return false;
}

}  // namespace

bool has_alternatives(std::string_view operation) {
  return std::ranges::any_of(alternatives,
                             [&](const Alternative& one) { return one.operation == operation; });
}

std::string alternative_of(const Operation& operation, const std::vector<JudgedCall>& calls) {
  for (const double share : {1e-4, 0.01})  // first those that agree best
    for (const Alternative& one : alternatives)
      if (one.operation == operation.name && gives_results(one, calls, share)) return one.text;
  return "";
}

}  // namespace liecheck::properties

#pragma once
// Numbers of calls as vectors, matrices and quaternions, in double, for the relations between operations.

#include <Eigen/Geometry>
#include <initializer_list>
#include <vector>

namespace liecheck::properties {

using Numbers = std::vector<double>;

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using RowMajor6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

inline Eigen::Vector3d vec3(const Numbers& x, std::size_t from) {
  return Eigen::Vector3d(x.at(from), x.at(from + 1), x.at(from + 2));
}
inline RowMajor3 mat3(const Numbers& x, std::size_t from = 0) {
  RowMajor3 m;
  for (Eigen::Index i = 0; i < 9; ++i) m(i / 3, i % 3) = x.at(from + static_cast<std::size_t>(i));
  return m;
}
inline RowMajor6 mat6(const Numbers& x) {
  RowMajor6 m;
  for (Eigen::Index i = 0; i < 36; ++i) m(i / 6, i % 6) = x.at(static_cast<std::size_t>(i));
  return m;
}
/// Of the numbers x, y, z, w; of unit norm but for rounding.
inline Eigen::Quaterniond quat(const Numbers& x, std::size_t from = 0) {
  return Eigen::Quaterniond(x.at(from + 3), x.at(from), x.at(from + 1), x.at(from + 2)).normalized();
}
inline Numbers joined(std::initializer_list<Numbers> parts) {
  Numbers all;
  for (const Numbers& p : parts) all.insert(all.end(), p.begin(), p.end());
  return all;
}
inline Numbers numbers(const Eigen::Vector3d& v) {
  return {v[0], v[1], v[2]};
}
inline Numbers numbers(const Eigen::Quaterniond& q) {
  return {q.x(), q.y(), q.z(), q.w()};
}
template <int N>
inline Numbers numbers(const Eigen::Matrix<double, N, N, Eigen::RowMajor>& m) {
  return Numbers(m.data(), m.data() + m.size());
}
inline Numbers cut(const Numbers& x, std::size_t from, std::size_t size) {
  return Numbers(x.begin() + static_cast<std::ptrdiff_t>(from),
                 x.begin() + static_cast<std::ptrdiff_t>(from + size));
}
inline Numbers minus(Numbers x) {
  for (double& number : x) number = -number;
  return x;
}
inline Eigen::Quaterniond quat_of(const RowMajor3& R) {
  return Eigen::Quaterniond(Eigen::Matrix3d(R)).normalized();
}
inline RowMajor6 adjoint(const RowMajor3& R, const Eigen::Vector3d& p) {
  RowMajor3 cross;
  cross << 0, -p[2], p[1], p[2], 0, -p[0], -p[1], p[0], 0;
  RowMajor6 Ad = RowMajor6::Zero();
  Ad.topLeftCorner<3, 3>() = Ad.bottomRightCorner<3, 3>() = R;
  Ad.topRightCorner<3, 3>() = cross * R;
  return Ad;
}
/// The 6 x 6 Jacobian of the diagonal block J, with the given coupling block.
inline Numbers jacobian6(const RowMajor3& J, const RowMajor3& coupling) {
  RowMajor6 all = RowMajor6::Zero();
  all.topLeftCorner<3, 3>() = all.bottomRightCorner<3, 3>() = J;
  all.topRightCorner<3, 3>() = coupling;
  return numbers<6>(all);
}
inline RowMajor3 coupling_of(const Numbers& J6) {
  return mat6(J6).topRightCorner<3, 3>();
}

inline Numbers relative_quaternion(const Numbers& x, std::size_t first, std::size_t second) {
  const Eigen::Quaterniond a(x[first + 3], x[first], x[first + 1], x[first + 2]),
      b(x[second + 3], x[second], x[second + 1], x[second + 2]);
  return numbers(a.conjugate() * b);
}
inline Numbers rho_of(const RowMajor3& J_inverse, const Eigen::Vector3d& p) {
  return numbers(Eigen::Vector3d(J_inverse * p));
}
}  // namespace liecheck::properties

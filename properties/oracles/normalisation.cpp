#include <oracles/normalisation.hpp>

#include <oracles/agreement.hpp>

namespace liecheck::oracles {

Resolved<Quaternion<>> normalize(const Quaternion<>& Q) {
  const Quaternion<> value = cast<Real>(normalized(cast<Real100>(Q)));
  Real largest(0);
  for (const Real& x : Q.x)
    if (abs(x) > largest) largest = abs(x);
  return {value, agree(normalized(Real(1 / largest) * Q), value)};
}

Resolved<Quaternion<>> first_order_normalize(const Quaternion<>& Q) {
  const Quaternion<Real100> q = cast<Real100>(Q);
  const Quaternion<> value = cast<Real>(Real100((3 - squared_norm(q)) / 2) * q);
  return {value, agree(Q - Real((squared_norm(Q) - 1) / 2) * Q, value)};
}

Resolved<Mat3<>> matrix_from_quaternion(const Quaternion<>& Q) {
  const Mat3<> value = cast<Real>(rotation_matrix(normalized(cast<Real100>(Q))));
  Mat3<> second;
  for (int j = 0; j < 3; ++j) {
    const Vec3<> column = rotate(Q, Vec3<>{{Real(j == 0), Real(j == 1), Real(j == 2)}});
    for (int i = 0; i < 3; ++i) second(i, j) = column[i];
  }
  return {value, agree(second, value)};
}

}  // namespace liecheck::oracles

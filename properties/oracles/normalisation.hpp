#pragma once
// Normalisation of a stored quaternion Q != 0, and the rotation matrix of Q/|Q|.
//
// Values: at 100 digits. Second formulas, at 50 digits: Q/m over its norm, m the largest |number|; for the first
// order Q - Q (|Q|^2 - 1)/2; for the matrix the rotated axes. Error: below 1e-41.
//
// Source: Sola 2017 (arXiv 1711.02508), section 2.

#include <oracles/quaternion.hpp>
#include <oracles/spatial.hpp>

namespace liecheck::oracles {

/// Q/|Q|
Resolved<Quaternion<>> normalize(const Quaternion<>& Q);
/// Q (3 - |Q|^2) / 2
Resolved<Quaternion<>> first_order_normalize(const Quaternion<>& Q);
/// R(Q/|Q|)
Resolved<Mat3<>> matrix_from_quaternion(const Quaternion<>& Q);

template <BallNumber T>
Resolved<Quaternion<T>> normalize(const Quaternion<T>& Q) {
  return {normalized(Q), true};
}
template <BallNumber T>
Resolved<Quaternion<T>> first_order_normalize(const Quaternion<T>& Q) {
  return {T(0.5) * (T(3) - squared_norm(Q)) * Q, true};
}
template <BallNumber T>
Resolved<Mat3<T>> matrix_from_quaternion(const Quaternion<T>& Q) {
  return {rotation_matrix(normalized(Q)), true};
}

}  // namespace liecheck::oracles

#pragma once
// Checks of input rotations: numbers that are not a rotation up to rounding errors are refused.

#include <liecheck/spatial/so3.hpp>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

namespace liecheck {

/// The error bounds of this library hold if ||Q|^2 - 1| and |R^T R - I| are at most 8 eps. This is twice the
/// rounding error of a normalisation, a product or an integrate.
template <Scalar S>
S normDefectBudget() {
  return S(8) * eps<S>();
}

namespace checked_rotation_detail {

template <Scalar S>
[[noreturn]] void refuse(std::string_view what, const S& value, const std::string& why) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(std::numeric_limits<double>::max_digits10);
  text << what << " = " << double(value) << ": " << why;
  throw std::invalid_argument(text.str());
}

template <Scalar S, class M>
void refuseNonFinite(std::string_view what, const M& numbers) {
  for (int i = 0; i < numbers.rows(); ++i)
    for (int j = 0; j < numbers.cols(); ++j)
      if (!finite<S>(numbers(i, j))) refuse<S>(what, numbers(i, j), "not finite");
}

/// |R^T R - I| (Frobenius).
template <Scalar S>
S orthogonalityDefect(const Matrix3<S>& R) {
  Matrix3<S> E;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      CompensatedSum<S> sum;
      for (int k = 0; k < 3; ++k) sum.add_product(R(k, i), R(k, j));
      if (i == j) sum.add(S(-1));
      E(i, j) = sum.value();
    }
  using std::sqrt;
  return sqrt(E.squaredNorm());
}
template <Scalar S>
S determinantOf(const Matrix3<S>& R) {
  return R.col(0).dot(cross<S>(R.col(1), R.col(2)));
}
/// Whether checkedRotation accepts R.
template <Scalar S>
bool isRotation(const Matrix3<S>& R, const S& budget) {
  return orthogonalityDefect<S>(R) <= budget && determinantOf<S>(R) > S(0);
}

}  // namespace checked_rotation_detail

/// The rotation of the quaternion x y z w. Throws std::invalid_argument with the wrong value unless all four
/// numbers are finite and ||Q|^2 - 1| <= normDefectBudget.
template <Scalar S>
SO3<S> checkedQuaternion(const Vector4<S>& xyzw) {
  using checked_rotation_detail::refuse;
  checked_rotation_detail::refuseNonFinite<S>("quaternion", xyzw);
  if (xyzw.isZero(S(0))) refuse<S>("quaternion: |Q|", S(0), "a zero quaternion is not a rotation");
  CompensatedSum<S> sum;
  for (int i = 0; i < 4; ++i) sum.add_product(xyzw[i], xyzw[i]);
  const S defect = sum.add(S(-1)).value();
  if (!(absolute<S>(defect) <= normDefectBudget<S>()))
    refuse<S>("quaternion: |Q|^2 - 1", defect, "not 0 up to 8 eps: normalize first");
  return SO3<S>(xyzw);
}

/// Returns R [3 x 3]. Throws std::invalid_argument with `what` and the wrong value unless R is finite,
/// |R^T R - I| (Frobenius) <= budget and det R > 0.
template <Scalar S>
Matrix3<S> checkedRotation(const Matrix3<S>& R, const std::type_identity_t<S>& budget = normDefectBudget<S>(),
                           const std::string& what = "rotation matrix") {
  using namespace checked_rotation_detail;
  refuseNonFinite<S>(what, R);
  const S defect = orthogonalityDefect<S>(R);
  if (!(defect <= budget))
    refuse<S>(what + ": |R^T R - I|", defect,
              "not 0 up to " + std::to_string(long(double(budget / eps<S>()))) +
                  " eps: take the nearest rotation first");
  const S determinant = determinantOf<S>(R);
  if (!(determinant > S(0))) refuse<S>(what + ": determinant", determinant, "a reflection is not a rotation");
  return R;
}

}  // namespace liecheck

// The nearest rotation and the logarithm in scalars that are wider than the numbers of the matrix.

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <liecheck/spatial/representations.hpp>

#include "scalar_test.hpp"

namespace liecheck {
namespace {

template <unsigned DIGITS>
using Decimal = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<DIGITS>,
                                              boost::multiprecision::et_off>;
using Real = Decimal<150>;

SCALAR_SUITE(WideRotation, Decimal<50>, Decimal<100>);

/// The polar factor by Newton's iteration X <- (X + X^-T)/2 (Higham 1986).
Matrix3<Real> polarFactor(Matrix3<Real> X) {
  for (int step = 0; step < 20; ++step) {
    Matrix3<Real> cofactors;
    for (int i = 0; i < 3; ++i)
      cofactors.col(i) = cross<Real>(Vector3<Real>(X.col((i + 1) % 3)), Vector3<Real>(X.col((i + 2) % 3)));
    X = (X + cofactors / Real(X.col(0).dot(cofactors.col(0)))) / Real(2);
  }
  return X;
}

/// Rotations whose entries are rounded to T, at small, moderate and nearly straight angles.
template <class T>
std::vector<Matrix3<T>> rounded() {
  std::vector<Matrix3<T>> all;
  for (const T angle : {T(1e-20), T(1e-6), T(0.1), T(1), T(2.5), T(3.14), T(3.1415)})
    for (const Vector3<T>& n : {Vector3<T>(1, 2, -3), Vector3<T>(-2, 1, 1), Vector3<T>(0.1, -3, 1)})
      all.push_back(exp3<T>(Vector3<T>(n * (angle / n.norm()))));
  return all;
}

template <class S, class T>
void expectNearestRotation() {
  for (const Matrix3<T>& stored : rounded<T>()) {
    const Matrix3<S> R = stored.template cast<S>();
    const Matrix3<Real> nearest = polarFactor(stored.template cast<Real>());
    const Vector3<Real> exact = log3<Real>(nearest);
    const auto error = [&](const Vector3<S>& phi) {
      return double(Real((phi.template cast<Real>() - exact).norm() / exact.norm() / Real(eps<S>())));
    };
    EXPECT_LE(error(log3<S>(R)), 8) << exact.template cast<double>().transpose();
    EXPECT_LE(error(log6<S>(SE3<S>(R, Vector3<S>(S(1), S(2), S(3)))).angular()), 8);
    const Matrix3<Real> back = toQuaternion<S>(R).matrix().template cast<Real>();
    EXPECT_LE(double(Real((back - nearest).norm() / Real(eps<S>()))), 8);
  }
}

SCALAR_TEST(WideRotation, IsNearestToAMatrixOfFloatOrDouble) {
  expectNearestRotation<S, float>();
  expectNearestRotation<S, double>();
}

}  // namespace
}  // namespace liecheck

// Quaternions and directions of any norm in spatial/relative_rotation.hpp and spatial/representations.hpp.

#include <gtest/gtest.h>

#include <liecheck/spatial/euler.hpp>
#include <liecheck/spatial/representations.hpp>

#include "../refusal.hpp"
#include "scalar_test.hpp"

namespace liecheck {
namespace {

using test::refusal;

SCALAR_SUITE(OffUnitRotation, float, double);

/// Powers of two for numbers of three binary digits: the results are exact from the smallest subnormal number to numbers
/// whose norm is nearly the largest.
template <class S>
std::vector<S> everyScale() {
  using Limits = std::numeric_limits<S>;
  std::vector<S> all;
  for (const int k :
       {Limits::min_exponent - Limits::digits, Limits::min_exponent, Limits::min_exponent / 2,
        Limits::min_exponent / 4, -30, -7, 0, 7, 30, Limits::max_exponent / 2, Limits::max_exponent - 3})
    all.push_back(std::ldexp(S(1), k));
  return all;
}

SCALAR_TEST(OffUnitRotation, FunctionsOfTwoTakeTheNormalisedNumbers) {
  const Vector4<S> Q0(S(1), S(2), S(-3), S(5)), Q1(S(-2), S(1), S(4), S(3));
  const Vector3<S> a(S(1), S(2), S(-3)), b(S(-2), S(1), S(5));
  const S t = S(0.375), bound = S(8) * eps<S>();
  const auto Q = [](const S& scale, const Vector4<S>& q) { return SO3<S>(Vector4<S>(scale * q)); };
  const S relative = relativeAngle<S>(Q(S(1), Q0), Q(S(1), Q1)), twist = twistAngle<S>(Q(S(1), Q0), b),
          between = angleBetween<S>(a, b);
  const SO3<S> on_arc = slerp<S>(Q(S(1), Q0), Q(S(1), Q1), t), minimal = rotationBetween<S>(a, b);
  const Vector3<S> direction = slerp<S>(a, b, t);
  for (const S k : everyScale<S>())
    for (const S j : everyScale<S>()) {
      EXPECT_NEAR(relativeAngle<S>(Q(k, Q0), Q(j, Q1)), relative, bound) << k << ' ' << j;
      EXPECT_NEAR(twistAngle<S>(Q(k, Q0), Vector3<S>(j * b)), twist, bound) << k << ' ' << j;
      EXPECT_NEAR(angleBetween<S>(Vector3<S>(k * a), Vector3<S>(j * b)), between, bound) << k << ' ' << j;
      EXPECT_LE((slerp<S>(Q(k, Q0), Q(j, Q1), t).to_vector() - on_arc.to_vector()).norm(), bound) << k << j;
      EXPECT_LE((slerp<S>(Vector3<S>(k * a), Vector3<S>(j * b), t) - direction).norm(), bound) << k << j;
      const SO3<S> turn = rotationBetween<S>(Vector3<S>(k * a), Vector3<S>(j * b));
      EXPECT_LE((turn.to_vector() - minimal.to_vector()).norm(), bound) << k << ' ' << j;
    }
}

SCALAR_TEST(OffUnitRotation, RepresentationsAreThoseOfTheNormalisedQuaternion) {
  const Vector4<S> q(S(1), S(2), S(-3), S(5));
  const SO3<S> Q(q);
  const AxisAngle<S> pair = toAxisAngle<S>(Q);
  const Vector3<S> gibbs = toGibbs<S>(Q), rodrigues = toModifiedRodrigues<S>(Q),
                   euler = eulerFromQuaternion<S>(EulerOrder{0, 1, 2, true}, Q);
  const S bound = S(8) * eps<S>();
  for (const S k : everyScale<S>()) {
    const SO3<S> off(Vector4<S>(k * q));
    EXPECT_LE((toAxisAngle<S>(off).to_vector() - pair.to_vector()).norm(), bound) << k;
    EXPECT_LE((toGibbs<S>(off) - gibbs).norm(), bound) << k;
    EXPECT_LE((toModifiedRodrigues<S>(off) - rodrigues).norm(), bound) << k;
    EXPECT_LE((eulerFromQuaternion<S>(EulerOrder{0, 1, 2, true}, off) - euler).norm(), bound) << k;
  }
}

SCALAR_TEST(OffUnitRotation, ZeroIsRefusedAndNumbersThatAreNotFiniteGiveNaN) {
  const SO3<S> one = SO3<S>::Identity(), none{Vector4<S>{Vector4<S>::Zero()}};
  const Vector3<S> x(S(1), S(0), S(0)), zero(S(0), S(0), S(0));
  const std::string no_rotation = "a zero quaternion is not a rotation",
                    no_direction = "a zero vector has no direction";
  EXPECT_EQ(refusal([&] { relativeAngle<S>(one, none); }), no_rotation);
  EXPECT_EQ(refusal([&] { relativeAngle<S>(none, one); }), no_rotation);
  EXPECT_EQ(refusal([&] { twistAngle<S>(none, x); }), no_rotation);
  EXPECT_EQ(refusal([&] { twistAngle<S>(one, zero); }), no_direction);
  EXPECT_EQ(refusal([&] { angleBetween<S>(zero, x); }), no_direction);
  EXPECT_EQ(refusal([&] { angleBetween<S>(x, zero); }), no_direction);
  EXPECT_EQ(refusal([&] { slerp<S>(x, zero, S(0.5)); }), no_direction);
  EXPECT_EQ(refusal([&] { rotationBetween<S>(zero, x); }), no_direction);
  for (const S bad : {std::numeric_limits<S>::infinity(), std::numeric_limits<S>::quiet_NaN()}) {
    const SO3<S> Q(Vector4<S>(S(1), bad, S(0), S(1)));
    EXPECT_TRUE(std::isnan(relativeAngle<S>(one, Q)) && std::isnan(relativeAngle<S>(Q, one))) << bad;
    EXPECT_TRUE(std::isnan(twistAngle<S>(Q, x))) << bad;
    EXPECT_TRUE(std::isnan(angleBetween<S>(x, Vector3<S>(S(0), bad, S(1))))) << bad;
  }
}

SCALAR_TEST(OffUnitRotation, OrthonormalizedRefusesMatricesWithoutPositiveDeterminant) {
  Matrix3<S> A = Matrix3<S>::Identity();
  EXPECT_EQ(orthonormalized<S>(A), A);
  A(2, 2) = S(-1);
  EXPECT_NE(refusal([&] { orthonormalized<S>(A); }), "");
  A(2, 2) = S(0);
  EXPECT_NE(refusal([&] { orthonormalized<S>(A); }), "");
  A(2, 2) = std::numeric_limits<S>::quiet_NaN();
  EXPECT_NE(refusal([&] { orthonormalized<S>(A); }), "");
}

}  // namespace
}  // namespace liecheck

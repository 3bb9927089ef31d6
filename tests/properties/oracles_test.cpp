// The oracles: agreement of their two formulas, worked examples, and planted errors. enclosure_test.cpp proves that the
// operations on SE(3) are right.

#include <gtest/gtest.h>

#include <array>
#include <boost/math/constants/constants.hpp>
#include <iostream>
#include <oracles/closed_forms.hpp>
#include <oracles/condition.hpp>
#include <oracles/error.hpp>
#include <oracles/exp.hpp>
#include <oracles/integrate.hpp>
#include <oracles/jacobians.hpp>
#include <oracles/kinematics.hpp>
#include <oracles/matrix_exponential.hpp>
#include <oracles/spatial.hpp>
#include <string>
#include <thread>
#include <vector>

#include "difference_jacobian.hpp"

namespace liecheck::oracles {
namespace {

using float128 = boost::multiprecision::float128;

/// Relative errors: the bound that the oracles promise, and the rounding error of 50 digits.
const Real promised("1e-41"), rounding("1e-49");

Real pi() {
  return boost::math::constants::pi<Real>();
}

Vec3<> vector(double x, double y, double z) {
  return {{Real(x), Real(y), Real(z)}};
}
Vec3<> along(const Vec3<>& axis, const Real& theta) {
  return Real(theta / norm(axis)) * axis;
}
Vec3<> scaled(const Vec3<>& v, const char* scale) {
  return Real(scale) * v;
}

Vec7<> somewhere() {  // |Q|^2 = 1.31
  return {{Real(0.5), Real(-2), Real(7), Real(0.3), Real(-0.4), Real(0.5), Real(0.9)}};
}

template <int N>
void expect_near(const Vec<N>& actual, const Vec<N>& expected, const Real& relative,
                 const std::string& what) {
  EXPECT_LE(norm(actual - expected), Real(relative * norm(expected))) << what;
}

// ---- numbers

TEST(OracleNumbers, ConvertEveryScalarExactlyIncludingSubnormals) {
  EXPECT_EQ(exact<Real>(0.1f), Real("0.100000001490116119384765625"));
  EXPECT_EQ(exact<Real>(0.1), Real("0.1000000000000000055511151231257827021181583404541015625"));
  const float128 tenth = float128(1) / 10;
  const Real converted = exact<Real>(tenth);
  EXPECT_EQ(converted * 10 - 1, ldexp(Real(1), -114));  // 10 times the rounding error of 1/10 in 113 bits
  EXPECT_EQ(exact<Real>(float128(ldexp(float128(1), -16494))), ldexp(Real(1), -16494));
  EXPECT_EQ(exact<Real>(std::numeric_limits<double>::denorm_min()), ldexp(Real(1), -1074));
  EXPECT_EQ(exact<Real>(float128(-ldexp(float128(2) - ldexp(float128(1), -112), 16383))),
            -ldexp(1 - ldexp(Real(1), -113), 16384));
  EXPECT_TRUE(isnan(exact<Real>(std::numeric_limits<float128>::quiet_NaN())));
  EXPECT_TRUE(isinf(exact<Real>(-std::numeric_limits<float128>::infinity())));
}

TEST(OracleAgreement, RefusesAWrongDigitAtTheFortiethPlace) {
  Vec3<> v = vector(1, -2, 3);
  EXPECT_TRUE(agree(v, v));
  Vec3<> wrong = v;
  wrong[1] += Real("1e-40") * norm(v);
  EXPECT_FALSE(agree(wrong, v));
  wrong[1] = v[1] + Real("1e-43");
  EXPECT_TRUE(agree(wrong, v));
  const Vec3<> tiny = scaled(v, "1e-310");
  EXPECT_FALSE(agree(Real(1 + Real("1e-40")) * tiny, tiny));  // relative, also for subnormal doubles
}

TEST(OracleAgreement, RefusesNotANumber) {
  Vec3<> v = vector(1, -2, 3);
  v[2] = std::numeric_limits<Real>::quiet_NaN();
  EXPECT_FALSE(agree(v, v));
  EXPECT_FALSE(exp_se3(stack(v, vector(1, 2, 3))).resolved);
  EXPECT_FALSE(exp_se3(stack(vector(1, 2, 3), v)).resolved);
  EXPECT_FALSE(log_se3({{v[0], v[1], v[2], Real(1)}}, v).resolved);
  EXPECT_FALSE(log_so3({{Real(0), Real(0), Real(0), Real(0)}}).resolved);  // a zero quaternion has no log
}

TEST(OracleAgreement, RunsTheSecondFormulaAgainAtAHundredDigitsBeforeItGivesUp) {
  int fifty = 0, hundred = 0;
  const auto check = [&]<class T>(T) {
    (std::is_same_v<T, Real> ? fifty : hundred) += 1;
    return std::is_same_v<T, Real100>;
  };
  EXPECT_TRUE(confirmed(true, check));
  EXPECT_EQ(fifty, 1);
  EXPECT_EQ(hundred, 1);
  EXPECT_FALSE(confirmed(true, []<class T>(T) { return false; }));
}

TEST(LogOracle, RefusesAReflection) {
  Mat3<> R = identity<3, Real>();
  R(2, 2) = -1;
  EXPECT_FALSE(log_se3_matrix(R, zero_vector<3, Real>()).resolved);
  EXPECT_FALSE(log_se3_matrix(zeros<3, 3, Real>(), zero_vector<3, Real>()).resolved);
}

TEST(DifferenceOracle, OfNearPosesInFloat128IsResolved) {
  Vec<7, float128> a{{float128(1) / 3, float128(2) / 7, float128(-5) / 9, float128(1) / 2, float128(1) / 2,
                      float128(1) / 2, float128(1) / 2}};
  Vec<7, float128> b = a;
  b[3] += std::numeric_limits<float128>::epsilon() / 2;
  b[0] += std::numeric_limits<float128>::epsilon() / 4;
  const DifferenceResult d = difference(exact_vector<7>(a), exact_vector<7>(b));
  EXPECT_TRUE(d.resolved);
  // With x y z w of Q0: Q0* Q1 has the vector part e (w, -z, y) and the scalar part 1 + e x.
  const Real e = ldexp(Real(1), -113);
  const Real tangent = sqrt(Real(3)) * e / 2 / (1 + e / 2);
  EXPECT_LE(abs(d.theta / (2 * atan(tangent)) - 1), promised);
}

TEST(DerivativeOracle, OfDifferenceAtThetaEqualToPiIsThatOfTheGivenBranch) {
  const Vec7<> q0{{Real(0), Real(0), Real(0), Real(0), Real(0), Real(0), Real(1)}};
  const Vec7<> q1{{Real(1), Real(2), Real(3), Real(0.6), Real(0), Real(0.8), Real(0)}};
  const LogResult l = difference(q0, q1);
  ASSERT_TRUE(l.at_pi);
  const Jacobian6Result a = d_difference_arg1(q0, q1), b = d_difference_arg1(q0, q1, Branch::other);
  EXPECT_TRUE(a.resolved && b.resolved);
  EXPECT_LE(norm(a.matrix() - right_jacobian_se3_inverse(l.value()).matrix()), promised);
  EXPECT_LE(norm(b.matrix() - right_jacobian_se3_inverse(l.other).matrix()), promised);
  const Jacobian6Result c = d_difference_arg0(q0, q1, Branch::other);
  EXPECT_LE(norm(c.matrix() + left_jacobian_se3_inverse(l.other).matrix()), promised);
}

// ---- spatial algebra

TEST(SpatialOracle, AZeroPowerWrenchHasZeroPowerInBothFrames) {
  const Pose X_AB{identity<3, Real>(), vector(1, 0, 0)};
  const Vec6<> F_B = stack(vector(0, 10, 0), vector(0, 0, 0)), V_B = stack(vector(0, 0, 0), vector(0, 0, 2));
  const SpatialResult F_A = act_force(X_AB, F_B), V_A = act_motion(X_AB, V_B);
  EXPECT_TRUE(F_A.resolved && V_A.resolved);
  EXPECT_EQ(norm(F_A.value - stack(vector(0, 10, 0), vector(0, 0, 10))), 0);
  EXPECT_EQ(norm(V_A.value - stack(vector(0, -2, 0), vector(0, 0, 2))), 0);
  const ScalarResult P_A = power(F_A.value, V_A.value), P_B = power(F_B, V_B);
  EXPECT_TRUE(P_A.resolved && P_B.resolved);
  EXPECT_EQ(P_A.value, 0);
  EXPECT_EQ(P_B.value, 0);
}

Body two_kilograms() {
  Body I{Real(2), vector(0.3, 0, 0), zeros<3, 3, Real>()};
  I.c[0] = Real("0.3");
  I.I_C(0, 0) = Real("0.02");
  I.I_C(1, 1) = Real("0.05");
  I.I_C(2, 2) = Real("0.06");
  return I;
}

TEST(SpatialOracle, AWorkedExampleHasItsInertiaEnergyAndMomentum) {
  const Body I = two_kilograms();
  const Matrix6Result M = inertia_matrix(I);
  EXPECT_TRUE(M.resolved);
  const std::array<Real, 3> I_O{Real("0.02"), Real("0.23"), Real("0.24")};
  for (int i = 0; i < 3; ++i)
    EXPECT_LE(abs(M.value(3 + i, 3 + i) - I_O[static_cast<std::size_t>(i)]), rounding);
  const Vec6<> V = stack(vector(0, 0, 0), vector(0, 0, 2));
  const ScalarResult E = kinetic_energy(I, V);
  EXPECT_TRUE(E.resolved);
  EXPECT_LE(abs(E.value - Real("0.48")), rounding);
  const SpatialResult h = momentum(I, V);
  EXPECT_TRUE(h.resolved);
  EXPECT_LE(norm(h.value - Vec6<>{{Real(0), Real("1.2"), Real(0), Real(0), Real(0), Real("0.48")}}),
            rounding);
}

TEST(SpatialOracle, EveryOperationIsResolvedAndInvertedByItsInverse) {
  const ExpResult e = exp_se3(stack(vector(3, -1, 2), vector(0.3, -0.5, 0.8)));
  Pose X{e.R, e.p};
  for (Real& x : X.R.x) x = Real(static_cast<double>(x));  // rounded: orthogonal to 1e-16
  const Vec6<> V = stack(vector(0.1, 2, -3), vector(1, 1, 0.5)),
               F = stack(vector(5, -1, 2), vector(0.2, 7, 3));
  const Real nearly("1e-15");
  const auto inverted = [&](const SpatialResult& there, const SpatialResult& back, const Vec6<>& v) {
    EXPECT_TRUE(there.resolved && back.resolved);
    expect_near(back.value, v, nearly, "back");
  };
  inverted(act_motion(X, V), act_inverse_motion(X, act_motion(X, V).value), V);
  inverted(act_force(X, F), act_inverse_force(X, act_force(X, F).value), F);
  const PointResult x = act_point(X, vector(1, 2, 3)), y = act_inverse_point(X, x.value);
  EXPECT_TRUE(x.resolved && y.resolved);
  expect_near(y.value, vector(1, 2, 3), nearly, "point");
  EXPECT_TRUE(rotate_point(e.Q, vector(1, 2, 3)).resolved);
  const BodyResult I = act_inertia(X, two_kilograms()), J = act_inverse_inertia(X, I.value);
  EXPECT_TRUE(I.resolved && J.resolved);
  expect_near(J.value.c, two_kilograms().c, Real("1e-14"), "centre of mass");
  EXPECT_LE(norm(J.value.I_C - two_kilograms().I_C), nearly);
  EXPECT_TRUE(cross_motion(V, F).resolved);
  EXPECT_TRUE(cross_force(V, F).resolved);
  EXPECT_EQ(norm(cross_motion(V, V).value), 0);
  // ad*_V F paired with W is - F paired with ad_V W
  const Vec6<> W = stack(vector(1, 2, 3), vector(-2, 5, 1));
  EXPECT_LE(abs(power(cross_force(V, F).value, W).value + power(F, cross_motion(V, W).value).value),
            Real("1e-46"));
}

// ---- kinematics

TEST(KinematicsOracle, RatesAgreeWithDifferencesAtEveryScale) {
  for (const char* scale : {"1e-300", "1e-20", "1", "1e20", "1e300"})
    for (const char* ratio : {"1e-200", "1", "1e200"}) {
      const Vec6<> v =
          stack(scaled(vector(1, 2, -3), scale), Real(Real(scale) * Real(ratio)) * vector(1, 0, 2));
      EXPECT_TRUE(configuration_rate(somewhere(), v).resolved) << scale << " " << ratio;
    }
  EXPECT_TRUE(configuration_rate(somewhere(), zero_vector<6, Real>()).resolved);
}

TEST(KinematicsOracle, CoefficientJacobianTimesVelocityIsTheRate) {
  const CoefficientJacobianResult J = integrate_coefficient_jacobian(somewhere());
  EXPECT_TRUE(J.resolved);
  const Vec6<> v{{Real(1), Real(-2), Real(3), Real(0.5), Real(0.25), Real(-1)}};
  const RateResult r = configuration_rate(somewhere(), v);
  const Vec7<> rate = J.value * v;
  expect_near(head3(rate), r.p_dot, rounding, "p");
  expect_near(Quaternion<>{{rate[3], rate[4], rate[5], rate[6]}}, r.Q_dot, rounding, "Q");
}

// ---- condition and error

TEST(ConditionOracle, OfADifferenceOfNearNumbersIsTheCancellation) {
  const FunctionOf<Real> subtract = [](const std::vector<Real>& x) {
    return std::vector<Real>{x[0] - x[1], x[0] * x[1]};
  };
  const std::vector<Real> x{Real(1), Real(1) - Real(1e-6)};
  const std::vector<Real> moved = movements(subtract, x, {{0, 1}, {1, 1}}), y = subtract(x);
  EXPECT_NEAR(condition_number(moved[0], y[0]) / 2e6, 1, 1e-3);
  EXPECT_NEAR(condition_number(moved[1], y[1]), 2, 1e-9);
}

TEST(ConditionOracle, OfExpNearTwoPiGrowsAsTheInverseOfTheDistance) {
  const FunctionOf<Real> p_of_exp = [](const std::vector<Real>& x) {
    const UnitPose<Real> pose = closed_exp(Vec6<>{{x[0], x[1], x[2], x[3], x[4], x[5]}});
    return std::vector<Real>(pose.p.x.begin(), pose.p.x.end());
  };
  const std::vector<Real> xi{Real(1), Real(0), Real(0), Real(0), Real(0), 2 * pi() + Real("1e-10")};
  const std::vector<Real> p = p_of_exp(xi);
  const double kappa =
      condition_number(movements(p_of_exp, xi, {{0, 3}})[0], norm(Vec3<>{{p[0], p[1], p[2]}}));
  EXPECT_NEAR(kappa * 1e-10 / 6.283185307, 1, 1e-3);  // (dp/dtheta) theta / p = theta / distance
}

TEST(ConditionOracle, IgnoresAnInputThatIsZero) {
  const FunctionOf<Real> sum = [](const std::vector<Real>& x) { return std::vector<Real>{x[0] + x[1]}; };
  EXPECT_NEAR(condition_number(movements<Real>(sum, {Real(0), Real(3)}, {{0, 1}})[0], Real(3)), 1, 1e-9);
}

TEST(ErrorMeasure, OfAQuaternionTakesTheNearerSignAndIgnoresTheNorm) {
  const Quaternion<> Q = exp_so3(vector(0.1, 0.2, 0.3)).Q;
  EXPECT_LE(rotation_error(scalar_of<double>, Q, Q), 1e-30);
  EXPECT_LE(rotation_error(scalar_of<double>, Real(-1.01) * Q, Q), 1e-30);
  const double eps = std::numeric_limits<double>::epsilon();
  const Quaternion<> turned = quaternion_product(Q, exp_so3(along(vector(1, 2, 3), Real(5 * eps))).Q);
  EXPECT_NEAR(rotation_error(scalar_of<double>, turned, Q), 5, 1e-9);
  EXPECT_NEAR(norm_defect(scalar_of<double>, Real(1 + Real(eps)) * Q), 2, 1e-9);
}

TEST(ErrorMeasure, OfARotationMatrixIsTheAngleOfItsPolarFactorOnly) {
  const ExpResult e = exp_so3(vector(0.1, 0.2, 0.3));
  const double eps = std::numeric_limits<double>::epsilon();
  const Mat3<> turned = e.R * exp_so3(along(vector(1, 2, 3), Real(5 * eps))).R;
  const Mat3<> stretched = Real(1 + Real(1e-9)) * turned;
  EXPECT_NEAR(rotation_error(scalar_of<double>, stretched, e.Q), 5, 1e-9);
  EXPECT_NEAR(orthogonality_defect(scalar_of<double>, stretched) * eps, 2e-9 * std::sqrt(3.0), 1e-17);
  EXPECT_LE(rotation_error(scalar_of<double>, e.R, e.Q), 1e-30);
}

TEST(ErrorMeasure, IsInfiniteForNotANumberAndTheLargestForWhatIsNoRotation) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(vector_error(scalar_of<double>, vector(nan, 0, 0), vector(1, 0, 0)), infinity);
  EXPECT_EQ(rotation_error(scalar_of<double>, Quaternion<>{{Real(nan), Real(0), Real(0), Real(1)}},
                           exp_so3(vector(0, 0, 0)).Q),
            infinity);
  Mat3<> R = identity<3, Real>();
  R(0, 0) = -1;
  const double half_turn = 2 * std::sqrt(2.0) / std::numeric_limits<double>::epsilon();
  EXPECT_DOUBLE_EQ(rotation_error(scalar_of<double>, R, exp_so3(vector(0, 0, 0)).Q), half_turn);
  EXPECT_DOUBLE_EQ(rotation_error(scalar_of<double>, Quaternion<>{}, exp_so3(vector(0, 0, 0)).Q), half_turn);
  R(0, 0) = Real(nan);
  EXPECT_EQ(rotation_error(scalar_of<double>, R, exp_so3(vector(0, 0, 0)).Q), infinity);
  EXPECT_FALSE(all_finite(std::array<double, 2>{1, nan}));
  EXPECT_FALSE(all_finite(std::array<float128, 1>{std::numeric_limits<float128>::infinity()}));
  EXPECT_TRUE(all_finite(std::array<float, 2>{1, 2}));
}

TEST(ErrorMeasure, OfAVectorIsRelativeDownToTheSmallestDenominator) {
  const Vec3<> y = vector(1, 2, 2);
  EXPECT_NEAR(
      vector_error(scalar_of<double>, Real(1 + Real(7 * std::numeric_limits<double>::epsilon())) * y, y), 7,
      1e-9);
  EXPECT_NEAR(vector_error(scalar_of<double>, vector(1, 2, 2 + 3e-16), y, Real(30)) *
                  std::numeric_limits<double>::epsilon(),
              static_cast<double>(exact<Real>(2 + 3e-16) - 2) / 30, 1e-20);
  // a result of 0 in place of the smallest subnormal number errs by 1 eps
  const double underflowed = vector_error(scalar_of<double>, vector(0, 0, 0), vector(5e-324, 0, 0));
  EXPECT_LE(underflowed, 1.0001);
  EXPECT_GT(underflowed, 0);
}

TEST(ErrorMeasure, OfALogAtThetaEqualToPiTakesTheNearerAxis) {
  const LogResult l = log_se3({{Real(0.6), Real(0), Real(0.8), Real(0)}}, vector(1, 2, 3));
  const TwistError a = log_error(scalar_of<double>, l.value(), l),
                   b = log_error(scalar_of<double>, l.other, l);
  EXPECT_LE(a.angular + a.linear + b.angular + b.linear, 1e-20);
}

// ---- the scalar as a value

[[gnu::noinline]] void round_each(const Scalar& scalar, double* x) {
  for (int i = 0; i < 3; ++i) x[i] = scalar.rounded(x[i]);
}
[[gnu::noinline]] void round_each_to_float(double* x) {
  for (int i = 0; i < 3; ++i) x[i] = rounded_to_float(x[i]);
}

TEST(Scalar, RoundsNeighboursEachByItself) {
  double x[] = {0.1, 0.2, 0.3}, y[] = {0.1, 0.2, 0.3};
  round_each(scalar_of<float>, x);
  round_each_to_float(y);
  const double expected[] = {0.1f, 0.2f, 0.3f};
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(x[i], expected[i]) << i;
    EXPECT_EQ(y[i], expected[i]) << i;
  }
}

// ---- threads

TEST(Oracles, GiveTheSameBitsOnEveryThread) {
  const auto run = [] {
    const Vec6<> xi = stack(vector(1, 2, 3), vector(0.4, 0.5, 3));
    const Jacobian6Result J = right_jacobian_fd(xi);
    const ExpResult e = exp_se3(xi);
    return std::pair{J.C, log_se3(e.Q, e.p).value()};
  };
  const auto expected = run();
  std::array<std::pair<Mat3<>, Vec6<>>, 4> results;
  std::vector<std::thread> threads;
  for (auto& result : results) threads.emplace_back([&] { result = run(); });
  for (std::thread& t : threads) t.join();
  for (const auto& result : results) {
    EXPECT_EQ(result.first.x, expected.first.x);
    EXPECT_EQ(result.second.x, expected.second.x);
  }
}

}  // namespace
}  // namespace liecheck::oracles

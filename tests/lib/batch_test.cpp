// batch/poses.hpp: compares operations on many poses at once with the same operations on single poses, in
// every set of instructions that the processor has.

#include <gtest/gtest.h>
#include <cstring>
#include <liecheck/batch/poses.hpp>
#include <liecheck/multibody/se3_configuration.hpp>
#include <random>

#include "../refusal.hpp"
#include "scalar_test.hpp"

namespace liecheck {
namespace {

using batch::Instructions;

std::vector<Instructions> supported() {
  std::vector<Instructions> all;
  for (const auto i : {Instructions::baseline, Instructions::avx2, Instructions::avx512})
    if (batch::supported(i)) all.push_back(i);
  return all;
}

SCALAR_SUITE(BatchOf, float, double);

template <class S>
struct Inputs {
  batch::Rows<S, 7> q, near;
  batch::Rows<S, 6> delta;
  explicit Inputs(int n) : q(7, n), near(7, n), delta(6, n) {
    std::mt19937 random(n + 1);
    std::normal_distribution<double> normal;
    using Limits = std::numeric_limits<S>;
    const S special[] = {S(0),
                         S(1e-30),
                         S(1e-6),
                         S(1),
                         pi<S>(),
                         S(4),
                         S(1e10),
                         Limits::infinity(),
                         Limits::quiet_NaN(),
                         Limits::max()};
    for (int i = 0; i < n; ++i) {
      Vector7<S> a;
      Vector6<S> d;
      for (int k = 0; k < 7; ++k) a[k] = S(normal(random));
      for (int k = 0; k < 6; ++k) d[k] = S(normal(random));
      if (i % 3 == 1) d[3] = special[random() % 10], d[4] = d[5] = S(0);
      if (i % 7 == 2) d[0] = special[random() % 10];
      a.template tail<4>() /= a.template tail<4>().norm();
      q.col(i) = a, delta.col(i) = d;
      const double close = std::pow(10., -int(random() % 20));
      near.col(i) = integrateSE3<S>(a, i % 2 == 0 ? d : Vector6<S>(d * S(close)));
      if (i % 5 == 3) near.col(i) = a;
      if (i % 11 == 4)
        near(3, i) = -q(6, i), near(6, i) = q(3, i), near(4, i) = q(5, i), near(5, i) = -q(4, i);
    }
  }
};

/// The largest difference of two vectors relative to their size, in eps; NaN agrees with NaN.
template <class A, class B>
double apart(const A& a, const B& b) {
  using S = typename A::Scalar;
  double size = 0, most = 0;
  for (int i = 0; i < a.size(); ++i)
    if (std::isfinite(double(b[i]))) size = std::max(size, std::abs(double(b[i])));
  for (int i = 0; i < a.size(); ++i) {
    if (a[i] == b[i] || (std::isnan(a[i]) && std::isnan(b[i]))) continue;
    const double error = std::abs(double(a[i]) - double(b[i])) / size / double(eps<S>());
    most = error <= most ? most : error;
    if (std::isnan(error)) return error;
  }
  return most;
}
/// The twelve rows of a pose, and the 36 of a matrix.
template <class S>
Eigen::Array<S, 12, 1> rowsOf(const SE3<S>& X) {
  Eigen::Array<S, 12, 1> rows;
  for (int i = 0; i < 12; ++i) rows[i] = i < 9 ? X.rotation()(i / 3, i % 3) : X.translation()[i - 9];
  return rows;
}
template <class S>
SE3<S> poseOf(const Eigen::Array<S, 12, 1>& r) {
  return SE3<S>(rows<S>(r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8]),
                Vector3<S>(r[9], r[10], r[11]));
}
/// The largest difference of two Jacobians in a 3 x 3 block, relative to that block.
template <class S, class Column>
double apart(const Column& column, const Matrix6<S>& J) {
  double most = 0;
  for (const auto& [row, col] : {std::pair(0, 0), {0, 3}, {3, 0}, {3, 3}}) {
    Eigen::Array<S, 9, 1> a, b;
    for (int i = 0; i < 9; ++i)
      a[i] = column[6 * (row + i / 3) + col + i % 3], b[i] = J(row + i / 3, col + i % 3);
    const double error = apart(a, b);
    if (!(error <= most)) most = error;
  }
  return most;
}

SCALAR_TEST(BatchOf, AgreesWithSinglePosesForEverySizeAndSpecialValue) {
  for (const Instructions instructions : supported())
    for (const int n : {0, 1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 33, 1000}) {
      const batch::Options o{1, instructions};
      const Inputs<S> in(n);
      const auto integrated = batch::integrate<S>(in.q, in.delta, o),
                 exponential = batch::exp6<S>(in.delta, o);
      const auto difference = batch::difference<S>(in.q, in.near, o), logarithm = batch::log6<S>(in.near, o);
      const batch::Rows<S, 3> points = in.delta.template topRows<3>();
      const auto moved = batch::act<S>(in.q, points, o);
      const auto X = batch::exp6Matrix<S>(in.delta, o), XX = batch::compose<S>(X, X, o);
      const auto X_points = batch::act<S>(X, points, o);
      const auto J = batch::Jexp6<S>(in.delta, o), inverse = batch::rightJacobianInverse<S>(in.delta, o),
                 Jlog = batch::Jlog6<S>(in.near, o);
      ASSERT_EQ(integrated.cols(), n);
      for (int i = 0; i < n; ++i) {
        const Vector7<S> q = in.q.col(i), near = in.near.col(i);
        const Vector6<S> d = in.delta.col(i);
        const Vector3<S> x = points.col(i);
        const Vector3<S> y = q.template head<3>() + SO3<S>(Vector4<S>(q.template tail<4>())).act(x);
        EXPECT_LE(apart(integrated.col(i), integrateSE3<S>(q, d)), 4) << d.transpose();
        EXPECT_LE(apart(exponential.col(i), quaternion::exp6<S>(Motion<S>(d))), 4) << d.transpose();
        const Vector6<S> single = differenceSE3<S>(q, near), many = difference.col(i);
        EXPECT_LE(apart(many, single), 4) << q.transpose() << " " << near.transpose();
        EXPECT_LE(apart(Vector3<S>(many.template tail<3>()), Vector3<S>(single.template tail<3>())), 4)
            << q.transpose() << " " << near.transpose();
        EXPECT_LE(apart(logarithm.col(i), quaternion::log6<S>(near).to_vector()), 4) << near.transpose();
        EXPECT_LE(apart(moved.col(i), y), 4) << x.transpose();
        EXPECT_LE(apart(X.col(i), rowsOf(exp6<S>(Motion<S>(d)))), 4) << d.transpose();
        const SE3<S> X_i = poseOf<S>(X.col(i));
        EXPECT_LE(apart(XX.col(i), rowsOf(X_i * X_i)), 4) << d.transpose();
        EXPECT_LE(apart(X_points.col(i), X_i.act(x)), 4) << x.transpose();
        EXPECT_LE(apart<S>(J.col(i), Jexp6<S>(Motion<S>(d))), 8) << d.transpose();
        EXPECT_LE(apart<S>(inverse.col(i), rightJacobianInverse<S>(Motion<S>(d))), 8) << d.transpose();
        EXPECT_LE(apart<S>(Jlog.col(i), rightJacobianInverse<S>(quaternion::log6<S>(near))), 8)
            << near.transpose();
      }
    }
}

/// NaN agrees with NaN, whose sign no instruction defines.
template <class A>
bool sameBits(const A& a, const A& b) {
  bool same = a.cols() == b.cols();
  for (Eigen::Index i = 0; same && i < a.size(); ++i)
    same = std::memcmp(a.data() + i, b.data() + i, sizeof(*a.data())) == 0 ||
           (std::isnan(a.data()[i]) && std::isnan(b.data()[i]));
  return same;
}

SCALAR_TEST(BatchOf, BitsDependOnNeitherInstructionsNorThreadsNorNeighbours) {
  const int n = 20001;
  const Inputs<S> in(n);
  for (const Instructions i : supported()) {
    const batch::Options one{1, i}, many{3, i};
    const auto q = batch::integrate<S>(in.q, in.delta, one);
    const auto delta = batch::difference<S>(in.q, in.near, one);
    const auto J = batch::Jexp6<S>(in.delta, one);
    EXPECT_TRUE(sameBits(q, batch::integrate<S>(in.q, in.delta, many)));
    EXPECT_TRUE(sameBits(delta, batch::difference<S>(in.q, in.near, many)));
    for (int k = 0; k < 50; ++k) {
      const batch::Rows<S, 7> q0 = in.q.middleCols(k, 101), q1 = in.near.middleCols(k, 101);
      const batch::Rows<S, 6> part = delta.middleCols(k, 101);
      EXPECT_TRUE(sameBits(part, batch::difference<S>(q0, q1, one)));
    }
    const batch::Options baseline{1, Instructions::baseline};
    EXPECT_TRUE(sameBits(q, batch::integrate<S>(in.q, in.delta, baseline)));
    EXPECT_TRUE(sameBits(delta, batch::difference<S>(in.q, in.near, baseline)));
    EXPECT_TRUE(sameBits(J, batch::Jexp6<S>(in.delta, baseline)));
    EXPECT_TRUE(sameBits(batch::exp6<S>(in.delta, one), batch::exp6<S>(in.delta, baseline)));
    EXPECT_TRUE(sameBits(batch::log6<S>(in.near, one), batch::log6<S>(in.near, baseline)));
    EXPECT_TRUE(sameBits(batch::Jlog6<S>(in.near, one), batch::Jlog6<S>(in.near, baseline)));
  }
}

SCALAR_TEST(BatchOf, MemoryOfAResultIsUsedAgain) {
  const Inputs<S> in(100);
  auto result = batch::integrate<S>(in.q, in.delta);
  const auto expected = result;
  const S* const memory = result.data();
  result = batch::integrate<S>(in.q, in.delta, {}, std::move(result));
  EXPECT_EQ(result.data(), memory);
  EXPECT_TRUE(sameBits(result, expected));
}

SCALAR_TEST(BatchOf, BadInputIsRefused) {
  const Inputs<S> in(9000);
  const batch::Rows<S, 6> fewer = in.delta.leftCols(8999);
  EXPECT_EQ(test::refusal([&] { batch::integrate<S>(in.q, fewer); }),
            "the arguments of a batch have different numbers of columns");
  batch::Rows<S, 7> q = in.q;
  q.col(8000).template tail<4>().setZero();
  for (const int threads : {1, 2})
    EXPECT_EQ(test::refusal([&] { batch::integrate<S>(q, in.delta, {threads}); }),
              "a zero quaternion is not a rotation");
  if (!batch::supported(Instructions::avx512)) {
    EXPECT_THROW(batch::exp6<S>(in.delta, {1, Instructions::avx512}), std::invalid_argument);
  }
}

}  // namespace
}  // namespace liecheck

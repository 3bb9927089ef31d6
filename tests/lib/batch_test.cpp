// multibody/batch.hpp: compares operations on many poses at once with the same operations on single poses.

#include <gtest/gtest.h>
#include <liecheck/multibody/batch.hpp>
#include <random>

namespace liecheck {
namespace {

template <class S>
class BatchOf : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(BatchOf, Scalars);

template <class S>
struct Inputs {
  batch::Rows<S, 7> q, near;
  batch::Rows<S, 6> delta;
  explicit Inputs(int n) : q(7, n), near(7, n), delta(6, n) {
    std::mt19937 random(n + 1);
    std::normal_distribution<double> normal;
    const S special[] = {S(0),
                         S(1e-30),
                         S(1e-6),
                         S(1),
                         pi<S>(),
                         S(4),
                         S(1e10),
                         std::numeric_limits<S>::infinity(),
                         std::numeric_limits<S>::quiet_NaN(),
                         std::numeric_limits<S>::max()};
    for (int i = 0; i < n; ++i) {
      Vector7<S> a;
      Vector6<S> d;
      for (int k = 0; k < 7; ++k) a[k] = S(normal(random));
      for (int k = 0; k < 6; ++k) d[k] = S(normal(random));
      if (i % 3 == 1) d[3] = special[random() % 10], d[4] = d[5] = S(0);
      if (i % 7 == 2) d[0] = special[random() % 10];
      a.template tail<4>() /= a.template tail<4>().norm();
      q.col(i) = a, delta.col(i) = d;
      near.col(i) = integrateSE3<S>(a, i % 2 == 0 ? d : Vector6<S>(d * S(1e-7)));
      if (i % 5 == 3) near.col(i) = a;
      if (i % 11 == 4)
        near(3, i) = -q(6, i), near(6, i) = q(3, i), near(4, i) = q(5, i), near(5, i) = -q(4, i);
    }
  }
};

/// The largest difference of two columns relative to their size, in eps; NaN agrees with NaN.
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

TYPED_TEST(BatchOf, AgreesWithSinglePosesForEverySizeAndSpecialValue) {
  using S = TypeParam;
  for (const int n : {0, 1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 1000}) {
    const Inputs<S> in(n);
    const auto integrated = batch::integrate<S>(in.q, in.delta), exponential = batch::exp6<S>(in.delta);
    const auto difference = batch::difference<S>(in.q, in.near), logarithm = batch::log6<S>(in.near);
    const batch::Rows<S, 3> points = in.delta.template topRows<3>();
    const auto moved = batch::act<S>(in.q, points);
    ASSERT_EQ(integrated.cols(), n);
    for (int i = 0; i < n; ++i) {
      const Vector7<S> q = in.q.col(i), near = in.near.col(i);
      const Vector6<S> d = in.delta.col(i);
      const Vector3<S> x = points.col(i);
      const Vector3<S> y = q.template head<3>() + SO3<S>(Vector4<S>(q.template tail<4>())).act(x);
      EXPECT_LE(apart(integrated.col(i), integrateSE3<S>(q, d)), 4) << d.transpose();
      EXPECT_LE(apart(exponential.col(i), quaternion::exp6<S>(Motion<S>(d))), 4) << d.transpose();
      EXPECT_LE(apart(difference.col(i), differenceSE3<S>(q, near)), 4)
          << q.transpose() << " " << near.transpose();
      EXPECT_LE(apart(logarithm.col(i), quaternion::log6<S>(near).to_vector()), 4) << near.transpose();
      EXPECT_LE(apart(moved.col(i), y), 4) << x.transpose();
    }
  }
}

}  // namespace
}  // namespace liecheck

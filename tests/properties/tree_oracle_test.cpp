// oracles/tree_sizes.hpp is an upper bound of oracles/tree.hpp, and its balls hold the exact values. Other formulas
// for its results: the laws of trees, and the subjects correct:lagrange and correct:kane of the laboratory.

#include <gtest/gtest.h>

#include <algorithm>
#include <generators/coverage.hpp>
#include <generators/tree_shrinks.hpp>
#include <invariants/tree_law.hpp>

namespace {

using namespace liecheck::properties;
using namespace liecheck::oracles;
using T = Real100;
using Numbers = std::vector<T>;

TEST(TreeOracle, NoResultIsLargerThanTheSizesOfItsTerms) {
  for (std::uint64_t index = 0; index < 200; ++index) {
    Source source(Source::Key{4, 5, 6, index});
    const std::vector<double> x = random_tree<double>(source, false);
    const TreeLayout layout = TreeLayout::of_size(x.size());
    const TreeCase<T> c(layout, x, std::vector<T>(x.begin(), x.end()));
    const TreeCase<double> rough(layout, x, x);
    const TreeSizes<double> sizes(rough.tree, rough.q, rough.v, rough.a, rough.wrench);
    const std::vector<double> none(c.v.size(), 0);
    const TreeSizes<Tangent> by_q(rough.tree, rough.q, rough.v, rough.a, rough.wrench, rough.d, none),
        by_v(rough.tree, rough.q, rough.v, rough.a, rough.wrench, none, rough.d);
    const Numbers still(c.v.size(), T(0));
    const Numbers tau = TreeDynamics<T>(c.tree, c.q, c.v, c.a).torque(c.wrench),
                  M = TreeDynamics<T>(c.tree, c.q, c.v, c.a).mass(),
                  dq = TreeDynamics<T>(c.tree, c.q, c.v, c.a, c.d, still, still).torque_derivative(c.wrench),
                  dv = TreeDynamics<T>(c.tree, c.q, c.v, c.a, still, c.d, still).torque_derivative(c.wrench);
    const double slack = 1 + 1e-9;
    for (std::size_t k = 0; k < tau.size(); ++k) {
      EXPECT_LE(static_cast<double>(abs(tau[k])), sizes.tau[k] * slack + 1e-80) << index;
      EXPECT_LE(static_cast<double>(abs(dq[k])), by_q.tau[k].d * slack + 1e-80) << index;
      EXPECT_LE(static_cast<double>(abs(dv[k])), by_v.tau[k].d * slack + 1e-80) << index;
    }
    for (std::size_t k = 0; k < M.size(); ++k)
      EXPECT_LE(static_cast<double>(abs(M[k])), sizes.mass[k] * slack + 1e-80) << index;
    const T kinetic = TreeDynamics<T>(c.tree, c.q, c.v, c.a).kinetic_energy();
    EXPECT_LE(static_cast<double>(kinetic), sizes.kinetic * slack) << index;
  }
}

/// Everything that the oracle computes of a case in the direction d, in one list.
template <class N>
std::vector<N> everything(const TreeCase<N>& c) {
  const std::vector<N> still(c.v.size(), N(0));
  const TreeDynamics<N> d(c.tree, c.q, c.v, c.a, c.d, c.a, c.v);
  const FrameMotion<N> frame(d.motion(), d.motion().X.size() - 1, c.frame_Q, c.frame_p);
  std::vector<N> all = d.torque(c.wrench);
  const auto add = [&](const auto& more) { all.insert(all.end(), more.begin(), more.end()); };
  add(d.torque_derivative(c.wrench)), add(d.mass());
  if (const Solver<N> solve(d.mass(), c.v.size()); solve) add(solve(d.torque()));
  add(TreeDynamics<N>(c.tree, c.q, c.v, still, still, c.d, still).torque_derivative());
  add(TreeDynamics<N>(c.tree, c.q, still, still).torque());
  for (const auto& v : {frame.p, frame.p1, frame.p2, frame.w, frame.w1}) add(v.x);
  add(d.momentum().x), add(d.momentum_rate().x);
  add(std::vector<N>{d.kinetic_energy(), d.potential_energy(), d.energy_rate()});
  return all;
}

TEST(TreeOracle, BallsHoldTheExactValues) {
  for (std::uint64_t index = 0; index < 60; ++index) {
    Source source(Source::Key{10, 11, 12, index});
    const std::vector<double> x = random_tree<double>(source, index % 2 == 0);
    const TreeLayout at = TreeLayout::of_size(x.size());
    const std::vector<T> exact = everything(TreeCase<T>(at, x, exact_list<T>(x)));
    const auto balls = everything(TreeCase<DoubleDoubleBall>(at, x, exact_list<DoubleDoubleBall>(x)));
    ASSERT_EQ(balls.size(), exact.size());
    T size(1);  // a ball may be exact; the value at 100 digits is rounded
    for (const T& e : exact) size = larger<T>(size, T(abs(e)));
    for (std::size_t k = 0; k < balls.size(); ++k)
      EXPECT_LE(abs(exact[k] - liecheck::oracles::exact<T>(balls[k])), T(balls[k].r) + size * T(1e-90))
          << index << " " << k;
  }
}

TEST(TreeOracle, ADistantBaseDoesNotWidenTheBallsOfItsDynamics) {
  using B = DoubleDoubleBall;
  for (std::uint64_t index = 0; index < 20; ++index) {
    Source source(Source::Key{13, 14, 15, index});
    const std::vector<double> x = random_tree<double>(source, true);
    TreeCase<B> c(TreeLayout::of_size(x.size()), x, exact_list<B>(x));
    const auto radius = [&](double distance) {
      for (std::size_t k = 0; k < 3; ++k) c.q[k] = B(distance / 3);
      const std::vector<B> still(c.v.size(), B(0));
      const TreeDynamics<B> d(c.tree, c.q, c.v, c.a, c.d, still, still);
      double sum = 0;
      for (const auto& part : {d.torque(c.wrench), d.torque_derivative(c.wrench), d.mass()})
        for (const B& b : part) sum += b.r;
      return sum;
    };
    EXPECT_LE(radius(1e7), radius(0) * (1 + 1e-9)) << index;
  }
}

// A_kl = min(k, l): the factor L is full of ones, so that each row of the elimination doubles the radii.
TEST(TreeOracle, TheBallsOfASolutionDoNotGrowWithTheNumberOfRows) {
  using B = DoubleDoubleBall;
  const std::size_t n = 35;
  std::vector<B> A, b;
  for (std::size_t i = 0; i < n * n; ++i)
    A.emplace_back(static_cast<double>(std::min(i / n, i % n) + 1), 1e-30);
  for (std::size_t k = 0; k < n; ++k) b.emplace_back(1 / static_cast<double>(k + 1), 0);
  const auto radius = [](const std::vector<B>& x) {
    return std::max_element(x.begin(), x.end(), [](const B& p, const B& q) { return p.r < q.r; })->r;
  };
  EXPECT_GT(radius(solve(positive_factor(A, n), b)), 1e-22);
  EXPECT_LT(radius(Solver<B>(A, n)(b)), 1e-25);
}

TEST(RandomTrees, OneOf300HasUpTo40JointsAndEveryTreeIsValid) {
  const auto all = make_properties(scalar_of<double>);
  const auto found =
      std::find_if(all.begin(), all.end(), [](const auto& p) { return p->name() == "lagrange"; });
  ASSERT_NE(found, all.end());
  const Property& law = **found;
  int large = 0, most = 0, far = 0, invalid = 0;
  for (std::uint64_t index = 0; index < 10000; ++index) {
    Source source(Source::Key{7, 8, 9, index});
    const std::vector<double> x = law.generate(source);
    const int joints = shrinks::joints_of(x);
    invalid += !law.valid(x);
    most = std::max(most, joints);
    const TreeCase<double> c(TreeLayout::of_size(x.size()), x, x);
    EXPECT_EQ(c.tree.joints.size(), static_cast<std::size_t>(joints));
    far += std::any_of(c.v.begin(), c.v.end(), [](double v) { return std::fabs(v) > 1e3; });
    if (joints <= tree_slots) continue;
    ++large;
    EXPECT_TRUE(law.takes(x.size()));
    EXPECT_FALSE(law.takes(x.size() + 1));
    for (const auto& y : law.simpler(x)) {
      EXPECT_TRUE(shrinks::joints_of(y) < joints || y.size() == x.size());
      EXPECT_TRUE(law.takes(y.size()));
    }
    EXPECT_EQ(shrinks::joints_of(law.simpler(x).at(0)), tree_slots);
    EXPECT_EQ(shrinks::joints_of(shrinks::first_joints(x, 1)), 1);
  }
  EXPECT_EQ(invalid, 0);
  EXPECT_NEAR(large, 33, 25);
  EXPECT_GT(most, 20);
  EXPECT_GT(far, 50);
}

}  // namespace

// batch/trees.hpp: compares many states at once with the same states one by one, in every set of instructions
// that the processor has.

#include <gtest/gtest.h>
#include <cstring>
#include <liecheck/algorithms/aba.hpp>
#include <liecheck/batch/sine.hpp>
#include <liecheck/batch/trees.hpp>

#include "random_tree.hpp"
#include "../refusal.hpp"
#include "scalar_test.hpp"

namespace liecheck {
namespace {

using batch::Instructions, batch::States;

/// A tree with two branches and all joints for which there are kernels.
Model<double> kernelModel() {
  test::Random random(7);
  Model<double> m;
  const auto add = [&](int parent, const Joint<double>& joint) {
    const int id = m.addJoint(parent, joint, random.pose(), std::to_string(m.njoints));
    m.appendBodyToJoint(id, random.body(2));
    m.armature.tail(m.nvs.back()).setConstant(0.1 * (id % 3));
    return id;
  };
  const int base = add(0, FreeFlyer<double>());
  const int hip = add(base, Revolute<double>(Vector3<double>(1, -2, 3)));
  add(add(hip, Prismatic<double>(Vector3<double>(0, 1, 1))), Revolute<double>(Axis<double>::Z()));
  add(add(base, Continuous<double>(Axis<double>::X())), Prismatic<double>(Axis<double>::Y()));
  add(0, Revolute<double>(Axis<double>::Y()));
  return m;
}

template <class S>
struct Batch {
  States<S> q, v, a, fext;
  Batch(const Model<double>& m, int n) : q(m.nq, n), v(m.nv, n), a(m.nv, n), fext(6 * m.njoints, n) {
    test::Random random(3);
    for (int i = 0; i < n; ++i) {
      const test::State s = test::randomState(m, random);
      q.col(i) = s.q.cast<S>().array(), v.col(i) = s.v.cast<S>().array(), a.col(i) = s.a.cast<S>().array();
      fext.col(i) = random.tangent(6 * m.njoints, 3).cast<S>().array();
    }
  }
};

template <class S>
Model<S> modelIn(const Model<double>& m) {
  if constexpr (std::is_same_v<S, double>)
    return m;
  else
    return m.template cast<S>();
}
/// Each state of the batches agrees with the state alone up to 64 eps of the norm.
template <class S>
void agree(const Model<double>& in_double, const Batch<S>& in, const batch::Options& o) {
  const Model<S> m = modelIn<S>(in_double);
  Data<S> data(m, Dense::Mass);
  const States<S> poses = batch::forwardKinematics(m, in.q, o), tau = batch::rnea(m, in.q, in.v, in.a, o),
                  pushed = batch::rnea(m, in.q, in.v, in.a, o, in.fext),
                  ddq = batch::aba(m, in.q, in.v, in.a, o, in.fext);
  ASSERT_EQ(poses.cols(), in.q.cols());
  const auto near = [](const auto& a, const auto& b) {
    EXPECT_LE((a - b).norm(), 64 * eps<S>() * b.norm()) << a.transpose() << "\n" << b.transpose();
  };
  for (Eigen::Index i = 0; i < in.q.cols(); ++i) {
    const VectorX<S> q = in.q.col(i), v = in.v.col(i), a = in.a.col(i);
    near(VectorX<S>(tau.col(i)), rnea(m, data, q, v, a));
    std::vector<Force<S>> fext;
    for (int j = 0; j < m.njoints; ++j)
      fext.emplace_back(Vector6<S>(in.fext.col(i).template segment<6>(6 * j)));
    near(VectorX<S>(pushed.col(i)), rnea(m, data, q, v, a, fext));
    near(VectorX<S>(ddq.col(i)), aba(m, data, q, v, a, fext));
    forwardKinematics(m, data, q);
    for (int j = 0; j < m.njoints; ++j) {
      const SE3<S>& X = data.oMi[std::size_t(j)];
      const VectorX<S> rows = poses.col(i).segment(12 * j, 12);
      for (int k = 0; k < 9; ++k) EXPECT_NEAR(rows[k], X.rotation()(k / 3, k % 3), 16 * eps<S>());
      EXPECT_LE((rows.tail(3) - X.translation()).norm(), 64 * eps<S>() * (1 + X.translation().norm()));
    }
  }
}
SCALAR_SUITE(BatchOfStates, float, double);

SCALAR_TEST(BatchOfStates, AgreesWithSingleStates) {
  const Model<double> kernels = kernelModel(), all = test::randomModel(5, 11);
  for (const auto i : {Instructions::baseline, Instructions::avx2, Instructions::avx512}) {
    if (!batch::supported(i)) continue;
    for (const int n : {0, 1, 3, 16, 37}) agree<S>(kernels, Batch<S>(kernels, n), {1, i});
    agree<S>(all, Batch<S>(all, 5), {1, i});
    agree<S>(kernels, Batch<S>(kernels, 1500), {3, i});
  }
}

SCALAR_TEST(BatchOfStates, OffUnitAndLargeCoordinatesAgreeToo) {
  const Model<double> m = kernelModel();
  Batch<S> in(m, 64);
  for (int i = 0; i < 64; i += 3) in.q.col(i).segment(3, 4) *= S(1 + i);
  for (int i = 0; i < 64; i += 5) in.q.col(i).segment(m.idx_qs[5], 2) *= S(0.3);
  for (int i = 0; i < 64; i += 7) in.q(m.idx_qs[2], i) = S(1e6 + i);
  agree<S>(m, in, {});
  in.q.col(20).segment(3, 4).setZero();
  EXPECT_EQ(test::refusal([&] { batch::aba(modelIn<S>(m), in.q, in.v, in.a); }),
            "a zero quaternion is not a rotation");
  const States<S> fewer = in.v.leftCols(63);
  EXPECT_EQ(test::refusal([&] { batch::rnea(modelIn<S>(m), in.q, fewer, in.a); }),
            "an argument of a batch is 12 x 63, the model needs 12 x 64");
}

SCALAR_TEST(BatchOfStates, BitsDoNotDependOnInstructions) {
  const Model<S> m = modelIn<S>(kernelModel());
  const Batch<S> in(kernelModel(), 100);
  const auto all = [&](Instructions i) {
    const batch::Options o{1, i};
    States<S> rows(m.nv * 2 + 12 * m.njoints, 100);
    rows << batch::rnea(m, in.q, in.v, in.a, o), batch::aba(m, in.q, in.v, in.a, o, in.fext),
        batch::forwardKinematics(m, in.q, o);
    return rows;
  };
  const States<S> baseline = all(Instructions::baseline);
  for (const auto i : {Instructions::avx2, Instructions::avx512}) {
    if (!batch::supported(i)) continue;
    EXPECT_EQ(std::memcmp(baseline.data(), all(i).data(), sizeof(S) * std::size_t(baseline.size())), 0);
  }
}

/// A sphere that spins. Products that are fused with a subtraction would leave an acceleration.
SCALAR_TEST(BatchOfStates, AnAccelerationThatIsZeroAloneIsZeroInABatch) {
  Model<double> in_double;
  test::Random random(9);
  const int id = in_double.addJoint(0, FreeFlyer<double>(), SE3<double>::Identity(), "base");
  in_double.appendBodyToJoint(id, Inertia<double>(2, Vector3<double>::Zero(), Matrix3<double>::Identity()));
  in_double.gravity.setZero();
  const Model<S> m = modelIn<S>(in_double);
  States<S> q = States<S>::Zero(7, 16), v = States<S>::Zero(6, 16);
  q.row(6).setOnes();
  for (int i = 0; i < 16; ++i) v.col(i).template tail<3>() = random.vector(3).template cast<S>().array();
  EXPECT_EQ(batch::aba(m, q, v, States<S>(States<S>::Zero(6, 16))).abs().maxCoeff(), S(0));
}

SCALAR_TEST(BatchOfStates, SineAndCosineHaveAnErrorOfOneEps) {
  using P = batch::Pack<S, register_bytes / int(sizeof(S))>;
  test::Random random(1);
  for (int n = 0; n < 200000; ++n) {
    const S half_pi = pi<S>() / 2, size = S(std::pow(10., random.uniform(-12, 2.9)));
    const S angle =
        n % 2 ? S(random.uniform(-1, 1)) * size : S(random.below(600) - 300) * half_pi + size * eps<S>();
    const batch::detail::SineAndCosine<P> at{P(angle)};
    const long double sine = std::sin((long double)(angle)), cosine = std::cos((long double)(angle));
    ASSERT_LE(std::abs(at.sine.v[0] - sine), (long double)(eps<S>()) * std::abs(sine)) << angle;
    ASSERT_LE(std::abs(at.cosine.v[0] - cosine), (long double)(eps<S>())) << angle;
  }
}

}  // namespace
}  // namespace liecheck

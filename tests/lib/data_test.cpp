// multibody/data.hpp: Model and Data are separate, algorithms allocate nothing, stale fields are detected.

#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <liecheck/algorithms/centroidal.hpp>
#include <liecheck/algorithms/derivatives.hpp>
#include <liecheck/algorithms/energy.hpp>
#include <liecheck/algorithms/jacobians.hpp>
#include <map>
#include <memory>
#include <set>
#include <thread>

#include "count_allocations.hpp"
#include "random_tree.hpp"
#include "../refusal.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;

/// The refusal of stale or foreign data is a std::logic_error.
template <class F>
std::string refusalOfData(F f) {
  return refusal<std::logic_error>(f);
}

TEST(Data, AnAlgorithmChangesOnlyItsOwnResults) {
  const Model<double> m = randomModel(3, 6);
  Random random(3);
  State s = randomState(m, random);
  Data<double> d(m);
  forwardKinematics(m, d, s.q, s.v);
  const auto pose = d.oMi[6].rotation();
  const auto velocity = d.v[6].to_vector();
  s.q = integrate(m, s.q, s.v);
  EXPECT_EQ(d.oMi[6].rotation(), pose);
  forwardKinematics(m, d, s.q);  // positions only
  EXPECT_NE(d.oMi[6].rotation(), pose);
  EXPECT_FALSE(d.v.isFresh());
  EXPECT_EQ(d.v.scratch()[6].to_vector(), velocity);
}

TEST(Data, OfAnotherModelOrOfAnEarlierRevisionIsRefused) {
  Model<double> m = randomModel(3, 6);
  const Model<double> copy = m, other = randomModel(3, 6);
  Data<double> d(m);
  const Vec q = neutral(m);
  EXPECT_NO_THROW(forwardKinematics(m, d, q));
  EXPECT_NO_THROW(forwardKinematics(copy, d, q));
  EXPECT_TRUE(has(refusalOfData([&] { forwardKinematics(other, d, q); }), "another model"));
  m.addFrame({"late", 1, 0, SE3<double>::Identity(), FrameType::OP_FRAME});
  EXPECT_TRUE(
      has(refusalOfData([&] { forwardKinematics(m, d, q); }), "before a joint, a frame or a body was added"));
  Data<double> later(m, Dense::Mass);
  EXPECT_NO_THROW(crba(m, later, q));
  m.appendBodyToJoint(2, Inertia<double>(1, Vector3<double>::Zero(), Matrix3<double>::Identity()));
  EXPECT_TRUE(has(refusalOfData([&] { crba(m, later, q); }), "a body was added"));
  EXPECT_TRUE(has(refusalOfData([&] { updateFramePlacements(m, d); }), "another model"));
  EXPECT_TRUE(has(refusalOfData([&] { getJointJacobian(m, d, 1, ReferenceFrame::WORLD); }), "another model"));
}

// A field that an algorithm left unfinished must not be read as a result.
TEST(Data, AnAlgorithmThatThrowsLeavesNoFieldFresh) {
  Model<double> m;
  const SE3<double> origin = SE3<double>::Identity();
  m.addJoint(0, Prismatic<double>({0, 0, 1}), origin, "massless");
  m.addJoint(1, Prismatic<double>({0, 0, 1}), origin, "parallel");
  m.addJoint(2, Spherical<double>(), origin, "ball");
  m.appendBodyToJoint(3, Inertia<double>(1, {0, 0, 0}, Matrix3<double>::Identity()));
  Data<double> d(m, Dense::Derivatives);
  const Vec q = neutral(m), v = Vec::Constant(m.nv, 0.5);
  EXPECT_THROW(aba(m, d, q, v, v), SingularInertia);
  EXPECT_TRUE(d.oMi.isFresh());
  EXPECT_FALSE(d.ddq.isFresh());
  EXPECT_THROW(d.ddq.checked(), StaleField);
  EXPECT_THROW(computeABADerivatives(m, d, q, v, v), SingularInertia);
  EXPECT_FALSE(d.Minv.isFresh() || d.ddq_dq.isFresh() || d.ddq_dv.isFresh());
  Vec zero = q;
  zero.tail(4).setZero();  // a quaternion without a direction
  const auto fresh = [&] {
    return d.liMi.isFresh() || d.oMi.isFresh() || d.v.isFresh() || d.a.isFresh() || d.f.isFresh() ||
           d.tau.isFresh() || d.nle.isFresh() || d.g.isFresh() || d.J.isFresh() || d.M.isFresh();
  };
  const std::function<void()> calls[] = {
      [&] { forwardKinematics(m, d, zero); },       [&] { forwardKinematics(m, d, zero, v); },
      [&] { forwardKinematics(m, d, zero, v, v); }, [&] { rnea(m, d, zero, v, v); },
      [&] { nonLinearEffects(m, d, zero, v); },     [&] { computeGeneralizedGravity(m, d, zero); },
      [&] { computeJointJacobians(m, d, zero); },   [&] { crba(m, d, zero); }};
  for (const auto& call : calls) {
    EXPECT_ANY_THROW(call());
    EXPECT_FALSE(fresh()) << "call " << &call - calls;
  }
}

TEST(Data, AVectorOfTheWrongSizeIsNamedWithBothSizes) {
  const Model<double> m = randomModel(3, 6);
  Data<double> d(m);
  const Vec q = neutral(m), v = Vec::Zero(m.nv);
  const std::string nv = std::to_string(m.nv), nq = std::to_string(m.nq);
  EXPECT_EQ(refusalOfData([&] { rnea(m, d, v, v, v); }), "q has " + nv + " numbers, the model's nq is " + nq);
  EXPECT_EQ(refusalOfData([&] { rnea(m, d, q, q, v); }), "v has " + nq + " numbers, the model's nv is " + nv);
  EXPECT_EQ(refusalOfData([&] { rnea(m, d, q, v, q); }), "a has " + nq + " numbers, the model's nv is " + nv);
  EXPECT_EQ(refusalOfData([&] { aba(m, d, q, v, q); }),
            "tau has " + nq + " numbers, the model's nv is " + nv);
  const std::vector<Force<double>> two(2, Force<double>::Zero());
  EXPECT_EQ(refusalOfData([&] { rnea(m, d, q, v, v, two); }), "fext has 2 numbers, the model's njoints is 7");
}

TEST(Data, HasMatricesOfSizeNvByNvOnlyIfRequested) {
  const Model<double> m = randomModel(3, 6);
  const Vec q = neutral(m), v = Vec::Zero(m.nv);
  Data<double> none(m), mass(m, Dense::Mass);
  EXPECT_EQ(refusalOfData([&] { crba(m, none, q); }),
            "crba needs nv x nv matrices: make Data(model, Dense::Mass)");
  EXPECT_EQ(refusalOfData([&] { computeRNEADerivatives(m, mass, q, v, v); }),
            "computeRNEADerivatives needs nv x nv matrices: make Data(model, Dense::Derivatives)");
  EXPECT_EQ(none.M.scratch().size(), 0);
}

TEST(Data, AStaleFieldNamesTheMissingCall) {
  const Model<double> m = randomModel(3, 6);
  Random random(3);
  const State s = randomState(m, random), other = randomState(m, random);
  Data<double> d(m, Dense::Mass);
  EXPECT_EQ(refusalOfData([&] { d.tau.checked(); }),
            "Data::tau was never computed: call rnea(model, data, q, v, a) first");
  crba(m, d, s.q);
  nonLinearEffects(m, d, s.q, s.v);
  EXPECT_NO_THROW(d.M.checked());  // the same q
  nonLinearEffects(m, d, s.q, other.v);
  EXPECT_NO_THROW(d.M.checked());  // it does not depend on v
  forwardKinematics(m, d, s.q, s.v);
  EXPECT_EQ(refusalOfData([&] { d.nle.checked(); }),
            "Data::nle belongs to an earlier state: call nonLinearEffects(model, data, q, v) first");
  forwardKinematics(m, d, other.q);
  EXPECT_FALSE(d.M.isFresh());
  EXPECT_FALSE(d.v.isFresh());
  EXPECT_TRUE(d.oMi.isFresh());
  EXPECT_FALSE(d.oMf.isFresh());
}

#define FRESH(field) std::pair(#field, d.field.isFresh())
/// The fields that are stale, of those that depend on the gravity or the armature, and M's neighbours.
std::set<std::string> staleFields(const Data<double>& d) {
  const std::pair<const char*, bool> all[] = {FRESH(f),
                                              FRESH(tau),
                                              FRESH(nle),
                                              FRESH(g),
                                              FRESH(tau_static),
                                              FRESH(ddq),
                                              FRESH(M),
                                              FRESH(Minv),
                                              FRESH(dtau_dq),
                                              FRESH(dtau_dv),
                                              FRESH(ddq_dq),
                                              FRESH(ddq_dv),
                                              FRESH(kinetic_energy),
                                              FRESH(potential_energy),
                                              FRESH(oMi),
                                              FRESH(v),
                                              FRESH(J),
                                              FRESH(Ag)};
  std::set<std::string> stale;
  for (const auto& [name, fresh] : all)
    if (!fresh) stale.insert(name);
  return stale;
}

TEST(Data, AnotherGravityOrArmatureMakesTheFieldsStaleThatDependOnIt) {
  Model<double> m = randomModel(3, 6);
  Random random(3);
  const State s = randomState(m, random);
  Data<double> d(m, Dense::Derivatives);
  const std::vector<Force<double>> none(std::size_t(m.njoints), Force<double>::Zero());
  const auto everything = [&] {
    computeJointJacobians(m, d, s.q), computeCentroidalMap(m, d, s.q);
    computeMechanicalEnergy(m, d, s.q, s.v);
    nonLinearEffects(m, d, s.q, s.v), computeStaticTorque(m, d, s.q, none);
    computeGeneralizedGravity(m, d, s.q);
    computeABADerivatives(m, d, s.q, s.v, s.tau);
    rnea(m, d, s.q, s.v, d.ddq());
  };
  using Names = std::set<std::string>;
  everything();
  EXPECT_EQ(staleFields(d), Names());
  m.gravity = -m.gravity;
  forwardKinematics(m, d, s.q);
  EXPECT_EQ(staleFields(d),
            (Names{"f", "tau", "nle", "g", "tau_static", "ddq", "dtau_dq", "ddq_dq", "potential_energy"}));
  EXPECT_EQ(refusalOfData([&] { d.tau.checked(); }),
            "Data::tau was computed with another gravity or armature: call rnea(model, data, q, v, a) first");
  everything();
  EXPECT_EQ(staleFields(d), Names());
  m.armature[0] += 1;
  forwardKinematics(m, d, s.q);
  EXPECT_EQ(staleFields(d), (Names{"tau", "ddq", "M", "Minv", "ddq_dq", "ddq_dv", "kinetic_energy"}));
  m.armature.resize(2);
  EXPECT_EQ(refusalOfData([&] { forwardKinematics(m, d, s.q); }),
            "armature has 2 numbers, the model's nv is " + std::to_string(m.nv));
}

TEST(Data, NoTwoAlgorithmsReturnTheSameStorage) {
  const Model<double> m = randomModel(3, 6);
  const Vec q = neutral(m), v = Vec::Ones(m.nv);
  Data<double> d(m, Dense::Derivatives);
  const std::vector<const double*> all{rnea(m, d, q, v, v).data(),
                                       nonLinearEffects(m, d, q, v).data(),
                                       computeGeneralizedGravity(m, d, q).data(),
                                       computeStaticTorque(m, d, q, {}).data(),
                                       aba(m, d, q, v, v).data(),
                                       crba(m, d, q).data(),
                                       computeMinverse(m, d, q).data(),
                                       computeJointJacobians(m, d, q).data(),
                                       computeJointJacobiansTimeVariation(m, d, q, v).data(),
                                       computeCentroidalMap(m, d, q).data(),
                                       jacobianCenterOfMass(m, d, q).data()};
  EXPECT_EQ(std::set<const double*>(all.begin(), all.end()).size(), all.size());
}

// A copy used to be impossible; copied field by field, it would refer to the state of the original.
TEST(Data, ACopyHasTheResultsOfTheOriginalAndAStateOfItsOwn) {
  const Model<double> m = randomModel(3, 6), other = randomModel(4, 9);
  Random random(3);
  const State s = randomState(m, random), later = randomState(m, random);
  const auto computed = [&] {
    auto d = std::make_unique<Data<double>>(m, Dense::Mass);
    rnea(m, *d, s.q, s.v, s.a), crba(m, *d, s.q);
    return d;
  };
  const Vec tau = computed()->tau(), tau_later = rnea(m, *computed(), later.q, later.v, later.a);
  const auto independent = [&](std::unique_ptr<Data<double>> original, Data<double>& copy) {
    EXPECT_EQ(copy.tau.checked(), tau);
    EXPECT_EQ(original->tau.checked(), tau);
    forwardKinematics(m, *original, later.q);
    EXPECT_FALSE(original->tau.isFresh());
    EXPECT_EQ(copy.tau.checked(), tau);
    rnea(m, copy, later.q, later.v, later.a), rnea(m, *original, s.q, s.v, s.a);
    EXPECT_EQ(copy.tau.checked(), tau_later);
    EXPECT_EQ(original->tau.checked(), tau);
    EXPECT_FALSE(copy.M.isFresh());
    original.reset();
    EXPECT_EQ(copy.tau.checked(), tau_later);
    EXPECT_EQ(crba(m, copy, s.q), computed()->M());
    EXPECT_FALSE(copy.tau.isFresh());
  };
  auto a = computed(), b = computed(), c = computed(), d = computed();
  Data<double> constructed = *a, from_moved = std::move(*b), assigned(other), move_assigned(other);
  rnea(other, assigned, neutral(other), Vec::Ones(other.nv), Vec::Ones(other.nv));
  assigned = *c, move_assigned = std::move(*d);
  independent(std::move(a), constructed), independent(std::move(b), from_moved);
  independent(std::move(c), assigned), independent(std::move(d), move_assigned);
  EXPECT_TRUE(
      has(refusalOfData([&] { forwardKinematics(other, assigned, neutral(other)); }), "another model"));
}

TEST(Data, AConstantModelServesManyThreads) {
  const Model<double> m = randomModel(5, 12);
  Random random(5);
  const State s = randomState(m, random);
  const auto everything = [&](Data<double>& d) {
    Vec all(5 * m.nv);
    computeABADerivatives(m, d, s.q, s.v, s.tau);
    all << d.ddq_dq() * s.v,  // before rnea's acceleration makes it stale
        rnea(m, d, s.q, s.v, s.a), aba(m, d, s.q, s.v, s.tau), computeMinverse(m, d, s.q) * s.tau,
        computeJointJacobians(m, d, s.q).transpose() * Vector6<double>::Ones();
    centerOfMass(m, d, s.q, s.v, s.a), computeCentroidalMap(m, d, s.q);
    return all;
  };
  Data<double> d(m, Dense::Derivatives);
  const Vec expected = everything(d);
  std::vector<std::thread> threads;
  std::vector<int> same(4, 0);
  for (int& result : same)
    threads.emplace_back([&] {
      Data<double> own(m, Dense::Derivatives);
      for (int i = 0; i < 50; ++i) result += everything(own) == expected;
    });
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(same, std::vector<int>(4, 50));
}

TEST(Data, NoAlgorithmAllocates) {
#ifndef LIECHECK_COUNTS_ALLOCATIONS
  GTEST_SKIP() << "allocations are not counted in this build";
#else
  const auto count = [](auto f) {
    const long before = allocations;
    f();
    return allocations - before;
  };
  EXPECT_EQ(count([] { Vec(3).setZero(); }), 1);  // count() works
  for (unsigned seed : {5U, 6U}) {
    Random random(seed);
    Model<double> m = randomModel(seed, 22);
    if (seed == 6) {
      m.addJoint(1, Revolute<double>(V3(1, 2, 3)), random.pose(), "primary");
      m.appendBodyToJoint(m.njoints - 1, random.body(1));
      m.addJoint(1, Mimic<double>(Revolute<double>(V3(3, 2, 1)), m.njoints - 1, 2, 0), random.pose(),
                 "mimic");
      m.appendBodyToJoint(m.njoints - 1, random.body(1));
    }
    const State s = randomState(m, random);
    const auto fext = random.forces(m.njoints);
    Data<double> d(m, Dense::Derivatives);
    const int frame = m.nframes - 1;
    const auto W = ReferenceFrame::WORLD;
    EXPECT_EQ(count([&] { forwardKinematics(m, d, s.q); }), 0);
    EXPECT_EQ(count([&] { forwardKinematics(m, d, s.q, s.v); }), 0);
    EXPECT_EQ(count([&] { forwardKinematics(m, d, s.q, s.v, s.a); }), 0);
    EXPECT_EQ(count([&] { updateFramePlacements(m, d); }), 0);
    EXPECT_EQ(count([&] { getFrameVelocity(m, d, frame, W), imu(m, d, frame); }), 0);
    EXPECT_EQ(count([&] { computeJointJacobiansTimeVariation(m, d, s.q, s.v); }), 0);
    Matrix6X<double> J(6, m.nv);
    EXPECT_EQ(count([&] {
                getFrameJacobian(m, d, frame, W, J), getFrameJacobianTimeVariation(m, d, frame, W, J);
                getJointJacobian(m, d, 1, W, J), getJointJacobianTimeVariation(m, d, 1, W, J);
              }),
              0);
    EXPECT_EQ(count([&] { rnea(m, d, s.q, s.v, s.a, fext); }), 0);
    EXPECT_EQ(count([&] { nonLinearEffects(m, d, s.q, s.v), computeGeneralizedGravity(m, d, s.q); }), 0);
    EXPECT_EQ(count([&] { computeStaticTorque(m, d, s.q, fext); }), 0);
    EXPECT_EQ(count([&] { crba(m, d, s.q); }), 0);
    EXPECT_EQ(count([&] { computeMinverse(m, d, s.q); }), 0);
    EXPECT_EQ(count([&] { aba(m, d, s.q, s.v, s.tau, fext); }), 0);
    EXPECT_EQ(count([&] { computeMechanicalEnergy(m, d, s.q, s.v); }), 0);
    EXPECT_EQ(count([&] { centerOfMass(m, d, s.q, s.v, s.a), jacobianCenterOfMass(m, d, s.q); }), 0);
    EXPECT_EQ(count([&] { computeCentroidalMomentumTimeVariation(m, d, s.q, s.v, s.a); }), 0);
    EXPECT_EQ(count([&] { computeRNEADerivatives(m, d, s.q, s.v, s.a, fext); }), 0);
    EXPECT_EQ(count([&] { computeABADerivatives(m, d, s.q, s.v, s.tau, fext); }), 0);
  }
#endif
}

TEST(Data, AChainOfTenThousandJointsRuns) {
  Model<double> m;
  for (int i = 0; i < 10000; ++i) {
    m.addJoint(i, Revolute<double>(Axis<double>::Y()), at(0.1, 0, 0), std::to_string(i));
    m.appendBodyToJoint(
        i + 1, Inertia<double>(1, V3(0.05, 0, 0), Matrix3<double>(1e-3 * Matrix3<double>::Identity())));
  }
  Data<double> d(m);
  const Vec q = Vec::Zero(m.nv);
  forwardKinematics(m, d, q);
  EXPECT_NEAR(d.oMi[10000].translation().x(), 1000, 1e-9);
  // A horizontal chain: the first joint carries 10000 bodies, at 500 m on average.
  EXPECT_NEAR(rnea(m, d, q, q, q)[0], -9.81 * 10000 * 500, 1e-4);
  EXPECT_LE(aba(m, d, q, q, d.tau()).norm(), 1e-3);
}

}  // namespace

// multibody/data_field.hpp in a debug build: reading a stale field throws, and names the missing call.

#include <gtest/gtest.h>

#include <liecheck/algorithms/frames.hpp>
#include <liecheck/algorithms/rnea.hpp>
#include <liecheck/multibody/configuration.hpp>

namespace {

using namespace liecheck;
using S = long double;
using V = VectorX<S>;

template <class F>
std::string stale(F f) {
  try {
    f();
  } catch (const StaleField& e) {
    return e.what();
  }
  return "nothing";
}

TEST(Freshness, ReadingAStaleFieldNamesTheMissingCall) {
  Model<S> m;
  m.addJoint(0, Revolute<S>(Axis<S>::X()), SE3<S>::Identity(), "joint");
  Data<S> d(m);
  const V zero = V::Zero(1), one = V::Ones(1);
  EXPECT_EQ(stale([&] { d.oMi(); }),
            "Data::oMi was never computed: call forwardKinematics(model, data, q) first");
  EXPECT_EQ(stale([&] { updateFramePlacements(m, d); }),
            "Data::oMi was never computed: call forwardKinematics(model, data, q) first");
  forwardKinematics(m, d, zero, one);
  EXPECT_EQ(stale([&] { d.v[1]; }), "nothing");
  EXPECT_EQ(stale([&] { d.oMf[0]; }),
            "Data::oMf was never computed: call updateFramePlacements(model, data) first");
  // A call for positions leaves the velocities stale.
  forwardKinematics(m, d, one);
  EXPECT_EQ(stale([&] { getFrameVelocity(m, d, 0, ReferenceFrame::LOCAL); }),
            "Data::v belongs to an earlier state: call forwardKinematics(model, data, q, v) first");
  EXPECT_EQ(stale([&] { getFrameAcceleration(m, d, 0, ReferenceFrame::LOCAL); }),
            "Data::a was never computed: call forwardKinematics(model, data, q, v, a) first");
  rnea(m, d, one, one, one);
  EXPECT_EQ(stale([&] { d.tau(), d.v[1]; }), "nothing");
}

TEST(Freshness, SpatialValuesThatWereNeverSetAreNaN) {
  EXPECT_TRUE(std::isnan(Motion<S>().linear().x()));
}

}  // namespace

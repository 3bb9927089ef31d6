// Correct forms in wide use that liecheck's own forms outdo pass under every profile but `ours`: the sign of the plain
// product in integrate, log(T0^-1 T1) as difference, and what is seen from a frame computed from what the world sees.

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <subjects/tree.hpp>

#include "../campaigns.hpp"
#include "../own_subject.hpp"

namespace liecheck::properties {
namespace {

using O = TypedOperations<double>;
using V3 = O::V3;
using V4 = O::V4;
using V6 = O::V6;
using V7 = O::V7;

const O& own() {
  return own_subject().operations;
}
Eigen::Quaterniond rotation_of(const V7& q) {
  return {q[6], q[3], q[4], q[5]};
}

V7 integrate(const V7& q, const V6& d) {
  V7 next = own()[op::integrate](q, d);
  const double theta = d.tail<3>().norm();
  Eigen::Quaterniond step(std::cos(theta / 2), 0, 0, 0);
  step.vec() = d.tail<3>() * (theta > 0 ? std::sin(theta / 2) / theta : 0.5);
  next.tail<4>() = (rotation_of(q) * step).normalized().coeffs();
  return next;
}
V6 difference(const V7& q0, const V7& q1) {
  const Eigen::Quaterniond back = rotation_of(q0).conjugate(), Q = (back * rotation_of(q1)).normalized();
  return own()[op::log6]({Q.toRotationMatrix(), back * V3(q1.head<3>()) - back * V3(q0.head<3>())});
}

/// (u, omega) at the world's origin, as seen at and from a frame.
template <class M>
M local(const Pose<double>& X, M world) {
  for (int k = 0; k < world.cols(); ++k) {
    const V3 u = world.col(k).template head<3>(), w = world.col(k).template tail<3>();
    world.col(k).template head<3>() = X.R.transpose() * (u - X.p.cross(w));
    world.col(k).template tail<3>() = X.R.transpose() * w;
  }
  return world;
}

/// Throws, as libraries do that check a tolerance, if the matrix is further than 1e-10 from a rotation.
void check_rotation(const O::M3& R) {
  if ((R.transpose() * R - O::M3::Identity()).norm() > 1e-10) throw std::invalid_argument("not orthogonal");
}

const Registered<double> ordinary[] = {
    registered("ordinary:checks",
               [](O& o) {
                 o[op::quaternion_from_matrix] = [](const O::M3& R) {
                   check_rotation(R);
                   return own()[op::quaternion_from_matrix](R);
                 };
                 o[op::log3_matrix] = [](const O::M3& R) {
                   check_rotation(R);
                   return own()[op::log3_matrix](R);
                 };
               }),
    registered("ordinary:poses",
               [](O& o) {
                 o[op::integrate] = integrate, o[op::difference] = difference;
                 o[op::d_difference_arg0] = [](const V7& q0, const V7& q1) -> O::M6 {
                   return -own()[op::left_jacobian6_inverse](difference(q0, q1));
                 };
                 o[op::d_difference_arg1] = [](const V7& q0, const V7& q1) -> O::M6 {
                   return own()[op::right_jacobian6_inverse](difference(q0, q1));
                 };
               }),
    registered("ordinary:canonical", op::integrate,
               [](const V7& q, const V6& d) -> V7 {
                 V7 next = integrate(q, d);
                 if (next[6] < 0) next.tail<4>() *= -1;
                 return next;
               }),
    registered("ordinary:columns",
               [](O& o) {
                 o.tree = [](const Tree<double>& tree) {
                   auto t = own().tree(tree);
                   TreeOperations<double> few;
                   few[op::tree_crba] = [t](const auto& q) -> MatX<double> {  // by inverse dynamics
                     MatX<double> M = t[op::tree_crba](q);
                     const VecX<double> zero = VecX<double>::Zero(M.cols());
                     for (int k = 0; k < M.cols(); ++k)
                       M.col(k) = t[op::tree_rnea](q, zero, VecX<double>::Unit(M.cols(), k), -1,
                                                   Vec<double, 6>::Zero());
                     return M;
                   };
                   return few;
                 };
               }),
    registered("ordinary:frames", [](O& o) {
      o.tree = [](const Tree<double>& tree) {
        auto t = own().tree(tree);
        TreeOperations<double> few;
        few[op::frame_velocity] = [t](const auto& q, const auto& v, Seen seen) -> V6 {
          if (seen != Seen::local) return t[op::frame_velocity](q, v, seen);
          return local(t[op::frame_pose](q), t[op::frame_velocity](q, v, Seen::world));
        };
        few[op::frame_jacobian] = [t](const auto& q, Seen seen) -> MatX<double> {
          if (seen != Seen::local) return t[op::frame_jacobian](q, seen);
          return local(t[op::frame_pose](q), t[op::frame_jacobian](q, Seen::world));
        };
        return few;
      };
    })};

CampaignResult run(const std::string& subject, const std::vector<std::string>& laws, Profile profile,
                   std::uint64_t cases, const std::string& lines = "") {
  CampaignOptions o = quiet({{subject}, laws, {"double"}}, cases, 2);
  o.selection.profiles[""] = profile;
  if (!lines.empty())
    o.selection.limits = {std::make_shared<const SubjectLimits>(
        parse_limits("own.limits", "version = 2\nsubject = " + subject + "\n[limits]\n" + lines))};
  return run_campaign(o, built_in_robot());
}
std::string failures(const CampaignResult& r) {
  std::string text;
  for (const auto& [series, tally] : r.series)
    for (const auto& [cell, row] : tally.rows)
      if (row.failed)
        text += series->id(42, row.worst_index).text() + " " +
                std::string(series->outputs[std::size_t(cell.first)].operation) + " " +
                std::string(series->outputs[std::size_t(cell.first)].block) + "\n";
  return text;
}

TEST(OrdinaryForms, OfPosesAreAccusedByTheProfileOursOnly) {
  for (const char* law : {"sign_continuity", "integrate_difference", "d_integrate"}) {
    EXPECT_TRUE(run("ordinary:poses", {law}, Profile::ours, 1000).failed) << law;
    const CampaignResult r = run("ordinary:poses", {law}, Profile::careful, 4000);
    EXPECT_FALSE(r.failed) << failures(r);
  }
  const CampaignResult r = run("ordinary:canonical", {"sign_continuity"}, Profile::careful, 1000);
  EXPECT_FALSE(r.failed) << failures(r);
}

TEST(OrdinaryForms, ARefusedMatrixThatHasDriftedIsAccusedByTheProfileOursOnly) {
  EXPECT_TRUE(run("ordinary:checks", {"drifted_matrices"}, Profile::ours, 300).failed);
  const CampaignResult r = run("ordinary:checks", {"drifted_matrices"}, Profile::careful, 1000);
  EXPECT_FALSE(r.failed) << failures(r);
}

TEST(OrdinaryForms, AMassMatrixByColumnsIsAccusedByTheProfileOursOnly) {
  EXPECT_TRUE(run("ordinary:columns", {"mass_matrix"}, Profile::ours, 600).failed);
  const CampaignResult r = run("ordinary:columns", {"mass_matrix"}, Profile::careful, 3000);
  EXPECT_FALSE(r.failed) << failures(r);
}

TEST(OrdinaryForms, TheSignIsHeldToALineOfALimitsFileThatNamesIt) {
  const std::string line = "integrate, sign, any, forward = 64, the nearer one\n";
  EXPECT_TRUE(run("ordinary:canonical", {"sign_continuity"}, Profile::careful, 300, line).failed);
  EXPECT_FALSE(
      run("ordinary:canonical", {"sign_continuity"}, Profile::careful, 300, "*, sign, any, forward = 64\n")
          .failed);
}

TEST(OrdinaryForms, OfFramesAreAccusedByTheProfileOursOnly) {
  for (const char* law : {"frame_motion", "frame_jacobian"}) {
    EXPECT_TRUE(run("ordinary:frames", {law}, Profile::ours, 600).failed) << law;
    const CampaignResult r = run("ordinary:frames", {law}, Profile::careful, 1500);
    EXPECT_FALSE(r.failed) << failures(r);
  }
}

}  // namespace
}  // namespace liecheck::properties

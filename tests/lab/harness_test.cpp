// The harness: every law fails on a planted bug, NaN never passes, cases and digests are reproducible.

#include <gtest/gtest.h>
#include <invariants/tree_laws.hpp>

#include <Eigen/Geometry>
#include <campaign/campaign.hpp>
#include <campaign/case_id.hpp>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <record/record.hpp>
#include <store/stored_run.hpp>

#include "own_subject.hpp"

namespace liecheck::properties {
namespace {

using O = TypedOperations<double>;
using V3 = O::V3;
using V4 = O::V4;
using V6 = O::V6;
using V7 = O::V7;
using M6 = O::M6;

const O& own() {
  return own_subject().operations;
}

/// The subject planted_<name>, whose only function is wrong.
template <class Operation, class F>
Registered<double> planted(const std::string& name, const Operation& operation, F wrong) {
  TypedSubject<double> s;
  s.name = "planted_" + name;
  s.operations[operation] = wrong;
  return Registered<double>(s);
}
using X = VecX<double>;
/// A subject with one wrong function of robots, which `wrong` makes of the right one.
template <const auto& operation, class Make>
Registered<double> planted_in_robots(const std::string& name, Make) {
  TypedSubject<double> s;
  s.name = "planted_" + name;
  s.operations.robot = [](const std::string& urdf, bool fixed) {
    auto r = own().robot(urdf, fixed);
    r[operation] = Make()(r[operation]);
    return r;
  };
  return Registered<double>(s);
}

// One bug for each law: an omitted inverse Jacobian, a swapped side, a transposed adjoint, a forced sign ...
const Registered<double> bugs[] = {
    planted("exp_oracle", op::exp6,
            [](const V6& xi) {
              auto T = own()[op::exp6](xi);
              T.p *= 1 + 1e-14;
              return T;
            }),
    planted("log_oracle", op::log6,
            [](const Pose<double>& T) {
              V6 xi = own()[op::log6](T);
              xi.head<3>() = T.p;
              return xi;
            }),
    planted("jacobian_oracle", op::left_jacobian6,
            [](const V6& xi) { return own()[op::right_jacobian6](xi); }),
    planted("integrate_difference", op::difference,
            [](const V7& a, const V7& b) { return own()[op::difference](b, a); }),
    planted("sign_continuity", op::integrate,
            [](const V7& q, const V6& d) {
              V7 r = own()[op::integrate](q, d);
              if (r[6] < 0) r.tail<4>() *= -1;
              return r;
            }),
    planted("d_integrate", op::d_integrate_arg0,
            [](const V7& q, const V6& d) { return M6(own()[op::d_integrate_arg0](q, d).transpose()); }),
    planted("small_angle_branches", op::exp6,
            [](const V6& xi) {
              auto T = own()[op::exp6](xi);
              if (xi.tail<3>().norm() < 1e-4) T.p = xi.head<3>() + xi.tail<3>().cross(xi.head<3>()) / 2;
              return T;
            }),
    planted("kinematic_identities", op::integrate_coefficient_jacobian,
            [](const V7& q) {
              Mat<double, 7, 6> J = own()[op::integrate_coefficient_jacobian](q);
              J.block<3, 3>(3, 3).transposeInPlace();  // Q_dot = 1/2 (omega, 0) Q: the world-frame velocity
              return J;
            }),
    planted("any_norm", op::normalize,
            [](const V4& Q) { return V4(Q / std::sqrt(Q.squaredNorm())); }),  // may overflow
    planted("any_norm_configurations", op::difference_any_norm,
            [](const V7& a, const V7& b) {
              return V6(own()[op::difference](a, b) * b.tail<4>().norm());  // not divided
            }),
    planted("normalisation", op::first_order_normalize,
            [](const V4& Q) { return V4(Q * (2 - Q.norm())); }),  // another order
    planted("kinetic_energy", op::kinetic_energy,
            [](const Body<double>& b, const V6& V) {  // the parallel-axis term twice
              const V3 w = V.tail<3>();
              return own()[op::kinetic_energy](b, V) + b.mass * w.cross(b.c).squaredNorm() / 2;
            }),
    Registered<double>([] {
      TypedSubject<double> s;
      s.name = "planted_power_pairing";
      s.operations[op::act_motion] = [](const Pose<double>& T, const V6& V) {
        return own()[op::act_motion](T, V);
      };
      s.operations[op::act_force] = s.operations[op::act_motion];  // a wrench transformed as a twist
      return s;
    }()),
    planted("pose_group", op::inverse,
            [](const Pose<double>& T) {
              auto Y = own()[op::inverse](T);
              Y.p = -(T.R * T.p);  // not transposed
              return Y;
            }),
    planted_in_robots<op::robot_is_same>(
        "robot_configuration",
        [](auto) { return [](const X& a, const X& b) { return (a - b).norm() < 1e-12; }; }),
    planted_in_robots<op::robot_d_integrate_arg0>(
        "robot_derivatives",
        [](auto f) { return [f](const X& q, const X& d) { return MatX<double>(f(q, X(-d))); }; }),
    planted_in_robots<op::robot_is_same>("always_same",
                                         [](auto) { return [](const X&, const X&) { return true; }; }),
    planted_in_robots<op::robot_is_same>("same_but_one",
                                         [](auto f) {
                                           return [f](X a, X b) {
                                             a.tail<1>().setZero(),
                                                 b.tail<1>().setZero();  // the last joint is ignored
                                             return f(a, b);
                                           };
                                         }),
    planted_in_robots<op::robot_integrate>("opposite",
                                           [](auto f) {
                                             return [f](const X& q, const X& d) {
                                               X next = f(q, d);
                                               if (next[6] < 0) next.segment<4>(3) *= -1;
                                               return next;
                                             };
                                           }),
    planted("nan", op::exp3_quaternion, [](const V3&) { return V4(V4::Constant(NAN)); }),
};

CampaignResult run(const std::string& subject, const std::string& property, std::uint64_t cases = 300,
                   unsigned jobs = 1) {
  CampaignOptions options;
  options.selection = {{subject}, {property}, {"double"}};
  options.cases = cases;
  options.jobs = jobs;
  options.quiet = true;
  return run_campaign(options, built_in_robot());
}

/// The laws of single operations: each has a bug planted above. A law without one fails its test.
std::vector<std::string> laws_of_operations() {
  std::vector<std::string> laws = property_names();
  std::erase_if(laws, [](const std::string& law) { return is_tree_law(law); });
  return laws;
}

/// Laws whose bug is one of the known bugs that the program has.
const std::map<std::string, std::string> known_bugs = {
    {"coefficient_rates", "bug:rate_omega_of_parent"},   {"euler_angles", "bug:euler_matrix_transposed"},
    {"minimal_rotation", "bug:between_equal_threshold"}, {"planar_poses", "bug:se2_compose_no_rotation"},
    {"relative_rotation", "bug:slerp_midpoint"},         {"twist", "bug:twist_beyond_pi"}};

class Planted : public testing::TestWithParam<std::string> {};

TEST_P(Planted, BugIsCaughtByItsLawAndTheLawPassesWithoutIt) {
  const auto of_program = known_bugs.find(GetParam());
  const std::string bug = of_program == known_bugs.end() ? "planted_" + GetParam() : of_program->second;
  const auto known = subject_names();
  ASSERT_NE(std::find(known.begin(), known.end(), bug), known.end()) << "no bug is planted for this law";
  // A jump at a cutoff shows only if the cutoff lies between two neighbouring inputs: in one case of 130.
  const CampaignResult result = run(bug, GetParam(), 2000);
  ASSERT_EQ(result.series.size(), 1u);
  EXPECT_GT(result.series.at(0).tally.rows.size(), 0u) << "the law measured nothing";
  EXPECT_TRUE(result.failed);
  EXPECT_FALSE(run("liecheck", GetParam(), 100).failed);
}

INSTANTIATE_TEST_SUITE_P(EveryLaw, Planted, testing::ValuesIn(laws_of_operations()),
                         [](const auto& info) { return info.param; });

TEST(Planted, FaultsInConfigurationsOfRobotsAreCaught) {
  for (const char* bug : {"planted_always_same", "planted_same_but_one", "planted_opposite"})
    EXPECT_TRUE(run(bug, "robot_configuration").failed) << bug;
}

TEST(Planted, EveryLawOfTreesCatchesAKnownBugAndPassesWithoutIt) {
  for (const auto& p : property_names()) {
    if (!is_tree_law(p)) continue;
    bool caught = false;
    for (const auto* s : typed_subjects<double>())
      caught = caught || (s->name.starts_with("bug:tree_") && run(s->name, p, 100).failed);
    EXPECT_TRUE(caught) << p;
    EXPECT_FALSE(run("liecheck", p, 100).failed) << p;
  }
}

TEST(Harness, NotANumberIsNeverAPass) {
  const auto r = run("planted_nan", "exp_oracle", 20);
  EXPECT_TRUE(r.failed);
  for (const auto& [key, row] : r.series.at(0).tally.rows) EXPECT_EQ(row.not_finite, row.count);
}

TEST(Harness, DigestsDoNotDependOnThreads) {
  const auto one = run("liecheck", "exp_oracle", 200, 1), two = run("liecheck", "exp_oracle", 200, 2);
  EXPECT_EQ(one.inputs_digest, two.inputs_digest);
  EXPECT_EQ(one.results_digest, two.results_digest);
  EXPECT_NE(one.inputs_digest, run("liecheck", "exp_oracle", 201, 1).inputs_digest);
}

TEST(Harness, TextbookFailsBecauseItsClosedFormsCancel) {
  EXPECT_TRUE(run("textbook", "exp_oracle").failed);
}

TEST(CaseIds, AreParsedBackFromTheirText) {
  CaseId id;
  id.seed = 7, id.property = "exp_oracle", id.subject = "liecheck", id.scalar = "double", id.robot = "none",
  id.index = 12;
  EXPECT_EQ(CaseId::parse(id.text()).text(), id.text());
  EXPECT_EQ(CaseId::parse("raw.p.s.double.none.0x1.8p+0,-0x0p+0").input.size(), 2u);
  EXPECT_THROW(CaseId::parse("g1.7.p.s.double.none.1"), std::invalid_argument);
  EXPECT_THROW(CaseId::parse("g4.x.p.s.double.none.1"), std::invalid_argument);
  EXPECT_THROW(CaseId::parse(""), std::invalid_argument);
}

TEST(Numbers, HexadecimalFloatsAreParsedBackBitForBit) {
  for (double x : {0.1, -0.0, 5e-324, 1.7e308})
    EXPECT_EQ(parse_float(hexadecimal_float(x), oracles::scalar_of<double>), x);
  EXPECT_THROW(parse_float("1.0x", oracles::scalar_of<double>), std::invalid_argument);
  EXPECT_EQ(parse_float("inf", oracles::scalar_of<double>), INFINITY);
  EXPECT_EQ(parse_float("3e-324", oracles::scalar_of<double>), 5e-324);  // rounded, but not to 0
  EXPECT_EQ(parse_float("0x0.0p-5000", oracles::scalar_of<double>), 0);
  EXPECT_EQ(parse_float("-000e500", oracles::scalar_of<double>), 0);
  for (const char* zero : {"1e-400", "0x1p-1080", "-0.0001e-330", "0x0.0fp-1080"}) {
    EXPECT_THROW(parse_float(zero, oracles::scalar_of<double>), std::invalid_argument) << zero;
  }
  for (const char* large : {"1e400", "0x1p+1024", "-1e309"})
    EXPECT_THROW(parse_float(large, oracles::scalar_of<double>), std::invalid_argument) << large;
  EXPECT_THROW(parse_float("1e-60", oracles::scalar_of<float>), std::invalid_argument);
  EXPECT_THROW(parse_float("1e39", oracles::scalar_of<float>), std::invalid_argument);
}

TEST(Budgets, GiveEveryOutputALimitAndAReason) {
  for (const auto& s : select({}, built_in_robot()))
    for (const Output& o : s->outputs)
      for (Region region : {Region::to_pi, Region::beyond_pi})
        EXPECT_FALSE(budget_of(s->subject, o.operation, o.block, region).reason.empty());
}

TEST(Record, HasTheDocumentedFields) {
  const auto record = record_of(StoredRun{run("liecheck", "exp_oracle", 50), {}, {}});
  for (const char* key : {"version", "seed", "cases", "verdict", "digest", "results"})
    EXPECT_TRUE(record.contains(key)) << key;
  for (const char* key :
       {"subject", "scalar", "property", "operation", "block", "band", "count", "max_eps", "p99_eps",
        "median_eps", "max_excess", "budget", "rule", "ill_posed", "status", "worst"})
    EXPECT_TRUE(record["results"].at(0).contains(key)) << key;
}

}  // namespace
}  // namespace liecheck::properties

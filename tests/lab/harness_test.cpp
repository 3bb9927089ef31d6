// The harness: every law fails on a planted bug, NaN never passes, cases and digests are reproducible.

#include <gtest/gtest.h>
#include <invariants/tree_laws.hpp>

#include <Eigen/Geometry>
#include <campaign/case_id.hpp>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <record/record.hpp>
#include <store/stored_run.hpp>

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

// Bugs of laws for which no known bug stands below, of robots, and NaN.
const Registered<double> bugs[] = {
    registered("planted_any_norm", op::normalize,
               [](const V4& Q) { return V4(Q / std::sqrt(Q.squaredNorm())); }),  // may overflow
    registered("planted_any_norm_configurations", op::difference_any_norm,
               [](const V7& a, const V7& b) {
                 return V6(own()[op::difference](a, b) * b.tail<4>().norm());  // not divided
               }),
    registered("planted_normalisation", op::first_order_normalize,
               [](const V4& Q) { return V4(Q * (2 - Q.norm())); }),  // another order
    registered("planted_pose_group", op::inverse,
               [](const Pose<double>& T) {
                 auto Y = own()[op::inverse](T);
                 Y.p = -(T.R * T.p);  // not transposed
                 return Y;
               }),
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
    registered("planted_nan", op::exp3_quaternion, [](const V3&) { return V4(V4::Constant(NAN)); }),
};

CampaignResult run(const std::string& subject, const std::string& property, std::uint64_t cases = 300,
                   unsigned jobs = 1) {
  return run_quietly({{subject}, {property}, {"double"}}, cases, jobs);
}

/// The laws of single operations: each has a bug planted above. A law without one fails its test.
std::vector<std::string> laws_of_operations() {
  std::vector<std::string> laws = property_names();
  std::erase_if(laws, [](const std::string& law) { return is_tree_law(law); });
  return laws;
}

/// Laws whose bug is one of the known bugs that the program has.
const std::map<std::string, std::string> known_bugs = {
    {"adjoints", "bug:adjoint_rows_of_R"},
    {"axis_and_angle", "bug:axis_angle_half"},
    {"coefficient_rates", "bug:rate_omega_of_parent"},
    {"covariances", "bug:covariance_on_one_side"},
    {"d_integrate", "bug:d_integrate_transposed"},
    {"directions", "bug:angle_between_acos"},
    {"drifted_matrices", "bug:drifted_matrix_nan"},
    {"euler_angles", "bug:euler_matrix_transposed"},
    {"exp_oracle", "bug:exp_float_constant"},
    {"extended_poses", "bug:se23_exp_plain_velocity"},
    {"integrate_difference", "bug:difference_order"},
    {"interpolation", "bug:interpolate_apart"},
    {"jacobian_oracle", "bug:jacobian_left_for_right"},
    {"kinematic_identities", "bug:coefficient_world"},
    {"kinetic_energy", "bug:parallel_axis_doubled"},
    {"log_oracle", "bug:log6_no_V_inverse"},
    {"means", "bug:mean_without_weights"},
    {"minimal_rotation", "bug:between_equal_threshold"},
    {"nearest_rotation", "bug:nearest_by_columns"},
    {"planar_poses", "bug:se2_compose_no_rotation"},
    {"power_pairing", "bug:force_as_motion"},
    {"preintegration", "bug:forster_order"},
    {"quaternions", "bug:product_exchanged"},
    {"relative_rotation", "bug:slerp_midpoint"},
    {"robot_configuration", "bug:robot_same_by_coefficients"},
    {"rotation_parameters", "bug:gibbs_of_half"},
    {"sign_continuity", "bug:integrate_no_sign_flip"},
    {"small_angle_branches", "bug:exp6_shared_cutoff"},
    {"twist", "bug:twist_beyond_pi"}};

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
      caught = caught || (s->name.starts_with("bug:") && s->operations.tree && run(s->name, p, 100).failed);
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

// Nothing right is accused: correct implementations stay within limits of four times their largest error
// (fixtures/limits, written by `liecheck lab limits --out`), which still refuse a faulty one.

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <budgets/limits.hpp>
#include <campaign/needs.hpp>
#include <campaign/robots.hpp>
#include <cmath>
#include <hard_cases/hard_cases.hpp>
#include <set>
#include <sstream>
#include <subjects/tree.hpp>

#include "../own_subject.hpp"

namespace liecheck::properties {
namespace {

std::vector<std::string> correct_subjects() {
  std::vector<std::string> names = subject_names();
  std::erase_if(names, [](const std::string& n) { return !n.starts_with("correct:"); });
  return names;
}

std::shared_ptr<const SubjectLimits> limits_of(std::string subject) {
  std::replace(subject.begin(), subject.end(), ':', '_');
  return std::make_shared<const SubjectLimits>(
      read_limits(LIECHECK_FIXTURES "/limits/" + subject + ".limits"));
}

std::map<std::string, Needs> campaign(const Selection& selection) {
  CampaignOptions o;
  o.selection = selection;
  o.seed = 20, o.cases = 150, o.jobs = 2, o.quiet = true;
  return needs_of(run_campaign(o, built_in_robot()));
}

template <class S>
void expect_eight_of_each() {
  TypedOperations<S>::for_each([](const auto& operation) {
    const auto all = typed_subjects<S>();
    const auto offers = [&](const TypedSubject<S>* s) {
      return s->name.starts_with("correct:") && s->operations[operation] != nullptr;
    };
    EXPECT_GE(std::ranges::count_if(all, offers), 8) << operation.name;
  });
}

TEST(Correct, AtLeastEightImplementationsOfferEachOperationOnPosesAndBodies) {
  expect_eight_of_each<float>();
  expect_eight_of_each<double>();
}

TEST(Correct, AtLeastTwoImplementationsOfferEachOperationOnTrees) {
  const auto robot = built_in_robot();
  std::map<std::string, int> offered;
  for (const std::string& name : correct_subjects()) {
    std::set<std::string> own;
    for (const auto& series : select({{name}, {}, {"double"}}, robot))
      for (std::size_t i = 0; i < series->outputs.size(); ++i)
        if (series->due >> i & 1) own.emplace(series->outputs[i].operation);
    for (const std::string& operation : own) ++offered[operation];
  }
  TreeOperations<double>::for_each(
      [&](const auto& operation) { EXPECT_GE(offered[std::string(operation.name)], 2) << operation.name; });
}

TEST(Correct, NoCorrectImplementationIsAccused) {
  Selection all{correct_subjects(), {}, {}};
  for (const std::string& name : all.subjects) all.limits.push_back(limits_of(name));
  const auto found = campaign(all);
  EXPECT_EQ(found.size(), all.subjects.size());
  for (const auto& [subject, needs] : found) {
    EXPECT_GE(needs.size(), 10u) << subject;
    for (const auto& [key, need] : needs)
      EXPECT_FALSE(need.accused()) << subject << ": " << key.operation << ", " << key.block << ", "
                                   << key.region << ": " << need.largest << ", limit " << need.limit
                                   << ", broken " << need.broken << ", not measured " << need.unmeasured
                                   << ": " << need.worst;
  }
}

TEST(Correct, NoHardCaseAccusesACorrectImplementationUnderTheProfileCareful) {
  Selection all{correct_subjects(), {}, {"float", "double"}};
  all.profiles[""] = Profile::careful;
  std::size_t stable = 0;
  for (const HardRow& row : run_hard_cases(all, built_in_robot(), built_in_corpus(), 2))
    for (const HardCell& cell : row.cells) {
      EXPECT_FALSE(cell.failed || cell.open)
          << row.entry->name << ": " << cell.subject << " in " << cell.scalar << ": " << name_of(cell.verdict)
          << " " << cell.operation;
      stable += cell.verdict == Verdict::stable;
    }
  EXPECT_GT(stable, 8000u);
}

TEST(Correct, TheSameLimitsAccuseAFormulaThatCancels) {
  std::string text = limits_of("correct:books")->text;
  text.replace(text.find("correct:books"), 13, "textbook");
  const auto limits = std::make_shared<const SubjectLimits>(parse_limits("textbook.limits", text));
  const auto found = campaign({{"textbook"}, {}, {}, {limits}});
  int accused = 0;
  for (const auto& [key, need] : found.at("textbook"))
    accused += need.accused() && (key.operation == "exp6" || key.operation == "left_jacobian6");
  EXPECT_GE(accused, 2);
}

TEST(Limits, ExceededOrBrokenOrNotMeasuredIsAccused) {
  EXPECT_FALSE((Need{1, 4, 0, 0, ""}.accused()));
  EXPECT_TRUE((Need{5, 4, 0, 0, ""}.accused()));
  EXPECT_TRUE((Need{1, 4, 1, 0, ""}.accused()));
  EXPECT_TRUE((Need{1, 4, 0, 1, ""}.accused()));
}

TEST(Limits, AreFourTimesTheNeedAndAreReadAsTheyAreWritten) {
  const LimitKey key{"exp6", "orthogonality defect", "any", "forward"},
      none{"inverse", "matrix", "any", "forward"};
  const std::string text =
      limits_text("correct:books", {{key, {2.5, 8, 0, 0, ""}}, {none, {0, 7, 0, 0, ""}}}, "measured");
  const auto table = with_own_limits(budgets("correct:books"), parse_limits("f", text).lines);
  EXPECT_EQ(budget_in(table, key.operation, key.block, Region::to_pi).limit, 10);
  EXPECT_EQ(budget_in(table, none.operation, none.block, Region::to_pi).limit,
            budget_of("", none.operation, none.block, Region::to_pi).limit);
}

// An excess below half the limit is an upper bound: kappa counts as 1, and an ill-posed case as passed.
TEST(Limits, NeedsCountEveryConditionNumber) {
  CampaignOptions o;
  o.selection = {{"liecheck"}, {"power_pairing"}, {"float"}};
  o.cases = 100, o.quiet = true;
  const auto counted = [&o](bool every_kappa) {
    o.every_kappa = every_kappa;
    const CampaignResult r = run_campaign(o, built_in_robot());
    std::uint64_t ill_posed = 0;
    double largest = 0;
    for (const auto& [cell, row] : r.series.at(0).tally.rows) {
      ill_posed += row.ill_posed;
      largest = std::max(largest, row.max_excess);
    }
    return std::pair(ill_posed, largest);
  };
  const auto [some, bound] = counted(false);
  const auto [all, exact] = counted(true);
  EXPECT_LE(some, all);
  EXPECT_LT(exact, bound);
}

// Near theta = pi: logarithms with the opposite axis and the angle 2 pi - theta.

using O = TypedOperations<double>;

const O& liecheck_itself() {
  return own_subject().operations;
}
O::V3 flipped(const O::V3& phi) {
  return -(2 * M_PI / phi.norm() - 1) * phi;
}
O::V6 flipped(const O::V6& xi) {
  const O::V3 phi = flipped(O::V3(xi.tail<3>())), p = liecheck_itself()[op::exp6](xi).p;
  return (O::V6() << liecheck_itself()[op::left_jacobian3_inverse](phi) * p, phi).finished();
}
const TypedSubject<double>& other_side() {
  static const TypedSubject<double> subject = [] {
    TypedSubject<double> s{"other_side", "", {}};
    O& o = s.operations;
    o[op::log3_quaternion] = [](const O::V4& Q) {
      return flipped(liecheck_itself()[op::log3_quaternion](Q));
    };
    o[op::log6] = [](const Pose<double>& X) { return flipped(liecheck_itself()[op::log6](X)); };
    o[op::difference] = [](const O::V7& a, const O::V7& b) {
      return flipped(liecheck_itself()[op::difference](a, b));
    };
    o[op::d_difference_arg0] = [](const O::V7& a, const O::V7& b) -> O::M6 {
      return -liecheck_itself()[op::left_jacobian6_inverse](flipped(liecheck_itself()[op::difference](a, b)));
    };
    o[op::d_difference_arg1] = [](const O::V7& a, const O::V7& b) {
      return liecheck_itself()[op::right_jacobian6_inverse](flipped(liecheck_itself()[op::difference](a, b)));
    };
    return s;
  }();
  return subject;
}

/// Whether each measured operation passes for a rotation by pi - angle about (3, 0, 4) / 5.
std::map<std::string, bool> passes(const char* law, double angle, const std::string& fields) {
  static const Subject tested = erased(other_side());
  const auto series = series_of(law, tested, built_in_robot());
  const double w = std::sin(angle / 2), s = std::cos(angle / 2);
  const auto list = [](std::initializer_list<double> x) { return fmt::format("{:a}", fmt::join(x, ",")); };
  const Eigen::Quaterniond Q(w, 0.6 * s, 0, 0.8 * s);
  const Eigen::Matrix3d R = Q.toRotationMatrix();
  const std::string q = list({Q.x(), Q.y(), Q.z(), Q.w()}),
                    r = list(
                        {R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)});
  std::string text = fields;
  for (const auto& [name, value] : {std::pair{"Q1", q}, std::pair{"R1", r}})
    if (const auto at = text.find(name); at != text.npos) text.replace(at, 2, value);
  CaseId id = series->id(0, 0);
  id.raw = true;
  std::istringstream numbers(text);
  for (std::string x; std::getline(numbers, x, ',');) id.input.push_back(x);
  std::map<std::string, bool> passed;
  for (const Judged& j : series->replay(id)) {
    const Output& o = series->outputs.at(j.residual.output);
    const auto [at, first] = passed.emplace(o.operation, true);
    at->second &= !j.failed && j.residual.outcome == Outcome::measured;
  }
  return passed;
}

TEST(NearPi, AStoredQuaternionDecidesTheSideAndAMatrixDoesNot) {
  const double eps = std::numeric_limits<double>::epsilon();
  const std::string fields = "Q1,R1,1,2,3";
  EXPECT_EQ(passes("log_oracle", eps, fields),
            (std::map<std::string, bool>{{"log3_quaternion", false}, {"log6", true}}));
  EXPECT_EQ(passes("log_oracle", 20 * eps, fields),
            (std::map<std::string, bool>{{"log3_quaternion", false}, {"log6", false}}));
}

TEST(NearPi, ADifferenceAndItsDerivativesMayTakeEitherSide) {
  const double eps = std::numeric_limits<double>::epsilon();
  const std::string fields = "1,2,3,0,0,0,1,3,1,5,Q1,1,2,3,1,0,0";
  EXPECT_EQ(passes("integrate_difference", eps, fields), (std::map<std::string, bool>{{"difference", true}}));
  EXPECT_EQ(passes("integrate_difference", 20 * eps, fields),
            (std::map<std::string, bool>{{"difference", false}}));
  const std::map<std::string, bool> both{{"d_difference_arg0", true}, {"d_difference_arg1", true}},
      none{{"d_difference_arg0", false}, {"d_difference_arg1", false}};
  EXPECT_EQ(passes("d_integrate", eps, fields), both);
  EXPECT_EQ(passes("d_integrate", 0, fields), both);
  EXPECT_EQ(passes("d_integrate", 20 * eps, fields), none);
}

}  // namespace
}  // namespace liecheck::properties

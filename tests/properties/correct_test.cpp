// Nothing right is accused: correct implementations stay within limits of four times their largest error
// (fixtures/limits, written by `liecheck bench limits --out`), which still refuse a faulty one.

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <campaign/needs.hpp>
#include <campaign/robots.hpp>
#include <cmath>
#include <sstream>
#include <support/files.hpp>

namespace liecheck::properties {
namespace {

std::vector<std::string> correct_subjects() {
  std::vector<std::string> names = subject_names();
  std::erase_if(names, [](const std::string& n) { return !n.starts_with("correct:"); });
  return names;
}

OwnLimits limits_of(std::string subject) {
  std::replace(subject.begin(), subject.end(), ':', '_');
  return parse_limits(read_whole(LIECHECK_FIXTURES "/limits/" + subject + ".limits"));
}

std::map<std::string, Needs> campaign(const std::vector<std::string>& subjects, std::uint64_t cases) {
  CampaignOptions o;
  o.selection.subjects = subjects;
  o.seed = 20, o.cases = cases, o.jobs = 2, o.quiet = true;
  return needs_of(run_campaign(o, built_in_robot()));
}

template <class S>
void expect_eight_of_each() {
  Operations<S>::for_each([](const auto& operation) {
    const auto all = subjects<S>();
    const auto offers = [&](const Subject<S>* s) {
      return s->name.starts_with("correct:") && s->operations[operation] != nullptr;
    };
    EXPECT_GE(std::ranges::count_if(all, offers), 8) << operation.name;
  });
}

TEST(Correct, AtLeastEightImplementationsOfferEachOperationOnPosesAndBodies) {
  expect_eight_of_each<float>();
  expect_eight_of_each<double>();
}

TEST(Correct, NoCorrectImplementationIsAccused) {
  const auto names = correct_subjects();
  const auto found = campaign(names, 150);
  EXPECT_EQ(found.size(), names.size());
  for (const auto& [subject, needs] : found) {
    EXPECT_GE(needs.size(), 30u) << subject;
    for (const auto& [key, need, limit] : accusations(needs, limits_of(subject)))
      ADD_FAILURE() << subject << ": " << key.operation << ", " << key.block << ", " << key.region << ": "
                    << need.largest << " > " << limit << ", broken " << need.broken << ", unresolved "
                    << need.unresolved << ": " << need.worst;
  }
}

TEST(Correct, TheSameLimitsAccuseAFormulaThatCancels) {
  const auto found = campaign({"textbook"}, 150);
  int accused = 0;
  for (const auto& [key, need, limit] : accusations(found.at("textbook"), limits_of("correct:books")))
    accused += key.operation == "exp6" || key.operation == "left_jacobian6";
  EXPECT_GE(accused, 2);
}

TEST(Limits, ExceededOrBrokenOrUnresolvedIsAccused) {
  const LimitKey key{"exp6", "translation", "to_pi", "forward"};
  const auto accused = [&](double largest, std::uint64_t broken, std::uint64_t unresolved) {
    const Needs needs{{key, {largest, 2, broken, unresolved, ""}}};
    return std::pair(accusations(needs, {{key, 4}}).size(), accusations(needs, {}).size());
  };
  EXPECT_EQ(accused(1, 0, 0), (std::pair<std::size_t, std::size_t>(0, 0)));
  EXPECT_EQ(accused(3, 0, 0), (std::pair<std::size_t, std::size_t>(0, 1)));  // 2 is the limit of the table
  EXPECT_EQ(accused(5, 0, 0), (std::pair<std::size_t, std::size_t>(1, 1)));
  EXPECT_EQ(accused(1, 1, 0), (std::pair<std::size_t, std::size_t>(1, 1)));
  EXPECT_EQ(accused(1, 0, 1), (std::pair<std::size_t, std::size_t>(1, 1)));
}

TEST(Limits, AreFourTimesTheNeedAndAreReadAsTheyAreWritten) {
  const LimitKey key{"exp6", "orthogonality defect", "any", "forward"},
      none{"inverse", "matrix", "any", "forward"};
  const OwnLimits limits = limits_for({{key, {2.5, 8, 0, 0, ""}}, {none, {0, 8, 0, 0, ""}}});
  EXPECT_EQ(limits, (OwnLimits{{key, 10}}));
  EXPECT_EQ(parse_limits(text_of("correct:books", limits, "measured")), limits);
  EXPECT_THROW(parse_limits("[limits]\nexp6, translation, any, forward = much\n"), std::runtime_error);
}

// Near theta = pi: logarithms with the opposite axis and the angle 2 pi - theta.

using O = Operations<double>;

const O& own() {
  for (const auto* s : subjects<double>())
    if (s->name == "liecheck") return s->operations;
  throw std::logic_error("liecheck is not registered");
}
O::V3 flipped(const O::V3& phi) {
  return -(2 * M_PI / phi.norm() - 1) * phi;
}
O::V6 flipped(const O::V6& xi) {
  const O::V3 phi = flipped(O::V3(xi.tail<3>())), p = own()[op::exp6](xi).p;
  return (O::V6() << own()[op::left_jacobian3_inverse](phi) * p, phi).finished();
}
const Subject<double>& other_side() {
  static const Subject<double> subject = [] {
    Subject<double> s{"other_side", "", {}};
    O& o = s.operations;
    o[op::log3_quaternion] = [](const O::V4& Q) { return flipped(own()[op::log3_quaternion](Q)); };
    o[op::log6] = [](const Pose<double>& X) { return flipped(own()[op::log6](X)); };
    o[op::difference] = [](const O::V7& a, const O::V7& b) { return flipped(own()[op::difference](a, b)); };
    o[op::d_difference_arg0] = [](const O::V7& a, const O::V7& b) -> O::M6 {
      return -own()[op::left_jacobian6_inverse](flipped(own()[op::difference](a, b)));
    };
    o[op::d_difference_arg1] = [](const O::V7& a, const O::V7& b) {
      return own()[op::right_jacobian6_inverse](flipped(own()[op::difference](a, b)));
    };
    return s;
  }();
  return subject;
}

/// Whether each measured operation passes for a rotation by pi - angle about (3, 0, 4) / 5.
std::map<std::string, bool> passes(const char* law, double angle, const std::string& fields) {
  const auto series = series_of(law, other_side(), built_in_robot());
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

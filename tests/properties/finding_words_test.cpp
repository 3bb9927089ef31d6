// What a finding says of the numbers of one call: their signs and names, both results of a call that is not repeatable, and
// what the arguments' own defects cost.

#include <gtest/gtest.h>
#include <campaign/selection.hpp>
#include <campaign/series.hpp>
#include <cmath>
#include <failures/calls.hpp>
#include <failures/result.hpp>
#include <limits>

#include "../campaigns.hpp"
#include "../own_subject.hpp"
#include "finding_texts.hpp"

namespace liecheck::properties {
namespace {

/// The texts of the findings of a subject under the limits for ordinary code.
std::vector<std::string> findings_under_careful(const TypedSubject<double>& s,
                                                const std::vector<std::string>& laws) {
  const Registered<double> registered(s);
  return finding_texts(s.name, laws);
}
TypedSubject<double> named(const std::string& name) {
  TypedSubject<double> s;
  s.name = "words:" + name;
  return s;
}
const TypedOperations<double>& right() {
  return own_subject().operations;
}

TEST(FindingWords, ARateIsNoRotationAndHasItsSign) {
  TypedSubject<double> s = named("rate");
  s.operations[op::velocity_to_rate] = [](const Vec<double, 7>& q,
                                          const Vec<double, 6>& V) -> Vec<double, 7> {
    Vec<double, 7> rate = right()[op::velocity_to_rate](q, V);
    rate.tail<4>() *= -1;
    return rate;
  };
  const auto all = findings_under_careful(s, {"coefficient_rates"});
  ASSERT_EQ(all.size(), 1u);
  EXPECT_TRUE(says(all[0], "            Q_dot.")) << all[0];
  EXPECT_FALSE(says(all[0], "and -0 is right") || says(all[0], "is 0, and 0 is right")) << all[0];
}

TEST(FindingWords, AnOrderOfEulerAnglesHasItsName) {
  TypedSubject<double> s = named("order");
  s.operations[op::euler_to_quaternion] = [](const double& order, const Vec<double, 3>& angles) {
    return right()[op::euler_to_quaternion](order, order == 7 ? Vec<double, 3>(-angles) : angles);
  };
  const auto all = findings_under_careful(s, {"euler_angles"});
  ASSERT_EQ(all.size(), 1u);
  EXPECT_TRUE(says(all[0], "order = YZX, rotating (7)")) << all[0];
}

TEST(FindingWords, ACallThatIsNotRepeatableShowsBothResultsAndBlamesNoOther) {
  TypedSubject<double> s = named("turns");
  s.operations[op::log3_quaternion] = right()[op::log3_quaternion];
  s.operations[op::log3_matrix] = [](const Mat<double, 3>& R) -> Vec<double, 3> {
    static thread_local int calls = 0;
    const Vec<double, 3> phi = right()[op::log3_matrix](R);
    return ++calls % 3 ? phi : Vec<double, 3>(1.5 * phi);
  };
  const auto all = findings_under_careful(s, {"log_oracle"});
  ASSERT_EQ(all.size(), 1u);
  EXPECT_TRUE(says(all[0], "1  log3_matrix")) << all[0];
  EXPECT_TRUE(says(all[0], " when the same call is made again\n")) << all[0];
}

TEST(FindingWords, AFailedCallBlamesNoOtherOperationOfItsCase) {
  TypedSubject<double> s = named("fails_at_times");
  s.operations[op::log3_quaternion] = right()[op::log3_quaternion];
  s.operations[op::log3_matrix] = [](const Mat<double, 3>& R) -> Vec<double, 3> {
    static thread_local int calls = 0;
    if (++calls % 50 == 0) throw CallFailed("another result", "log3_matrix", Outcome::not_repeatable);
    return right()[op::log3_matrix](R);
  };
  const auto all = findings_under_careful(s, {"log_oracle"});
  ASSERT_EQ(all.size(), 1u);
  EXPECT_TRUE(says(all[0], "1  log3_matrix (rotation vector): not repeatable")) << all[0];
}

TEST(FindingWords, AnAngleMayCostWhatItsQuaternionsAreOffUnitBy) {
  TypedSubject<double> s = named("difference_of_stored");
  s.operations[op::relative_angle] = [](const Vec<double, 4>& Q0, const Vec<double, 4>& Q1) {
    const Vec<double, 4> other = Q0.dot(Q1) < 0 ? Vec<double, 4>(-Q1) : Q1;
    return 4 * std::atan2((Q0 - other).norm(), (Q0 + other).norm());
  };
  const auto none = findings_under_careful(s, {"relative_rotation"});
  EXPECT_EQ(none.size(), 0u) << none.at(0);
  TypedSubject<double> of_equal = named("angle_of_equal");
  of_equal.operations[op::relative_angle] = [](const Vec<double, 4>& Q0, const Vec<double, 4>& Q1) {
    return Q0 == Q1 ? 2e-16 : right()[op::relative_angle](Q0, Q1);
  };
  EXPECT_EQ(findings_under_careful(of_equal, {"relative_rotation"}).size(), 1u);
}

/// How many of 40 cases of exp6 fail by their defect, of a library whose R is that of a Q whose square is off 1 by so many eps;
/// and what is said of one.
template <int eps>
std::pair<std::uint64_t, std::string> defects() {
  TypedSubject<double> s = named("off");
  s.operations[op::exp6] = [](const Vec<double, 6>& xi) -> Pose<double> {
    Pose<double> X = right()[op::exp6](xi);
    X.R *= 1 + eps * std::numeric_limits<double>::epsilon();
    return X;
  };
  Subject tested = erased(s);
  tested.takes.quaternion_poses = true;
  const auto series = series_of("exp_oracle", tested, built_in_robot());
  Tally tally;
  for (std::uint64_t i = 0; i < 40; ++i) series->run(42, i, tally);
  std::uint64_t failed = 0;
  std::string text;
  for (const auto& [cell, row] : tally.rows) {
    const auto output = static_cast<std::size_t>(cell.first);
    if (series->outputs[output].block != "orthogonality defect") continue;
    failed += row.failed;
    text = worst_number_text(*series, series->outputs[output], noted(*series, series->id(42, 0), output));
  }
  return {failed, text};
}

TEST(FindingWords, ThePoseOfAQuaternionIsJudgedByTheQuaternion) {
  EXPECT_EQ(defects<4>().first,
            0u);  // within the 8 eps that R may have, although that of R is 2 sqrt(3) times as large
  const auto [failed, text] = defects<400>();
  EXPECT_GT(failed, 0u);
  EXPECT_TRUE(text.starts_with("|Q|^2 is 1.000000000000088")) << text;
}

TEST(FindingWords, AllDigitsAreNotCountedAgain) {
  const double eps = std::numeric_limits<double>::epsilon();
  EXPECT_EQ(digits_lost(0.995 / eps, eps), "all 15.7 digits lost");
  EXPECT_EQ(digits_lost(1e7, eps), "7.0 of 15.7 digits lost");
}

}  // namespace
}  // namespace liecheck::properties

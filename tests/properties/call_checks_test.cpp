// Calls that are not repeatable, write to an argument or leave output unwritten are outcomes of their own.
// Without the checks, such a case passes, or looks like a disagreement of the oracles.

#include <gtest/gtest.h>
#include <algorithm>
#include <atomic>
#include <campaign/series.hpp>
#include <failures/description.hpp>
#include <search/shrink.hpp>
#include <subjects/number_function.hpp>
#include <subjects/tree.hpp>
#include <thread>

#include "../campaigns.hpp"
#include "../own_subject.hpp"

namespace liecheck::properties {
namespace {

using O = TypedOperations<double>;
using V3 = O::V3;
using V4 = O::V4;
using V6 = O::V6;
using X = VecX<double>;

const O& good() {
  return own_subject().operations;
}

/// Changes the last bit of x in every second call.
void flicker(double& x) {
  static std::atomic<int> calls{0};
  if (++calls % 2 == 0) x = std::nextafter(x, 2 * std::fabs(x) + 1);
}

/// `f`, which gives its last result again for as long as the key of its input is the same.
template <class F, class Key>
auto kept_while(F f, Key key) {
  return [f, key, last = std::make_shared<std::pair<X, X>>()](const auto&... x) {
    if (const X now = key(x...); now.size() != last->first.size() || now != last->first)
      *last = {now, f(x...)};
    return last->second;
  };
}

const Registered<double> subjects_with_bad_calls[] = {
    registered("call:exhausts", op::exp6,
               [](const V6& xi) {
                 if (xi.size() > 0) throw std::bad_alloc();
                 return good()[op::exp6](xi);
               }),
    registered("call:flickers", op::exp6,
               [](const V6& xi) {
                 auto T = good()[op::exp6](xi);
                 flicker(T.p[0]);
                 return T;
               }),
    registered("call:writes", op::exp6,
               [](const V6& xi) {
                 auto T = good()[op::exp6](xi);
                 const_cast<V6&>(xi)[0] = 7;  // NOLINT: the fault
                 return T;
               }),
    registered("call:leaves", op::exp3_quaternion,
               [](const V3& phi) -> V4 {
                 V4 Q;
                 Q.head<3>() = good()[op::exp3_quaternion](phi).head<3>();
                 return Q;
               }),
    registered("call:nan", op::exp6,
               [](const V6& xi) {  // NaN, in every second call with its sign bit
                 static std::atomic<int> calls{0};
                 auto T = good()[op::exp6](xi);
                 T.p[1] = std::copysign(std::numeric_limits<double>::quiet_NaN(), ++calls % 2 ? 1.0 : -1.0);
                 return T;
               }),
    registered("call:once", op::exp6,
               [](const V6& xi) {
                 static std::atomic<int> calls{0};
                 auto T = good()[op::exp6](xi);
                 if (++calls == 23) T.p *= 1.5;
                 return T;
               }),
    registered("call:robot",
               [](O& o) {
                 o.robot = [](const std::string& urdf, bool fixed) {
                   auto r = good().robot(urdf, fixed);
                   r[op::robot_integrate] = [f = r[op::robot_integrate]](const X& q, const X& d) {
                     X next = f(q, d);
                     flicker(next[0]);
                     return next;
                   };
                   return r;
                 };
               }),
    registered("call:kept",
               [](O& o) {
                 o.tree = [](const Tree<double>& tree) {
                   auto t = good().tree(tree);
                   t[op::tree_gravity] =
                       kept_while(t[op::tree_gravity], [](const X& q) { return X(q.head(1)); });
                   t[op::tree_nonlinear_effects] =
                       kept_while(t[op::tree_nonlinear_effects], [](const X& q, const X&) { return q; });
                   return t;
                 };
               }),
    registered("call:tree", [](O& o) {
      o.tree = [](const Tree<double>& tree) {
        auto t = good().tree(tree);
        t[op::tree_gravity] = [f = t[op::tree_gravity]](const X& q) {
          X tau = f(q);
          flicker(tau[0]);
          return tau;
        };
        return t;
      };
    })};

CampaignResult run(const std::string& subject, const std::string& property, std::uint64_t cases = 40) {
  return run_quietly({{subject}, {property}, {"double"}}, cases);
}

/// The sum of a count over the rows of an operation.
std::uint64_t sum(const CampaignResult& r, const Operation& operation, std::uint64_t Row::*count) {
  std::uint64_t n = 0;
  const SeriesResult& s = r.series.at(0);
  for (const auto& [cell, row] : s.tally.rows)
    if (s.series->outputs.at(static_cast<std::size_t>(cell.first)).record == &operation) n += row.*count;
  return n;
}

std::unique_ptr<Series> series(const std::string& subject, const std::string& property) {
  return std::move(select({{subject}, {property}, {"double"}}, built_in_robot()).at(0));
}
bool failed(const std::vector<Judged>& judged) {
  return std::any_of(judged.begin(), judged.end(), [](const Judged& j) { return j.failed; });
}
const std::vector<double> twist = {0.5, -0.25, 1.5, 0.25, 1, -0.5};

TEST(CallChecks, ACallThatIsNotRepeatableFailsAndNeverMakesTheOraclesDisagree) {
  const auto s = series("call:flickers", "exp_oracle");
  EXPECT_FALSE(failed(s->measure(twist)));  // the error of the last bit is within budget
  const auto oracles_agree = [&] {
    Judge balls = s->judge_of_balls();
    EXPECT_TRUE(s->measure_by_balls(twist, balls));
    return agree(balls.judged, s->measure_by_digits(twist, s->limits()));
  };
  EXPECT_FALSE(oracles_agree());
  {
    const Series::Checking checking(*s, true);
    EXPECT_TRUE(oracles_agree());
  }
  const CampaignResult r = run("call:flickers", "exp_oracle", 1100);
  EXPECT_TRUE(r.failed);
  EXPECT_GE(r.series.at(0).tally.checked, 2u);
  EXPECT_TRUE(r.series.at(0).tally.disagreed.empty());
  EXPECT_GE(sum(r, op::exp6, &Row::not_repeatable), 3u * 275u);  // three blocks, one case in four
  EXPECT_EQ(sum(r, op::exp6, &Row::failed), sum(r, op::exp6, &Row::not_repeatable));
}

TEST(CallChecks, AnExhaustedMemoryIsNoVerdict) {
  EXPECT_THROW(run("call:exhausts", "exp_oracle"), std::bad_alloc);
}

TEST(CallChecks, ANaNIsTheSameAsOneOfTheOtherSign) {
  const CampaignResult r = run("call:nan", "exp_oracle");
  EXPECT_EQ(sum(r, op::exp6, &Row::not_repeatable), 0u);
  EXPECT_GE(sum(r, op::exp6, &Row::not_finite), 40u);
}

TEST(CallChecks, AnArgumentThatIsWrittenToFails) {
  const auto s = series("call:writes", "exp_oracle");
  EXPECT_FALSE(failed(s->measure(twist)));
  EXPECT_TRUE(failed(s->measure_twice(twist)));
  const CampaignResult r = run("call:writes", "exp_oracle", 160);
  EXPECT_TRUE(r.failed);
  EXPECT_EQ(sum(r, op::exp6, &Row::argument_written), 3u * 40u);
  EXPECT_EQ(sum(r, op::exp6, &Row::not_repeatable), 0u);
}

TEST(CallChecks, OutputThatIsLeftUnwrittenFailsWhateverTheMemoryHeld) {
  for (const auto* subject : typed_subjects<double>()) {
    if (subject->name != "call:leaves") continue;
    CallLog log;
    CallLog::current() = &log;
    erased(*subject).operations[op::exp3_quaternion](V3(1, 2, 3));
    CallLog::current() = nullptr;
    ASSERT_EQ(log.findings.size(), 1u);
    EXPECT_EQ(log.findings[0].outcome, Outcome::output_unwritten);
    EXPECT_EQ(log.findings[0].operation, &op::exp3_quaternion);
  }
  const CampaignResult r = run("call:leaves", "exp_oracle", 160);
  EXPECT_TRUE(r.failed);
  EXPECT_GE(sum(r, op::exp3_quaternion, &Row::output_unwritten), 2u * 40u);
}

TEST(CallChecks, AFailureThatDoesNotReproduceSaysSoAndIsNotShrunk) {
  const CampaignResult r = run("call:once", "exp_oracle");
  EXPECT_TRUE(r.failed);
  const SeriesResult& s = r.series.at(0);
  int described = 0;
  for (const auto& [cell, row] : s.tally.rows) {
    if (!row.failed) continue;
    EXPECT_EQ(row.failed, row.not_repeatable);
    const std::string text =
        describe_failure(*s.series, r.options.seed, cell.first, cell.second, row, r.robot);
    EXPECT_NE(text.find("not repeatable: measured again, this case passes; so it is not shrunk"),
              std::string::npos)
        << text;
    EXPECT_EQ(text.find("  input "), std::string::npos) << text;
    ++described;
  }
  EXPECT_GE(described, 1);
}

TEST(CallChecks, AWrittenArgumentIsShrunkAndAFlickeringResultIsNot) {
  for (const char* name : {"call:writes", "call:flickers"}) {
    const auto s = series(name, "exp_oracle");
    CaseId id = s->id(0, 0);
    id.raw = true;
    for (const double x : twist) id.input.push_back(hexadecimal_float(x));
    const Shrunk small = shrink(*s, id, 6, 500);  // exp6, translation
    EXPECT_TRUE(small.judged.failed) << name;
    EXPECT_EQ(small.reproduced, name == std::string("call:writes"));
    EXPECT_EQ(small.id.input == id.input, !small.reproduced);
    EXPECT_EQ(small.judged.residual.outcome,
              small.reproduced ? Outcome::argument_written : Outcome::not_repeatable);
  }
}

TEST(CallChecks, ConcernTheFunctionsOfRobotsAndTrees) {
  const CampaignResult robot = run("call:robot", "robot_configuration"), tree = run("call:tree", "lagrange");
  EXPECT_GE(sum(robot, op::robot_integrate, &Row::not_repeatable), 1u);
  EXPECT_EQ(sum(robot, op::robot_difference, &Row::not_repeatable), 0u);
  EXPECT_GE(sum(tree, op::tree_gravity, &Row::not_repeatable), 1u);
  EXPECT_EQ(sum(tree, op::tree_rnea, &Row::not_repeatable), 0u);
}

TEST(CallChecks, WhatIsKeptWhileTheFirstNumberOfQOrQIsTheSameIsFound) {
  const CampaignResult r = run("call:kept", "lagrange", 64);  // the calls of two cases have neighbours
  EXPECT_GE(sum(r, op::tree_gravity, &Row::not_repeatable), 1u);
  EXPECT_GE(sum(r, op::tree_nonlinear_effects, &Row::not_repeatable), 1u);
  EXPECT_EQ(sum(r, op::tree_rnea, &Row::failed), 0u);
}

TEST(CallChecks, FindNothingInCorrectCallsOfAnyScalarAndLaw) {
  for (const char* scalar : {"float", "double"}) {
    const CampaignResult r = run_quietly({{"liecheck", "textbook"}, {}, {scalar}}, 33);
    EXPECT_GT(r.series.size(), 10u);
    for (const SeriesResult& s : r.series)
      for (const auto& [cell, row] : s.tally.rows)
        EXPECT_EQ(row.not_repeatable + row.argument_written + row.output_unwritten, 0u)
            << s.series->property << " " << s.series->subject << " " << scalar;
  }
}

TEST(CallHook, RunsInThePlaceOfEachCallOfItsThreadAlone) {
  const auto all = subjects(oracles::scalar_of<double>);
  const Operations& o = (*std::ranges::find(all, "liecheck", &Subject::name))->operations;
  const V3 phi(0.1, 0.2, 0.3);
  const V4 Q = o[op::exp3_quaternion](phi), shifted = Q + V4::Unit(0);
  CallHook shift = [](const NumberFunction& f, void* arguments, void* results) {
    EXPECT_TRUE(f.operation == &op::exp3_quaternion);
    f.compute(arguments, results);
    static_cast<double*>(results)[0] += 1;
  };
  call_hook() = &shift;
  EXPECT_EQ(o[op::exp3_quaternion](phi), shifted);
  std::thread([&] { EXPECT_EQ(o[op::exp3_quaternion](phi), Q); }).join();
  call_hook() = nullptr;
  EXPECT_EQ(o[op::exp3_quaternion](phi), Q);
}

}  // namespace
}  // namespace liecheck::properties

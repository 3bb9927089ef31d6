// An adapter whose poses are (p, Q) is given both signs of Q, and what is wrong at w < 0 is found.

#include <gtest/gtest.h>
#include <adapters/check.hpp>
#include <adapters/sizes.hpp>
#include <adapters/subjects.hpp>
#include <campaign/series.hpp>
#include <cmath>
#include <failures/calls.hpp>
#include <failures/program.hpp>
#include <fstream>
#include <operations/quaternion_poses.hpp>
#include <search/condition.hpp>
#include <sstream>

#include "../adapters/quaternion_poses.hpp"
#include "../campaigns.hpp"
#include "../scratch.hpp"
#include "../shell.hpp"

namespace liecheck::test {
LIECHECK_SUBJECT(QuaternionPoses, log6, exp6, compose, inverse, act_point)
}

namespace liecheck::properties {
namespace {

using test::QuaternionPoses;

constexpr std::pair<const char*, const char*> laws[] = {{"log6", "log_oracle"},
                                                        {"compose", "pose_group"},
                                                        {"inverse", "pose_group"},
                                                        {"act_point", "pose_group"}};

/// Registers the library with a fault in one operation, or none.
QuaternionPoses& library(const char* name, const char* fault) {
  auto* const object = new QuaternionPoses;  // is used as long as the program runs
  object->name = name, object->fault = fault;
  adapters::register_adapter(*new liecheck_adapter(liecheck_described(*object)));
  return *object;
}

TEST(QuaternionPoses, OfARightLibraryPassWithBothSigns) {
  const QuaternionPoses& right = library("right_poses", "");
  const CampaignResult r = run_quietly({{"right_poses"}, {}, {}}, 2000);
  EXPECT_FALSE(r.failed);
  EXPECT_TRUE(r.measured);
  const double all = right.seen[0] + right.seen[1];
  EXPECT_GT(all, 8000);
  EXPECT_NEAR(right.seen[1] / all, 0.5, 0.03);
}

TEST(QuaternionPoses, WithAFaultWhereWIsNegativeFailThere) {
  for (const auto& [operation, law] : laws) {
    const std::string name = std::string("wrong_") + operation;
    library(name.c_str(), operation);
    const CampaignResult r = run_quietly({{name}, {law}, {}}, 500);
    EXPECT_TRUE(r.failed) << operation;
    const Series& s = *r.series.at(0).series;
    for (std::size_t i = 0; i < s.outputs.size(); ++i) {
      if (s.outputs[i].operation != operation || s.outputs[i].block == "linear" ||
          (s.outputs[i].block == "matrix") != (std::string(operation) == "compose"))
        continue;
      const auto where = condition_of(s, i, 42);
      ASSERT_TRUE(where) << operation;
      EXPECT_EQ(where->text, std::string(operation) == "compose" ? "Q_Y.w < 0" : "Q.w < 0");
    }
  }
}

TEST(QuaternionPoses, HaveTheirSizesInCppToo) {
  for (std::size_t i = 0; i < adapters::operation_sizes().size(); ++i) {
    const adapters::OperationSizes &of = adapters::quaternion_sizes()[i], &plain = adapters::all_sizes()[i];
    const auto in_cpp = liecheck::adapter::sizes_of(of.operation, true);
    EXPECT_EQ(in_cpp.inputs, of.inputs) << of.operation;
    EXPECT_EQ(in_cpp.results, of.results) << of.operation;
    EXPECT_EQ(adapters::place_of(of), i);
    EXPECT_EQ(adapters::place_of(plain), i);
  }
}

TEST(QuaternionPoses, FollowFromTheNumbersOfTheCall) {
  const std::vector<double> X{0, -1, 0, 1, 0, 0, 0, 0, 1, 1, 2, 3}, x{4, 5, 6};
  std::vector<double> all = X;
  all.insert(all.end(), x.begin(), x.end());
  const auto given = poses_as_quaternions(op::act_point, all, false);
  EXPECT_EQ(given, poses_as_quaternions(op::act_point, all, false));
  ASSERT_EQ(given.size(), 10u);
  const double half = std::sqrt(0.5), sign = given[6] < 0 ? -1 : 1;
  EXPECT_EQ(given, (std::vector<double>{1, 2, 3, 0, 0, sign * half, sign * half, 4, 5, 6}));
  EXPECT_EQ(poses_as_quaternions(op::act_point, all, true)[5], double(float(sign * half)));
  const auto back = poses_as_matrices(*op::inverse.results[0], std::span(given).first(7), false);
  for (std::size_t i = 0; i < 12; ++i) EXPECT_NEAR(back[i], X[i], 1e-15);
}

TEST(QuaternionPoses, KeepSmallAndLargeAngles) {
  for (const double angle : {1e-300, 1e-12, 0.3, 3.0}) {
    const double c = std::cos(angle), s = std::sin(angle);
    const std::vector<double> X{1, 0, 0, 0, c, -s, 0, s, c, 0, 0, 0};
    const auto Q = poses_as_quaternions(op::inverse, X, false);
    EXPECT_NEAR(std::fabs(Q[3]) / std::sin(angle / 2), 1, 4e-16);
    EXPECT_NEAR(std::fabs(Q[6]), std::cos(angle / 2), 4e-16);
  }
}

TEST(QuaternionPoses, AreThoseOfAReplayAndOfItsWords) {
  library("shown_poses", "inverse");
  const CampaignResult r = run_quietly({{"shown_poses"}, {"pose_group"}, {}}, 300);
  const Series& s = *r.series.at(0).series;
  const std::size_t translation = 3;
  ASSERT_EQ(s.outputs[translation].operation, "inverse");
  for (std::uint64_t i = 0; i < 40; ++i) {
    CaseId raw = s.id(42, i);
    raw.input = s.input(raw), raw.raw = true;
    bool failed = false;
    for (const Judged& j : s.replay(raw)) failed = failed || j.failed;
    const std::string words = adapter_program(s, s.outputs[translation], noted(s, raw, translation), raw);
    ASSERT_NE(words.find("inverse in double\n    X "), words.npos) << words;
    // p, w x y z as the adapter is given them
    const std::string numbers = words.substr(words.find("    X ") + 6);
    std::istringstream list(numbers.substr(0, numbers.find('\n')));
    std::vector<double> x;
    for (std::string one; std::getline(list, one, ',');) x.push_back(std::stod(one));
    ASSERT_EQ(x.size(), 7u) << words;
    EXPECT_EQ(failed, x[3] < 0) << words;
  }
}

TEST(QuaternionPoses, OfProgramsAndOfLibrariesInAProcessAreTheSame) {
  const std::string program = liecheck::scratch() + "/quaternion_poses.py";
  std::ofstream(program) << R"(
import json, sys
import numpy as np
calls, answers = sys.stdin.buffer, sys.stdout.buffer
calls.readline()
answers.write(json.dumps({"protocol": 1, "name": "poses_in_python", "version": "1", "operations": {"inverse": ["double"]},
                          "conventions": {"pose form": "quaternion"}}).encode() + b"\n")
answers.flush()
for call in iter(calls.readline, b""):
    n = int(call.split()[3])
    X = np.frombuffer(calls.read(56 * n)).reshape(n, 7)
    p, v, w = X[:, :3], -X[:, 3:6], X[:, 6:]
    t = 2 * np.cross(v, p)
    answers.write(b"done %d\n" % n + bytes(n) + np.hstack([-(p + w * t + np.cross(v, t)), v, w]).tobytes())
    answers.flush()
)";
  for (const std::string& adapter :
       {"'/usr/bin/python3 " + program + "'", std::string(LIECHECK_QUATERNION_POSES),
        std::string("in-process:" LIECHECK_QUATERNION_POSES)}) {
    const auto [code, text] = shell(LIECHECK_PROGRAM " adapter check " + adapter);
    EXPECT_EQ(code, 0) << text;
    const auto campaign =
        shell(LIECHECK_PROGRAM " campaign --no-hard-cases --cases 300 --adapter " + adapter);
    EXPECT_EQ(campaign.code, 0) << campaign.text;
  }
}

}  // namespace
}  // namespace liecheck::properties

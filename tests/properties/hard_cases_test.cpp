// The corpus of hard cases: its lines, their parser, and one planted subject for each verdict.

#include <gtest/gtest.h>

#include <atomic>
#include <campaign/robots.hpp>
#include <cmath>
#include <fstream>
#include <hard_cases/hard_cases.hpp>
#include <nlohmann/json.hpp>
#include <record/record.hpp>
#include <set>
#include <sstream>

#include "../own_subject.hpp"
#include "../refusal.hpp"
#include "../shell.hpp"

namespace liecheck::properties {
namespace {

using O = TypedOperations<double>;

const O& own_operations() {
  return own_subject().operations;
}

const Registered<double> planted[] = {
    registered(
        "verdict_inaccurate", op::log3_quaternion,
        [](const O::V4& Q) -> O::V3 { return own_operations()[op::log3_quaternion](Q) * (1 + 1e-14); }),
    registered("verdict_wrong_branch", op::log3_quaternion,
               [](const O::V4& Q) -> O::V3 {  // the same rotation, theta > pi
                 const O::V3 phi = own_operations()[op::log3_quaternion](Q);
                 return phi * (1 - 2 * M_PI / phi.norm());
               }),
    registered("verdict_sign", op::integrate,
               [](const O::V7& q, const O::V6& d) {
                 O::V7 r = own_operations()[op::integrate](q, d);
                 if (r[6] < 0) r.tail<4>() *= -1;
                 return r;
               }),
    registered("verdict_not_finite", op::log3_quaternion,
               [](const O::V4&) { return O::V3(O::V3::Constant(NAN)); }),
    registered("verdict_flickers", op::log3_quaternion,
               [](const O::V4& Q) -> O::V3 {
                 static std::atomic<int> calls{0};
                 return own_operations()[op::log3_quaternion](Q.normalized()) * (1 + ++calls * 1e-3);
               }),
    registered("verdict_refused", op::log3_quaternion,
               [](const O::V4&) -> O::V3 { throw std::range_error("no logarithms today"); }),
    registered("verdict_exp6_refused", [](O& o) {
      o[op::exp3_quaternion] = [](const O::V3& phi) -> O::V4 {
        return own_operations()[op::exp3_quaternion](phi);
      };
      o[op::exp6] = [](const O::V6&) -> Pose<double> {
        throw CallFailed("too far", op::exp6.name, Outcome::refused);
      };
    })};

HardCell cell(const std::string& subject, const std::string& line, const std::string& scalar = "double") {
  const auto cases = parse_corpus("here.txt", line);
  const auto rows = run_hard_cases({{subject}, {}, {scalar}}, built_in_robot(), cases);
  if (rows.size() != 1 || rows[0].cells.size() != 1) throw std::logic_error("one cell expected");
  return rows[0].cells[0];
}

const char* const unit_quaternion = "a | log_oracle | Q = unit(1, 2, 3, 4) | c | r | o";
const char* const off_unit = "a | log_oracle | Q = 1.001*unit(1, 2, 3, 4) | c | r | o";

TEST(HardCases, GiveEachPlantedSubjectItsVerdict) {
  const auto verdict = [](const HardCell& c) { return std::pair(c.verdict, c.failed); };
  EXPECT_EQ(verdict(cell("liecheck", unit_quaternion)), std::pair(Verdict::stable, false));
  const auto inaccurate = cell("verdict_inaccurate", unit_quaternion);
  EXPECT_EQ(verdict(inaccurate), std::pair(Verdict::inaccurate, true));
  EXPECT_NEAR(inaccurate.error, 1e-14 / 0x1p-52, 5);
  EXPECT_EQ(verdict(cell("verdict_wrong_branch", unit_quaternion)), std::pair(Verdict::wrong_branch, true));
  EXPECT_EQ(verdict(cell("verdict_not_finite", unit_quaternion)), std::pair(Verdict::not_finite, true));
  EXPECT_EQ(verdict(cell("verdict_sign",
                         "a | sign_continuity | Q0 = -unit(0, 0, 1, 9); phi = 0, 0, 0.1 | c | r | o")),
            std::pair(Verdict::wrong_branch, true));
  EXPECT_EQ(verdict(cell("liecheck", "a | exp_oracle | phi = 1e8, 0, 0 | c | r | o", "float")),
            std::pair(Verdict::ill_posed, false));
}

TEST(HardCases, ARefusalIsRightOnlyIfTheInputIsNoRotation) {
  const auto right = cell("liecheck", off_unit);
  EXPECT_EQ(right.verdict, Verdict::refused);
  EXPECT_FALSE(right.failed);
  EXPECT_NE(right.refusal.find("normalize"), std::string::npos);
  const auto wrong = cell("verdict_refused", unit_quaternion);
  EXPECT_EQ(wrong.verdict, Verdict::refused);
  EXPECT_TRUE(wrong.failed);
  EXPECT_EQ(wrong.refusal, "no logarithms today");
  // Beside a result that is ill-posed, the refusal counts.
  const auto beside = cell("verdict_exp6_refused", "a | exp_oracle | phi = 1e300, 0, 0 | c | r | o");
  EXPECT_EQ(beside.verdict, Verdict::refused);
  EXPECT_EQ(beside.operation, "exp6");
  EXPECT_TRUE(beside.failed);
  // textbook does not check its input. It takes acos of the w of Q, and is compared with the log of Q/|Q|.
  EXPECT_EQ(cell("textbook", off_unit).verdict, Verdict::inaccurate);
  EXPECT_EQ(cell("textbook", "a | log_oracle | R = -1, 0, 0, 0, -1, 0, 0, 0, -1 | c | r | o").verdict,
            Verdict::wrong_branch);
}

TEST(HardCases, WhatIsNoRotationAndWhatOverflowsIsJudgedByTheProfileOursOnly) {
  const auto cells = [](const char* subject, const char* line, Profile profile) {
    Selection selection{{subject}, {}, {"double"}};
    selection.profiles[""] = profile;
    const auto rows = run_hard_cases(selection, built_in_robot(), parse_corpus("here.txt", line));
    return rows.at(0).cells;
  };
  for (const char* line : {off_unit, "a | log_oracle | R = -1, 0, 0, 0, -1, 0, 0, 0, -1 | c | r | o",
                           "a | exp_oracle | phi = 1e300, 0, 0 | c | r | o"}) {
    EXPECT_EQ(cells("textbook", line, Profile::ours).size(), 1u) << line;
    EXPECT_EQ(cells("textbook", line, Profile::careful).size(), 0u) << line;
    EXPECT_EQ(cells("textbook", line, Profile::half).size(), 0u) << line;
  }
  EXPECT_EQ(cells("verdict_not_finite", unit_quaternion, Profile::careful).at(0).verdict,
            Verdict::not_finite);
  EXPECT_TRUE(cells("verdict_refused", unit_quaternion, Profile::careful).at(0).failed);
  EXPECT_EQ(cells("verdict_flickers", off_unit, Profile::careful).size(), 0u);
  // A NaN is excused only where the input is far from a rotation.
  const char* const slightly_off = "a | log_oracle | Q = (1 + 1e-7)*unit(1, 2, 3, 4) | c | r | o";
  EXPECT_EQ(cells("verdict_not_finite", off_unit, Profile::careful).size(), 0u);
  EXPECT_TRUE(cells("verdict_not_finite", slightly_off, Profile::careful).at(0).failed);
  EXPECT_EQ(cells("verdict_inaccurate", slightly_off, Profile::careful).size(), 0u);
  EXPECT_TRUE(cells("verdict_flickers", unit_quaternion, Profile::careful).at(0).failed);
}

TEST(HardCases, AreAllStableOrRightlyRefusedByLiecheck) {
  const auto rows = run_hard_cases({{"liecheck"}, {}, {"float", "double"}}, built_in_robot());
  for (const HardRow& r : rows) {
    const std::size_t scalars = r.entry->scalars.empty() ? 2 : r.cells.size();
    EXPECT_EQ(r.cells.size(), scalars) << r.entry->name << ": a law measured nothing";
    EXPECT_FALSE(r.cells.empty()) << r.entry->name;
    for (const HardCell& c : r.cells) {
      EXPECT_FALSE(c.failed) << r.entry->name << " " << c.scalar << " " << c.id.text();
      EXPECT_TRUE(c.verdict == Verdict::stable || c.verdict == Verdict::refused ||
                  c.verdict == Verdict::ill_posed);
    }
  }
}

TEST(Corpus, HasEveryClassAndEveryAxisAtPi) {
  std::set<std::string> classes;
  for (const HardCase& c : built_in_corpus()) classes.insert(c.hard_class);
  std::istringstream wanted(
      "theta^2 underflow,theta^2 overflow,subnormal,signed zero,cutoff,exactly pi,pi +- ulp,2 pi k,"
      "huge angle,w = +-0,-Q,off unit,off orthogonal,reflected,translation scale,"
      "cancelling translation,equal poses,nearly equal poses,needle,plate,point,mass ratio");
  for (std::string one; std::getline(wanted, one, ',');) EXPECT_TRUE(classes.count(one)) << one;
  EXPECT_GE(built_in_corpus().size(), 150u);
  std::set<std::string> directions;  // exactly pi about each of the 26 axes, for log and for exp
  for (const HardCase& c : built_in_corpus())
    if (c.name.rfind("pi_log_", 0) == 0 || c.name.rfind("pi_exp_", 0) == 0) directions.insert(c.name);
  EXPECT_EQ(directions.size(), 52u);
}

TEST(Corpus, RefusesAnInvalidLineWithItsFileLineAndValue) {
  const auto refusal = [](const std::string& text) {
    return test::refusal([&] {
      run_hard_cases({{"liecheck"}, {}, {"double"}}, built_in_robot(), parse_corpus("f.txt", text));
    });
  };
  const std::string head = "# a comment\n\n";
  const auto refused = [&](const std::string& line, const std::string& part) {
    const std::string said = refusal(head + line);
    EXPECT_EQ(said.rfind("f.txt:3: ", 0), 0u) << said;
    EXPECT_NE(said.find(part), std::string::npos) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  };
  refused("a | exp_oracle | phi = 1, 0, 0 | c | r", "5 columns");
  refused("a | exp_oracle | phi = 1, 0, 0 | c | | o", "column reason is empty");
  refused("A b | exp_oracle | phi = 1, 0, 0 | c | r | o", "'A b'");
  refused("a | exp | phi = 1, 0, 0 | c | r | o", "unknown property 'exp'");
  refused("a | exp_oracle in half | phi = 1, 0, 0 | c | r | o", "'half'");
  refused("a | exp_oracle | theta = 1 | c | r | o", "no field 'theta' here; fields: rho, phi");
  refused("a | exp_oracle | phi = 1, 0 | c | r | o", "takes 3 numbers, 2 were given: '1, 0'");
  refused("a | exp_oracle | phi = 1, 0, 0; phi = 1, 0, 0 | c | r | o", "twice");
  refused("a | exp_oracle | phi = 1, 0, 0; 7 | c | r | o", "'7'");
  refused("a | exp_oracle | phi = 1, 0, x | c | r | o", "'x' is unknown");
  refused("a | exp_oracle | 1, 2, 3 | c | r | o", "6 numbers are needed, 3 were given");
  refused("a | kinetic_energy | u = 1, 2, 3 | c | r | o", "field mass must be given");
  refused("a | kinetic_energy | mass = -1 | c | r | o", "not a valid input");
  refused("a | robot_configuration | q0 = 1 | c | r | o", "depends on the robot");
  EXPECT_NE(refusal("a | exp_oracle | phi = 1, 0, 0 | c | r | o\na | exp_oracle | phi = 2, 0, 0 | c | r | o")
                .find("f.txt:2: name 'a' is already used in f.txt:1"),
            std::string::npos);
  refused("a | exp_oracle | phi = 1, 0, 0 | c | \x1b[2J | o", "control character 0x1b in column 38");
  refused("a | exp_oracle | phi = 1, 0, 0 | c | \xff | o", "not UTF-8");
  for (const char* path : {"/nowhere/at/all.txt", "/", ""})
    EXPECT_THROW(read_corpus(path), std::invalid_argument);
}

TEST(Corpus, TakesTheInputOfAHuntUnchanged) {
  const auto c =
      cell("liecheck",
           "hunted | exp_oracle in double | 0x1p+0, -0x1.8p-3, 0, 0x1.5p-30, 0, -0x0p+0 | hunted | r | o");
  EXPECT_EQ(c.id.text(),
            "raw.exp_oracle.liecheck.double.none.0x1p+0,-0x1.8p-3,0x0p+0,0x1.5p-30,0x0p+0,-0x0p+0");
}

TEST(HardCases, AreRecordedWithInputAndReplay) {
  const auto cases = parse_corpus("here.txt", off_unit);
  const auto record =
      record_of(run_hard_cases({{"liecheck", "textbook"}, {}, {"double"}}, built_in_robot(), cases));
  for (const char* key : {"name", "class", "reason", "origin", "property", "expression", "input", "cells"})
    EXPECT_TRUE(record.at(0).contains(key)) << key;
  for (const char* key : {"subject", "scalar", "verdict", "failed", "error", "kappa", "budget", "rule",
                          "operation", "block", "band", "replay"})
    EXPECT_TRUE(record.at(0)["cells"].at(0).contains(key)) << key;
  EXPECT_EQ(record.at(0)["input"]["double"].size(), 16u);
  // The replay line gives the same verdict: exit code 0 for the right refusal, 1 for the inaccurate result.
  for (int i : {0, 1}) {
    const std::string replay = record.at(0)["cells"].at(i)["replay"];
    const std::string command = std::string(LIECHECK_PROGRAM) + replay.substr(8) + " > /dev/null";
    EXPECT_EQ(shell(command).code, i) << command;
  }
}

TEST(HardCasesOfTheProgram, DecideItsExitCode) {
  const auto exit_of = [](const std::string& arguments) {
    return shell(LIECHECK_PROGRAM " " + arguments).code;
  };
  EXPECT_EQ(exit_of("hard-cases"), 0);
  EXPECT_EQ(exit_of("hard-cases --subject textbook --scalar double"), 1);
  EXPECT_EQ(exit_of("hard-cases --file /nowhere/at/all.txt"), 2);
  EXPECT_EQ(exit_of("hard-cases --subject nobody"), 2);
  // One generated case of this law passes; its hard cases do not.
  const std::string one =
      "campaign --subject eigen --scalar double --property power_pairing --cases 1 --seed 4 --profile ours";
  EXPECT_EQ(exit_of(one), 1);
  EXPECT_EQ(exit_of(one + " --no-hard-cases"), 0);
}

}  // namespace
}  // namespace liecheck::properties

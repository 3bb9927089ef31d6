// Findings: one cause is one finding, what it makes wrong stands below it, and its example is one that a person would write.

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <regex>
#include "../scratch.hpp"
#include "../shell.hpp"

namespace {

/// Each finding of the text: its first line, and those below it.
std::vector<std::pair<std::string, std::string>> findings_in(const std::string& text) {
  std::vector<std::pair<std::string, std::string>> all;
  const std::regex first("\n([0-9]+)  ([^\n]*)\n((   [^\n]*\n)*)");
  for (std::sregex_iterator at(text.begin(), text.end(), first), end; at != end; ++at)
    all.emplace_back((*at)[2], (*at)[3]);
  return all;
}
std::string campaign(const std::string& arguments, int code) {
  const auto [returned, text] = liecheck::shell("{ " LIECHECK_PROGRAM " campaign --no-hard-cases -j 1 " +
                                                arguments + " 2>/dev/null; } </dev/null");
  EXPECT_EQ(returned, code) << text;
  return text;
}

TEST(Findings, OneCauseIsOneFindingWithItsConsequencesBelowIt) {
  // The closed form of the left Jacobian cancels, and all that uses it is wrong for that reason alone.
  const auto all =
      findings_in(campaign("--subject textbook --property exp_oracle --property jacobian_oracle "
                           "--property d_integrate --scalar double",
                           1));
  const auto of = [&](const std::string& begin) {
    for (const auto& [first, below] : all)
      if (first.starts_with(begin)) return below;
    return std::string();
  };
  const std::string below_it = of("left_jacobian6 (coupling)");
  const std::string so =
      below_it.substr(below_it.find("   so "), below_it.find("   example ") - below_it.find("   so "));
  for (const char* name : {" right_jacobian6", " left_jacobian6_inverse", " d_integrate_arg1"})
    EXPECT_TRUE(so.find(name + std::string(",")) != so.npos || so.find(name + std::string(" ")) != so.npos)
        << name << so;
  for (const auto& [first, below] : all) {
    EXPECT_FALSE(first.starts_with("right_jacobian") || first.starts_with("d_integrate_arg1"))
        << first << below;
    EXPECT_NE(below.find("   replay   liecheck replay "), std::string::npos) << first << below;
  }
}

TEST(Findings, ACauseThatIsRightIsNotBlamed) {
  // log6 is wrong near pi since log3_matrix is. The logarithm of a quaternion, which is right there, is not named.
  const auto all = findings_in(campaign("--subject textbook --property log_oracle --scalar double", 1));
  ASSERT_FALSE(all.empty());
  EXPECT_TRUE(all[0].first.starts_with("log3_matrix (rotation vector): all 15.7 digits lost"))
      << all[0].first;
  EXPECT_NE(all[0].second.find("   so       log6 fails in the same way\n"), std::string::npos)
      << all[0].second;
  for (const auto& [first, below] : all)
    if (first.starts_with("log3_quaternion")) EXPECT_EQ(below.find("log6"), std::string::npos) << below;
}

TEST(Findings, TheExampleIsOneThatAPersonWouldWrite) {
  const std::string text = campaign("--subject textbook --property exp_oracle --scalar double", 1);
  EXPECT_NE(
      text.find("   example  exp6(xi (rho, phi) = 1, 2, 3, 3e-07, 0, 0)\n            p[1] is 1.99999955"),
      std::string::npos)
      << text;
}

/// The command of rotations.py with one more function, other FUNCTIONS and, in place of programs, another last member.
std::string adapter_with(const std::string& file, const std::string& functions,
                         const std::string& member = R"("source": source})") {
  auto [code, program] = liecheck::shell("cat " LIECHECK_FIXTURES "/adapters/rotations.py");
  for (const auto& [from, to] :
       {std::pair<std::string, std::string>("FUNCTIONS = {", functions + "\nOTHERS = {"),
        {R"("source": source})", member}})
    program.replace(program.find(from), from.size(), to);
  std::ofstream(liecheck::scratch() + file) << program;
  return "/usr/bin/python3 " + liecheck::scratch() + file;
}

TEST(Findings, ASecondWayToFailHasALine) {
  const std::string adapter = adapter_with("two_ways.py", R"(
def log3_quaternion(Q):
    s = np.linalg.norm(Q[:3])
    return Q[:3] * (2 * np.arctan2(s, Q[3]) / s)


FUNCTIONS = {"log3_quaternion": (log3_quaternion, 4, 3)})");
  const std::string text = campaign("--property log_oracle --scalar double --adapter '" + adapter + "'", 1);
  EXPECT_NE(text.find("(rotation vector): NaN or Inf in double"), std::string::npos) << text;
  EXPECT_NE(text.find("   also     wrong branch, theta "), std::string::npos) << text;
  EXPECT_NE(text.find("such as: log3_quaternion, rotation vector, "), std::string::npos) << text;
}

// Below 1e-3 the rotation is that of theta = 0, and from there to 0.1 a right one has a wrong norm.
TEST(Findings, ABlockThatIsWrongWhereTheFirstIsRightHasALine) {
  const std::string adapter = adapter_with("two_blocks.py", R"(
def exp3_quaternion(phi):
    t = np.linalg.norm(phi)
    Q = np.append(phi * (np.sin(t / 2) / t if t > 0 else 0.5), np.cos(t / 2))
    return np.array([0, 0, 0, 1]) if t < 1e-3 else Q * (1 + 1e-9) if t < 0.1 else Q


FUNCTIONS = {"exp3_quaternion": (exp3_quaternion, 3, 4)})");
  const std::string text = campaign("--property exp_oracle --scalar double --adapter '" + adapter + "'", 1);
  EXPECT_NE(text.find("1  exp3_quaternion (rotation): "), std::string::npos) << text;
  EXPECT_NE(text.find("a threshold at theta about 1e-3, "), std::string::npos) << text;
  EXPECT_NE(text.find("   also     norm defect: 7.0 of 15.7 digits lost, theta 1e-3 to 1e-1: "),
            std::string::npos)
      << text;
}

// The largest errors are below the cutoff, and as random inputs show them they begin at once above 1e-6.
TEST(Findings, ACutoffIsWhereErrorsOfPlainInputsChangeAtOnce) {
  const std::string adapter = adapter_with("cutoff.py", R"(
def left_jacobian3(phi):
    t = np.linalg.norm(phi)
    n = np.array([[0, -phi[2], phi[1]], [phi[2], 0, -phi[0]], [-phi[1], phi[0], 0]])
    return np.eye(3) + (n / 2 if t < 1e-4 else (1 - np.cos(t)) / t**2 * n + (t - np.sin(t)) / t**3 * n @ n)


def log3_quaternion(Q):
    s = np.linalg.norm(Q[:3])
    return 0 * Q[:3] if s < 2e-11 else Q[:3] * (2 * np.arctan2(s, abs(Q[3])) / s) * (1 if Q[3] > 0 else -1)


FUNCTIONS = {"left_jacobian3": (lambda x: left_jacobian3(x).reshape(9), 3, 9),
             "log3_quaternion": (log3_quaternion, 4, 3)})");
  const std::string text = campaign(
      "--property jacobian_oracle --property log_oracle --scalar double --adapter '" + adapter + "'", 1);
  EXPECT_NE(
      text.find(
          "a cutoff at theta about 1e-4: above it the closed form cancels, and the series below it lacks "
          "a term\n"),
      std::string::npos)
      << text;
  EXPECT_NE(text.find("the result is 0 where theta is below about 4e-11: a threshold\n"), std::string::npos)
      << text;
}

// log6 uses log3_matrix, which loses digits near pi, and has an acos of its own, which is NaN where the trace is below -1.
constexpr char own_acos[] = R"(
def log3_matrix(R):
    R = R.reshape(3, 3)
    theta = np.arccos(np.clip((np.trace(R) - 1) / 2, -1, 1))
    v = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]) / 2
    return v if theta < 1e-6 else theta / np.sin(theta) * v


def log6(x):
    phi, p = log3_matrix(x[:9]), x[9:]
    theta = np.arccos((x[0] + x[4] + x[8] - 1) / 2) if x[0] + x[4] + x[8] < 0 else np.linalg.norm(phi)
    n = np.array([[0, -phi[2], phi[1]], [phi[2], 0, -phi[0]], [-phi[1], phi[0], 0]])
    c = 1 / 12 if theta < 1e-3 else (1 - theta / 2 / np.tan(theta / 2)) / theta**2
    return np.concatenate([p - n @ p / 2 + c * n @ n @ p, phi + 0 * theta])


FUNCTIONS = {"log3_matrix": (log3_matrix, 9, 3), "log6": (log6, 12, 6)})";

TEST(Findings, WhatAnotherOperationsFaultDoesNotExplainHasALine) {
  const std::string text = campaign(
      "--property log_oracle --scalar double --adapter '" + adapter_with("own_acos.py", own_acos) + "'", 1);
  EXPECT_NE(text.find("1  log3_matrix (rotation vector): "), std::string::npos) << text;
  EXPECT_NE(text.find("   so       log6 fails in the same way\n"), std::string::npos) << text;
  EXPECT_NE(text.find("   also     log6: NaN or Inf, pi - theta"), std::string::npos) << text;
}

/// Runs a law with the lines that accept all failures of an adapter.
void accept_all_of(const std::string& law, const std::string& adapter) {
  const std::string arguments = "--property " + law + " --scalar double --adapter '" + adapter + "' ";
  const std::string text = campaign(arguments + "--all", 1);
  const auto from = text.find("[expected]\n# finding 1, ");
  ASSERT_NE(from, std::string::npos) << text;
  const std::string file = liecheck::scratch() + "accepted.limits";
  std::ofstream(file) << "version = 3\nsubject = rotations\n" << text.substr(from);
  EXPECT_NE(campaign(arguments + "--limits " + file, 0).find("verdict pass"), std::string::npos);
}

TEST(Findings, TheLinesThatAcceptThemAcceptAll) {
  accept_all_of("log_oracle", adapter_with("own_acos.py", own_acos));
}

// Then other blocks of the result are not measured in a whole class of inputs.
TEST(Findings, ARefusalOfAClassCanBeAccepted) {
  accept_all_of("minimal_rotation", adapter_with("refuses_opposite.py", R"(
def rotation_between(x):
    a, b = x[:3], x[3:]
    if a @ b < -0.999:
        raise ValueError("nearly opposite")
    Q = np.append(np.cross(a, b), 1 + a @ b)
    return Q / np.linalg.norm(Q)


FUNCTIONS = {"rotation_between": (rotation_between, 6, 4)})"));
}

// Most bands of exp6 fail since the left Jacobian cancels, and those below 1e-14, where that is right, since it drops rho.
TEST(Findings, BandsThatACauseDoesNotExplainHaveALine) {
  const std::string adapter = adapter_with("partly.py", R"(
def left_jacobian3(phi):
    t = np.linalg.norm(phi)
    n = np.array([[0, -phi[2], phi[1]], [phi[2], 0, -phi[0]], [-phi[1], phi[0], 0]])
    return np.eye(3) if t == 0 else np.eye(3) + (1 - np.cos(t)) / t**2 * n + (t - np.sin(t)) / t**3 * n @ n


def exp6(x):
    R = exp3_matrix(x[3:]).reshape(3, 3)
    p = 0 * x[:3] if 0 < np.linalg.norm(x[3:]) < 1e-14 else left_jacobian3(x[3:]) @ x[:3]
    return np.concatenate([R.reshape(9), p])


FUNCTIONS = {"left_jacobian3": (lambda x: left_jacobian3(x).reshape(9), 3, 9), "exp6": (exp6, 6, 12)})");
  const auto all = findings_in(campaign(
      "--property jacobian_oracle --property exp_oracle --scalar double --adapter '" + adapter + "'", 1));
  std::string of_jacobian, of_exp;
  for (const auto& [first, below] : all)
    (first.starts_with("left_jacobian3") ? of_jacobian : of_exp) += first + "\n" + below;
  EXPECT_NE(of_jacobian.find("   so       exp6 fails in the same way\n"), std::string::npos) << of_jacobian;
  EXPECT_NE(of_jacobian.find("   also     exp6: all 15.7 digits lost, theta 1e-"), std::string::npos)
      << of_jacobian;
  EXPECT_EQ(of_exp, "");
}

TEST(Findings, CompositesOfLaterGroupsFollowFromTheirParts) {
  const auto all = findings_in(campaign("--subject textbook --property directions --scalar double", 1));
  ASSERT_EQ(all.size(), 1u);
  EXPECT_TRUE(all[0].first.starts_with("angle_between (angle)")) << all[0].first;
  EXPECT_NE(all[0].second.find("   so       slerp_directions fails in the same way\n"), std::string::npos);
}

TEST(Findings, TheAngleOfAnAcosIsToldAtAnyNumberOfCases) {
  for (const char* cases : {"1000", "10000"}) {
    const std::string text =
        campaign(std::string("--subject textbook --property directions --property "
                             "relative_rotation --profile careful --scalar double --cases ") +
                     cases,
                 1);
    std::size_t told = 0;
    for (auto at = text.find("perhaps  acos near 1,"); at != text.npos;
         at = text.find("perhaps  acos near 1,", at + 1))
      ++told;
    EXPECT_EQ(told, 2u) << text;
  }
}

TEST(Findings, ARefusalNearGimbalLockIsOne) {
  const std::string adapter = adapter_with("refuses_lock.py", R"(
def euler_from_matrix(x):
    if x[0] != 11 or abs(x[7]) > 0.999:
        raise ValueError("no such order" if x[0] != 11 else "gimbal lock")
    return np.arctan2(x[4], x[1]), np.arcsin(-x[7]), np.arctan2(x[8], x[9])


FUNCTIONS = {"euler_from_matrix": (euler_from_matrix, 10, 3)})");
  const std::string text = campaign("--property euler_angles --scalar double --adapter '" + adapter + "'", 1);
  EXPECT_NE(text.find("euler_from_matrix (rotation, range): refused in double"), std::string::npos) << text;
  EXPECT_NE(text.find("            the input is refused: gimbal lock\n"), std::string::npos) << text;
  EXPECT_EQ(text.find("   perhaps"), std::string::npos) << text;
}

TEST(Findings, TheExampleHasTheOrderThatTheAdapterStates) {
  const std::string adapter = adapter_with("w_first.py", R"(
def log3_quaternion(Q):
    theta = 2 * np.arccos(np.clip(Q[0], -1, 1))
    return Q[1:] * (theta / np.sin(theta / 2) if theta > 0 else 2)


FUNCTIONS = {"log3_quaternion": (log3_quaternion, 4, 3)})",
                                           R"("conventions": {"quaternion": "wxyz"}})");
  const std::string text = campaign("--property log_oracle --scalar double --adapter '" + adapter + "'", 1);
  EXPECT_NE(text.find("   example  log3_quaternion(Q (w, x, y, z) = -0.99"), std::string::npos) << text;
}

TEST(Findings, APassHasThreeLines) {
  const std::string text = campaign("--property exp_oracle --cases 100", 0);
  EXPECT_TRUE(text.starts_with("verdict pass; liecheck ")) << text;
  EXPECT_EQ(std::ranges::count(text, '\n'), 3) << text;
}

TEST(Findings, TestIsTheCampaignOfAnAdapterWithItsPage) {
  const std::string page = liecheck::scratch() + "findings_page";
  const auto [code, text] =
      liecheck::shell("{ " LIECHECK_PROGRAM " test " LIECHECK_C_ADAPTER " --cases 200 -j 1 --page " + page +
                      " 2>/dev/null; } </dev/null");
  EXPECT_EQ(code, 0) << text;
  EXPECT_TRUE(text.starts_with("verdict pass; rotations_c 1.0\n")) << text;
  EXPECT_NE(text.find("findings_page/report.html\n"), std::string::npos) << text;
  EXPECT_NE(liecheck::shell(LIECHECK_PROGRAM " test 2>&1").code, 0);
}

}  // namespace

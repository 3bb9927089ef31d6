// What the terminal says of a failure, and in how many words.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <subjects/subject_names.hpp>

#include <fmt/format.h>
#include <subjects/typed.hpp>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "../scratch.hpp"
#include "../shell.hpp"

namespace {

using liecheck::properties::absent_subjects;

/// Runs a shell line in which $L is the program. Returns its exit code and what it printed, also on standard error.
std::pair<int, std::string> shell(const std::string& line) {
  const auto [code, text] = liecheck::shell("export L=" LIECHECK_PROGRAM "; { " + line + "; } </dev/null");
  return {code, text};
}
std::pair<int, std::string> run(const std::string& arguments) {
  return shell("$L " + arguments);
}
#define EXPECT_SAYS(text, words) EXPECT_NE((text).find(words), std::string::npos) << text

TEST(Terminal, TheVerdictOfACampaignIncludesItsHardCases) {
  const std::string one = "campaign --subject textbook --property exp_oracle --scalar double --cases 1 -j 1";
  const auto [code, text] = run(one);
  EXPECT_EQ(code, 1);
  EXPECT_SAYS(text, "\nverdict fail: hard cases failed");
  EXPECT_EQ(text.find("verdict pass"), std::string::npos) << text;
  const auto [without, said] = run(one + " --no-hard-cases");
  EXPECT_EQ(without, 0);
  EXPECT_SAYS(said, "verdict pass; textbook");
}

TEST(Terminal, AHuntOfWhatTheSubjectDoesNotOfferEndsAtOnce) {
  const auto [code, text] = run("hunt --subject ceres --op exp6");
  EXPECT_EQ(code, 2);
  EXPECT_SAYS(text, "liecheck: --op: ceres does not offer 'exp6' in double; it is measured on: ");
  const auto [unknown, said] = run("hunt --subject ceres --op exp7");
  EXPECT_EQ(unknown, 2);
  EXPECT_SAYS(said, "--op: unknown operation 'exp7' in double");
}

TEST(Terminal, ASubjectThatIsNotBuiltSaysHowToGetIt) {
  const auto [listed, subjects] = run("list");
  for (const std::string name : {"pinocchio", "sophus", "manif", "smooth"}) {
    if (subjects.find("\n  " + name + " ") < subjects.find("\nabsent from this build\n")) continue;
    EXPECT_SAYS(subjects, fmt::format("\n  {:<12}configure with -D", name));
    const auto [code, text] = run("hunt --subject " + name + " --op exp6");
    EXPECT_EQ(code, 2);
    EXPECT_SAYS(text, "'" + name + "' is absent from this build: configure with -D");
  }
}

TEST(Terminal, TheListNamesOperationsWithTheirBlocksAndAbsentSubjects) {
  const auto [code, text] = run("list");
  EXPECT_EQ(code, 0);
  EXPECT_SAYS(text,
              "\n  exp6                            rotation, orthogonality defect, translation, jump\n");
  for (const std::string& name : absent_subjects()) EXPECT_SAYS(text, "\n  " + name);
}

/// What bash offers after `line`, whose last word is being typed.
std::string completed(const std::string& line) {
  return shell("bash -c 'eval \"$($L completion bash)\"; COMP_WORDS=(" + line +
               "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _liecheck; echo \" ${COMPREPLY[*]} \"'")
      .second;
}

TEST(Terminal, AShellCompletesCommandsFlagsAndNames) {
  EXPECT_EQ(completed("liecheck camp"), " campaign \n");
  EXPECT_EQ(completed("liecheck scene ex"), " explain \n");
  EXPECT_EQ(completed("liecheck campaign --sub"), " --subject \n");
  EXPECT_EQ(completed("liecheck campaign --subject textb"), " textbook \n");
  EXPECT_EQ(completed("liecheck campaign --subject textbook --property log"), " log_oracle \n");
  EXPECT_EQ(completed("liecheck hunt --op ex"), " exp3_quaternion exp3_matrix exp6 \n");
  EXPECT_EQ(completed("liecheck scene run --js"), " --json \n");
  EXPECT_SAYS(shell("$L lab completion bash").second, "complete -o default -F _liecheck-lab liecheck-lab\n");
  EXPECT_EQ(completed("liecheck robot some_file"), "  \n");  // bash completes files itself
  for (const std::string script : {"bash", "zsh", "fish"}) {
    const auto [code, text] = run("completion " + script);
    EXPECT_EQ(code, 0);
    for (const char* word : {"campaign", "explain", "versus-random", "completion"}) EXPECT_SAYS(text, word);
    // Where the shell is installed, it must accept the script.
    const std::string check = "which " + script + " >/dev/null || exit 0; $L completion " + script + " | " +
                              script + (script == "fish" ? " --no-execute" : " -n");
    EXPECT_EQ(shell(check), std::pair(0, std::string()));
  }
  EXPECT_EQ(run("completion tcsh").first, 2);
}

/// Where they are installed, fish and zsh complete by their scripts what bash does. zsh calls the function with its two
/// built-in commands replaced by ones that print.
TEST(Terminal, FishAndZshCompleteByTheirScripts) {
  const auto fish = [](const std::string& line) {
    return shell("fish -c '$L completion fish | source; complete -C \"" + line + "\"' | cut -f 1").second;
  };
  const auto zsh = [](const std::string& words, int current) {
    return shell(
               "zsh -f -c 'compdef() { :; }; _files() { print files; }; compadd() { shift; print -l -- $@; "
               "}; "
               "_describe() { print -l -- ${${(P)@[-1]}%%:*}; }; eval \"$($L completion zsh)\"; words=(" +
               words + "); CURRENT=" + std::to_string(current) + "; _liecheck'")
        .second;
  };
  int shells = 0;
  if (shell("command -v fish").first == 0) {
    ++shells;
    EXPECT_EQ(fish("liecheck camp"), "campaign\n");
    EXPECT_EQ(fish("liecheck scene ex"), "explain\n");
    EXPECT_EQ(fish("liecheck campaign --subject textb"), "textbook\n");
    EXPECT_EQ(fish("liecheck hunt --op exp6"), "exp6\n");
    EXPECT_SAYS(fish("liecheck scene sweep --no-o"), "--no-orders\n");
  }
  if (shell("command -v zsh").first == 0) {
    ++shells;
    EXPECT_SAYS(zsh("liecheck camp", 2), "\ncampaign\n");
    EXPECT_SAYS(zsh("liecheck scene ex", 3), "explain\n");
    EXPECT_SAYS(zsh("liecheck campaign --subject textb", 4), "\ntextbook\n");
    EXPECT_SAYS(zsh("liecheck hunt --op exp6", 4), "exp6\n");
    EXPECT_SAYS(zsh("liecheck scene sweep --no-o", 4), "--no-orders\n");
    EXPECT_EQ(zsh("liecheck robot some_file", 3), "files\n");
  }
  if (shells == 0) GTEST_SKIP() << "neither fish nor zsh is installed";
}

TEST(Terminal, AReaderThatHasSeenEnoughIsNoError) {
  const auto [code, text] =
      shell("bash -c 'for i in 1 2 3; do $L list; done | head -1; exit ${PIPESTATUS[1]}'");
  EXPECT_EQ(code, 0);
  EXPECT_EQ(text, "subjects\n");
}

/// What a campaign of 1000 cases prints of a subject in double.
std::string campaign(const std::string& subject, const std::string& more = "") {
  return run("campaign --scalar double --cases 1000 -j 1 --no-hard-cases --verbose --subject " + subject + " " + more)
      .second;
}

TEST(Terminal, AFailureShowsWhatWasReturnedAndWhatIsRight) {
  const std::string id = "replay raw.exp_oracle.textbook.double.none.1,0,0,0,1e-8,0";
  for (const std::string& text : {run(id).second, campaign("textbook", "--property exp_oracle --all")}) {
    EXPECT_SAYS(text, "\n  law       exp(rho, phi) = sum_k [[phi], rho; 0, 0]^k / k!\n");
    EXPECT_SAYS(text, "  limit     3.9 eps, liecheck's budget: three terms");
    EXPECT_SAYS(text, "\n  input     rho = 1, 0, 0  [m]\n            phi = 0, 1e-08, 0  [rad]\n");
    EXPECT_SAYS(text, ", kappa 1; 7.4 of 15.7 digits lost\n");
    EXPECT_SAYS(text, "\n  call      exp6(xi)\n");
    EXPECT_SAYS(text, "    p[2]        got       0                        0x0p+0\n");
    EXPECT_SAYS(text, "                expected  -5.0000000000000001e-09  -0x1.5798ee2308c3ap-28\n");
  }
  EXPECT_SAYS(campaign("textbook", "--property exp_oracle --profile careful"),
              "  limit     64 eps, profile careful");
}

TEST(Terminal, AtPiTheExactResultIsThatOfTheAxisThatWasReturned) {
  const std::string text =
      run("replay g4.42.integrate_difference.bug:difference_naive.double.none.552").second;
  const auto linear = text.find("\ndifference, block linear\n");
  ASSERT_NE(linear, text.npos) << text;
  const auto expected = text.find("expected  ", linear), got = text.find("got       ", linear);
  ASSERT_NE(expected, text.npos) << text;
  const double right = std::stod(text.substr(expected + 10)), wrong = std::stod(text.substr(got + 10));
  EXPECT_GT(std::fabs(right - wrong), 1e-3 * std::fabs(right)) << text;  // as the error in eps says
}

// The rotation vector of this result is on a wrong branch, and its linear part is right.
TEST(Terminal, AWrongBranchShowsTheNumbersThatAreWrong) {
  const std::string text =
      run("replay raw.log_oracle.textbook.double.none.0,0,0,1,1,0,0,0,-1,-0x1.c2edd4bf0bcb7p-39,"
          "0,0x1.c2edd4bf0bcb7p-39,-1,0,0,0")
          .second;
  const auto linear = text.find("\nlog6, block linear\n");
  ASSERT_NE(linear, text.npos) << text;
  EXPECT_SAYS(text.substr(linear), "  error     wrong branch\n");
  EXPECT_SAYS(text.substr(linear), "    phi[0]      got       82193.4893");
}

TEST(Terminal, AnOutcomeWithoutAnErrorIsNamedAndHasNoEps) {
  for (const std::string subject : {"bug:exp_nan_at_zero", "bug:log_no_sign"}) {
    const std::string text = campaign(subject, "--property exp_oracle --property log_oracle --all");
    EXPECT_SAYS(text, "verdict fail");
    for (const char* wrong : {"error     0 eps", "inf eps", "inf x", "infx", "kappa 0"})
      EXPECT_EQ(text.find(wrong), std::string::npos) << wrong << "\n" << text;
    EXPECT_SAYS(text, subject == "bug:log_no_sign" ? "error     wrong branch" : "error     NaN or Inf");
  }
  const std::string nan = run("replay raw.exp_oracle.bug:exp_nan_at_zero.double.none.1,0,0,0,0,0").second;
  EXPECT_SAYS(nan, "    p[0]        got       NaN\n");
  const auto line = nan.find("NaN or Inf"), end = nan.find("FAIL\n", line);
  ASSERT_NE(end, nan.npos) << nan;
  EXPECT_EQ(nan.substr(line, end - line).find("eps"), nan.npos) << nan;
}

TEST(Terminal, ATreeShowsWhatWasReturnedAndWhatIsRight) {
  const std::string text =
      run("campaign --scalar double --cases 50 -j 1 --no-hard-cases --verbose --subject bug:tree_gravity_sign").second;
  EXPECT_SAYS(text, "  result    tau of ");
  EXPECT_SAYS(text, "    tau[");
  EXPECT_SAYS(text, "expected  ");
}

TEST(Terminal, FailuresAreInATableWorstFirst) {
  const std::string text = campaign("textbook", "--property exp_oracle --property log_oracle");
  const auto table = text.find("failed, worst first");
  const auto at = [&](const std::string& words) { return text.find(words, table); };
  ASSERT_NE(table, text.npos) << text;
  EXPECT_LT(at("log6 linear "), at("exp6 translation ")) << text;
  EXPECT_LT(at("exp6 translation "), at("exp3_quaternion rotation ")) << text;
  EXPECT_SAYS(text, "theta 1e-8 to 1e-1");
  EXPECT_SAYS(text, "pi - theta < 1");
  EXPECT_SAYS(text, "7.3 of 15.7 digits lost");
  EXPECT_SAYS(text, " of 91 cases\n");
  EXPECT_EQ(text.find("FAILED", text.find("FAILED") + 1), text.npos) << text;  // only the worst one in full
  EXPECT_SAYS(text, "--all prints each in full");
  const std::string all = campaign("textbook", "--property exp_oracle --property log_oracle --all");
  EXPECT_NE(all.find("FAILED", all.find("FAILED") + 1), all.npos);
  const std::string nan = campaign("bug:log_acos_w");
  EXPECT_SAYS(nan, "NaN or Inf");
}

TEST(Terminal, TheShapeOfTheErrorTellsTheCause) {
  const std::pair<const char*, const char*> all[] = {
      {"bug:exp_series_sign", "perhaps a cutoff at theta about 1e-2: the series below it lacks a term"},
      {"bug:log6_series_coefficient",
       "perhaps a cutoff at theta about 1e-3: the series below it lacks a term"},
      {"bug:exp6_shared_cutoff", "perhaps a cutoff at theta about 1e-4, towards which"},
      {"bug:jacobian6_cancelling", "perhaps a cutoff at theta about 1e-5: above it the closed form cancels"},
      {"bug:difference_naive", "perhaps a missing series: the formula cancels as theta goes to 0"},
      {"bug:log_acos_w",
       "perhaps acos near 1, which keeps half of the digits: the error grows as 1 / theta^2; atan2 of "
       "both parts does not; and acos of a number w above 1"},
      {"bug:log_no_sign", "perhaps the sign of w is not looked at"},
      {"bug:log_transposed", "log is that of the inverse"},
      {"bug:rate_narrow_constant", "perhaps a constant or a step of the calculation has too few digits"},
      {"bug:rotate_conjugate", "quaternions are those of the inverse rotations"},
      {"bug:jacobian_left_for_right", "the right Jacobian is the left one"},
      {"bug:d_integrate_transposed", "perhaps matrices are stored column by column"},
      {"bug:d_difference_left", "perhaps the derivatives are those of increments on the left"}};
  for (const auto& [subject, guess] : all) EXPECT_SAYS(campaign(subject), guess) << subject;
  EXPECT_SAYS(campaign("textbook", "--property log_oracle"), "perhaps sin near pi");
  EXPECT_SAYS(campaign("textbook", "--property exp_oracle"),
              "perhaps a cutoff at theta about 1e-8: above it the closed form cancels");
  EXPECT_SAYS(campaign("textbook:1e-3", "--property small_angle_branches"),
              "perhaps a cutoff at theta about 1e-3, at which the result jumps");
  // A correct variant with an error of a few eps tells nothing.
  for (const char* subject : {"ceres", "eigen"})
    EXPECT_EQ(campaign(subject, "--property exp_oracle").find("perhaps"), std::string::npos) << subject;
}

TEST(Terminal, ColoursAreForATerminalThatWantsThem) {
  const std::string line =
      "$L campaign --subject textbook --property exp_oracle --cases 9 -j 1 --no-hard-cases";
  EXPECT_EQ(shell(line).second.find('\033'), std::string::npos);
  const auto on_terminal = [&](const std::string& environment) {
    return shell("export TERM=xterm " + environment + "; script -qec \"" + line + "\" /dev/null").second;
  };
  if (on_terminal("").find("verdict") == std::string::npos) GTEST_SKIP() << "no script(1)";
  EXPECT_SAYS(on_terminal(""), "\033[3");
  EXPECT_EQ(on_terminal("NO_COLOR=1").find("\033[3"), std::string::npos);
}

/// A Python adapter of exp3_quaternion, which is 1e-3 too long, crashes or prints.
std::string adapter(const std::string& statement, const std::string& members = "{}") {
  const std::string file = liecheck::scratch() + "terminal_adapter.py";
  std::ofstream(file) << R"(import json, math, os, struct, sys
calls, answers = sys.stdin.buffer, sys.stdout.buffer
calls.readline()
hello = {"protocol": 1, "name": "mylib", "version": "1", "operations": {"exp3_quaternion": ["double"]}}
hello.update()" << members
                      << R"()
answers.write(json.dumps(hello).encode() + b"\n")
answers.flush()
for call in iter(calls.readline, b""):
    n, results = int(call.split()[3]), b""
    for _ in range(n):
        phi = struct.unpack("<3d", calls.read(24))
        t = math.sqrt(sum(x * x for x in phi))
        s = math.sin(t / 2) / t if t > 0 else 0.5
        Q = [1.001 * s * x for x in phi] + [math.cos(t / 2)]
        )" << statement
                      << R"(
        results += struct.pack("<4d", *Q)
    answers.write(f"done {n}\n".encode() + bytes(n) + results)
    answers.flush()
)";
  return "'/usr/bin/python3 " + file + "'";
}
std::string of_cases(int n) {
  return fmt::format("campaign --property exp_oracle --cases {} -j 1 --no-hard-cases --no-probe --adapter ",
                     n);
}
const std::string of_adapter = of_cases(200);

/// The angle 2 acos(w) has an absolute error of eps / theta, so its relative error grows as 1 / theta^2 and passes 1.
TEST(Terminal, AcosNearOneIsNamed) {
  const std::string file = liecheck::scratch() + "terminal_acos.py";
  std::ofstream(file) << R"(import json, math, struct, sys
calls, answers = sys.stdin.buffer, sys.stdout.buffer
calls.readline()
answers.write(json.dumps({"protocol": 1, "name": "mylib", "version": "1",
                          "operations": {"log3_quaternion": ["double"]}}).encode() + b"\n")
answers.flush()
for call in iter(calls.readline, b""):
    n, results = int(call.split()[3]), b""
    for _ in range(n):
        x, y, z, w = struct.unpack("<4d", calls.read(32))
        s, sign = math.hypot(x, y, z), -1 if w < 0 else 1
        f = 2 * math.acos(min(1, abs(w))) / s * sign if s > 0 else 2
        results += struct.pack("<3d", f * x, f * y, f * z)
    answers.write(f"done {n}\n".encode() + bytes(n) + results)
    answers.flush()
)";
  EXPECT_SAYS(
      run("campaign --cases 1000 -j 1 --no-hard-cases --verbose --adapter '/usr/bin/python3 " + file + "'").second,
      "perhaps acos near 1, which keeps half of the digits: the error grows as 1 / theta^2");
}

TEST(Terminal, AFailureOfAnAdapterIsAProgramInItsOwnTerms) {
  const std::string plain = run(of_adapter + adapter("pass") + " --verbose").second;
  EXPECT_SAYS(plain, "  as the adapter is called: exp3_quaternion in double\n    phi       ");
  EXPECT_EQ(plain.find("#include <liecheck"), std::string::npos) << plain;
  const std::string source = R"~({"source": {"exp3_quaternion": "print(mylib.exp([{phi}]))"}})~";
  const std::string own = run(of_adapter + adapter("pass", source)).second;
  EXPECT_SAYS(own, "  as mylib's own program:\n\nprint(mylib.exp([");
  EXPECT_EQ(own.find("{phi}"), std::string::npos) << own;
  EXPECT_SAYS(run("adapter check " + adapter("pass", R"({"source": {"exp3_quaternion": 3}})")).second,
              "has no text as source of exp3_quaternion");
}

TEST(Terminal, AnAdapterMayHaveTheNameOfALibraryThatIsAbsentFromTheBuild) {
  const auto [code, text] = run(of_adapter + adapter("pass", R"({"name": "smooth"})"));
  EXPECT_EQ(text.find("is absent from this build"), std::string::npos) << text;
  EXPECT_SAYS(text, "; smooth ");
}

TEST(Terminal, ASharedLibraryMayHaveItsOwnProgram) {
  const std::string text = run("campaign --property exp_oracle --scalar double -j 1 --no-hard-cases "
                               "--profile ours --adapter " LIECHECK_C_ADAPTER)
                               .second;
  EXPECT_SAYS(text, "  as rotations_c's own program:\n\ndouble phi[] = {");
  EXPECT_SAYS(text, "}, Q[4];\nexp3_quaternion(1, phi, Q, NULL);\n");
}

TEST(Terminal, ALibraryThatHangsWhileItIsLoadedIsNamed) {
  const auto [code, text] = shell(
      "cd " + liecheck::own_folder() +
      " && printf '#include <unistd.h>\\n__attribute__((constructor)) static void f(void) { sleep(3); }' | "
      "cc -shared -fPIC -x c - -o slow.so && script -qec \"$L adapter check in-process:./slow.so\" "
      "/dev/null");
  if (text.find("slow.so") == std::string::npos) GTEST_SKIP() << "no script(1)";
  EXPECT_SAYS(text, "./slow.so is loaded, and its constructors have not returned yet");
}

TEST(Terminal, ALongProbeSaysOffATerminalThatItGoesOn) {
  EXPECT_SAYS(run("adapter check 'sleep 11'").second, "probing sleep 11: 0:10\n");
}

TEST(Terminal, AnAdapterThatCrashesOftenSaysSoInFewLines) {
  const std::string text = run(of_cases(20) + adapter("raise ValueError('no luck')")).second;
  const auto first =
      text.find("mylib: exp3_quaternion: the adapter ended with exit code 1; its last words: ");
  ASSERT_NE(first, text.npos) << text;
  EXPECT_SAYS(text, "ValueError: no luck\n");
  EXPECT_EQ(text.find("Traceback"), text.npos) << text;
  EXPECT_SAYS(text, "mylib: exp3_quaternion: the adapter ended with exit code 1: ");
  EXPECT_SAYS(text, " times\n");
  EXPECT_EQ(text.find("its last words", first + 100), text.npos) << text;
  const std::string chatty = run(of_adapter + adapter("print('hm', file=sys.stderr)")).second;
  std::size_t lines = 0;
  for (auto at = chatty.find("hm\n"); at != chatty.npos; at = chatty.find("hm\n", at + 1)) ++lines;
  EXPECT_EQ(lines, 20u) << chatty;
}

TEST(Terminal, AComparisonOfTimesNamesThoseBeyondTheirSpread) {
  const std::string dir = liecheck::scratch() + "terminal_times/";
  shell("rm -rf " + dir + "; mkdir " + dir);
  const auto record = [&](double exp_ratio, double log_ratio) {
    const auto row = [](const char* operation, double ratio) {
      return nlohmann::json{
          {"subject", "mylib"},
          {"scalar", "double"},
          {"operation", operation},
          {"sets",
           {{{"set", "mixed"},
             {"latency",
              {{"ns", 40 * ratio}, {"ratio", ratio}, {"low", 0.9 * ratio}, {"high", 1.1 * ratio}}}},
            {{"set", "pi"}, {"latency", nullptr}}}}};
    };
    return nlohmann::json{{"rows", {row("exp6", exp_ratio), row("log6", log_ratio)}}};
  };
  std::ofstream(dir + "before.json") << record(1, 2);                               // as of cost --json
  std::ofstream(dir + "after.json") << nlohmann::json{{"cost", record(1.5, 2.2)}};  // as of report
  run(of_adapter + adapter("pass") + " --store " + dir + "a");
  const auto [code, text] =
      shell("cd " + dir + "; $L compare a a --cost before.json --cost after.json --markdown m.md");
  EXPECT_EQ(code, 0) << text;  // a time is no fault
  EXPECT_SAYS(
      text, "mylib double: exp6 takes 1.5 times as long, 40 ns and then 60 ns, mixed\n1 of 2 times changed");
  const auto [shown, markdown] = shell("cat " + dir + "m.md");
  EXPECT_SAYS(markdown, "| `mylib` double `exp6` | mixed | 40 ns | 60 ns | 1.5 |\n");
  EXPECT_EQ(markdown.find("log6"), markdown.npos) << markdown;  // within its spread
  const auto [timed, own] =
      shell("cd " + dir +
            "; $L cost --op exp6 --subject liecheck --scalar double --for 1s --json own "
            ">log && $L compare a a --cost own --cost own");
  EXPECT_EQ(timed, 0) << own;
  EXPECT_SAYS(own, "times changed by more than their spread\nnothing is worse");
  for (const char* wrong :
       {"--cost before.json", "--cost before.json --cost a", "--cost before.json --cost none"})
    EXPECT_EQ(shell("cd " + dir + "; $L compare a a " + wrong).first, 2) << wrong;
}

TEST(Terminal, AComparisonHasReplaysAndARecord) {
  const std::string dir = liecheck::scratch() + "terminal_compare/",
                    right = "Q = [x / 1.001 for x in Q[:3]] + Q[3:]";
  const auto campaign = [&](const std::string& statement, const std::string& rest) {
    const std::string python = adapter(statement);
    return run(of_adapter + python + " --store " + dir + rest);
  };
  shell("rm -rf " + dir + "; mkdir " + dir);
  campaign(right, "a --seed 42"), campaign(right, "b --seed 7"), campaign("pass", "c --seed 42");
  const auto [same, nothing] = shell("cd " + dir + "; $L compare a b --json same.json");
  EXPECT_EQ(same, 0) << nothing;
  EXPECT_SAYS(nothing, "nothing is worse");
  const auto [code, text] = shell("cd " + dir + "; $L compare a c --json worse.json");
  EXPECT_EQ(code, 1) << text;
  EXPECT_SAYS(text, "\n  liecheck replay g4.42.exp_oracle.mylib.double.none.");
  const auto record = [&](const char* file) { return nlohmann::json::parse(std::ifstream(dir + file)); };
  EXPECT_EQ(record("same.json")["verdict"], "pass");
  EXPECT_TRUE(record("same.json")["worse"].empty());
  EXPECT_GT(record("same.json")["compared_cells"], 10);
  const auto worse = record("worse.json");
  EXPECT_EQ(worse["verdict"], "fail");
  EXPECT_EQ(worse["worse"][0]["operation"], "exp3_quaternion");
  EXPECT_SAYS(text, worse["worse"][0]["worst_case"].get<std::string>());
}

}  // namespace

#undef EXPECT_SAYS

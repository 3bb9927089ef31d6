// What the terminal says of a failure, and in how many words.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <string>
#include <utility>

namespace {

/// Runs a shell line in which $L is the program. Returns its exit code and what it printed, also on standard error.
std::pair<int, std::string> shell(const std::string& line) {
  FILE* const out = popen(("export L=" LIECHECK_PROGRAM "; { " + line + "; } 2>&1 </dev/null").c_str(), "r");
  std::string text;
  for (int c = fgetc(out); c != EOF; c = fgetc(out)) text += static_cast<char>(c);
  return {WEXITSTATUS(pclose(out)), text};
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
  EXPECT_SAYS(said, "\nverdict pass\n");
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
    if (subjects.find("\n  " + name + " ") != std::string::npos) continue;
    const auto [code, text] = run("hunt --subject " + name + " --op exp6");
    EXPECT_EQ(code, 2);
    EXPECT_SAYS(text, "'" + name + "' is absent from this build: configure with -D");
  }
}

TEST(Terminal, AReaderThatHasSeenEnoughIsNoError) {
  const auto [code, text] =
      shell("bash -c 'for i in 1 2 3; do $L list; done | head -1; exit ${PIPESTATUS[1]}'");
  EXPECT_EQ(code, 0);
  EXPECT_EQ(text, "subjects\n");
}

}  // namespace

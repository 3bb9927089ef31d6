// Two programs that create or change one store at the same time: one of them wins, the other says so in words,
// and nothing is lost.

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <sys/wait.h>
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <store/merge.hpp>
#include <store/store.hpp>
#include <store/store_path.hpp>
#include <support/files.hpp>
#include <thread>

#include "../sample.hpp"
#include "../scratch.hpp"

namespace liecheck::properties {
namespace {

namespace fs = std::filesystem;

class TwoPrograms : public testing::Test {
 protected:
  struct Run {
    int code;
    std::string err;
  };
  std::string read(const std::string& name) const { return read_whole(folder_ / name); }
  void shell(const std::string& line) const {
    std::system(fmt::format("cd '{}'; L='{}'; {}", folder_.string(), LIECHECK_PROGRAM, line).c_str());
  }
  /// Starts both at once.
  std::pair<Run, Run> both(const std::string& a, const std::string& b) const {
    shell(
        fmt::format("$L {} >out1 2>err1 & p=$!; $L {} >out2 2>err2 & q=$!; "
                    "wait $p; echo $? >code1; wait $q; echo $? >code2",
                    a, b));
    return {{std::stoi(read("code1")), read("err1")}, {std::stoi(read("code2")), read("err2")}};
  }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  static constexpr const char* campaign =
      "campaign --no-hard-cases --subject liecheck --property exp_oracle --scalar double -j 1 ";
  const fs::path folder_ = own_folder();
};

/// Expects exit code 2 and an error of one line that names the store and contains one of `words`.
void expect_refusal(int code, const std::string& err, const std::string& store,
                    std::initializer_list<const char*> words) {
  EXPECT_EQ(code, 2) << err;
  EXPECT_EQ(err.rfind("liecheck: " + store + ": ", 0), 0U) << err;
  EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
  EXPECT_TRUE(std::any_of(words.begin(), words.end(), [&](const char* w) { return err.find(w) != err.npos; }))
      << err;
}

TEST_F(TwoPrograms, ThatCreateOneStoreRunItsCampaignOnce) {
  for (int i = 0; i < 12; ++i) {
    const std::string name = fmt::format("s{}.db", i), what = campaign + ("--cases 50 --store " + name);
    const auto [a, b] = both(what, what);
    EXPECT_EQ(std::min(a.code, b.code), 0) << a.err << b.err;
    const Run& loser = a.code == 0 ? b : a;
    expect_refusal(loser.code, loser.err, name, {"holds this campaign already ("});
    EXPECT_TRUE(load_campaign(file(name)).complete());
    EXPECT_EQ(Store(file(name), Store::Open::existing).campaigns(), 1);
  }
}

// Here the first program is this test, which has begun to create the store when the second one opens it.
TEST_F(TwoPrograms, MayFindThatTheOtherHasCreatedTheTables) {
  Store(file("model.db"), Store::Open::create);
  SQLite::Database model(file("model.db")), first(file("s.db"), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  first.exec("BEGIN IMMEDIATE");
  std::thread second(
      [&] { shell("$L " + std::string(campaign) + "--cases 50 --store s.db >out 2>err; echo $? >code"); });
  std::this_thread::sleep_for(std::chrono::seconds(2));
  for (const std::string pragma : {"PRAGMA application_id", "PRAGMA user_version"})
    first.exec(pragma + " = " + model.execAndGet(pragma).getString());
  SQLite::Statement table(model, "SELECT sql FROM sqlite_master WHERE sql IS NOT NULL");
  while (table.executeStep()) first.exec(table.getColumn(0).getString());
  first.exec("COMMIT");
  second.join();
  EXPECT_EQ(read("code"), "0\n") << read("err");
  EXPECT_TRUE(load_campaign(file("s.db")).complete());
}

TEST_F(TwoPrograms, ThatResumeOneCampaignDoNotMixTheirResults) {
  shell("$L " + std::string(campaign) + "--cases 60000 --store whole.db >out");
  const std::string whole = export_text(load_campaign(file("whole.db")));
  const std::string what = campaign + std::string("--cases 60000 --resume --store s.db");
  const auto [a, b] = both(what, what);
  for (const Run& run : {a, b})
    if (run.code != 0)
      expect_refusal(run.code, run.err, "s.db", {"was changed by another process", "in use by"});
  EXPECT_EQ(std::min(a.code, b.code), 0) << a.err << b.err;
  EXPECT_EQ(export_text(load_campaign(file("s.db"))), whole);
}

TEST_F(TwoPrograms, ThatMergeIntoOneNewStoreLeaveAWholeOne) {
  for (const char* i : {"1", "2"})
    shell(fmt::format("$L {} --cases 4000 --shard {}/2 --store part{} >out", campaign, i, i));
  for (int i = 0; i < 12; ++i) {
    const std::string name = fmt::format("m{}.db", i), what = "merge " + name + " part1 part2";
    const auto [a, b] = both(what, what);
    for (const Run& run : {a, b})
      if (run.code != 0)
        expect_refusal(run.code, run.err, name,
                       {"was created by another process", "was removed or replaced by another process"});
    EXPECT_EQ(std::min(a.code, b.code), 0) << a.err << b.err;
    EXPECT_TRUE(load_campaign(file(name)).complete());
  }
}

TEST_F(TwoPrograms, ThatMergeIntoOneStoreLoseNoCampaign) {
  for (const char* seed : {"1", "2", "3"})
    shell(fmt::format("$L {} --cases 4000 --seed {} --store seed{} >out", campaign, seed, seed));
  for (int i = 0; i < 12; ++i) {
    const std::string name = fmt::format("m{}.db", i);
    shell(fmt::format("cp seed1 {}", name));
    const auto [a, b] = both("merge " + name + " seed2", "merge " + name + " seed3");
    for (const Run& run : {a, b})
      if (run.code != 0)
        expect_refusal(run.code, run.err, name, {"was removed or replaced by another process", "in use by"});
    const int won = (a.code == 0) + (b.code == 0);
    EXPECT_GE(won, 1) << a.err << b.err;
    EXPECT_EQ(Store(file(name), Store::Open::existing).campaigns(), 1 + won);
  }
}

// mpirun passes a signal to every rank, but a queue may stop a single one.
TEST_F(TwoPrograms, OfMpirunSayHowToResumeWhicheverIsStopped) {
  if (std::system("mpirun --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no mpirun";
  for (const char* stopped : {"0", "1"}) {
    shell("rm -f r.db*");
    // The rank that is stopped gets its signal once its part of the store holds something, whatever the machine's
    // speed; its half of the cases takes far longer than that.
    shell(
        "export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1; mpirun --oversubscribe -n 2 sh -c "
        "'$0 \"$@\" & p=$!; if [ $OMPI_COMM_WORLD_RANK = " +
        std::string(stopped) +
        " ]; then until [ -s r.db.$((OMPI_COMM_WORLD_RANK + 1))-of-2 ] || ! kill -0 $p; do sleep .02; done; "
        "kill -TERM $p; fi; wait $p' $L " +
        campaign + "--cases 2000000 --store r.db >out 2>err; echo $? >code");
    if (read("out").find("built without MPI") != std::string::npos) GTEST_SKIP() << "built without MPI";
    EXPECT_EQ(read("code"), "3\n") << read("err");
    const std::string out = read("out"), line = "to resume:\n  mpirun -n 2 ";
    EXPECT_NE(out.find(line), std::string::npos) << out;
    EXPECT_EQ(out.find(line), out.rfind(line)) << out;
  }
}

}  // namespace
}  // namespace liecheck::properties

// The store: kill -9 loses no transaction, the same cases give the same export however they were run, and a
// file that is not an undamaged store of this campaign is refused with one line.

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <store/looking.hpp>
#include <store/merge.hpp>
#include <store/store_path.hpp>
#include <store/stored_run.hpp>
#include <support/files.hpp>
#include <support/progress.hpp>
#include <thread>

#include "../refusal.hpp"

namespace liecheck::properties {
namespace {

namespace fs = std::filesystem;

class Stores : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "liecheck_XXXXXX").string();
    folder_ = mkdtemp(name.data());
    fmt::print("LIECHECK_SEED={}\n", seed_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  static CampaignOptions options(std::uint64_t cases = 210, std::uint64_t seed = 42) {
    CampaignOptions o;
    o.selection = {{"liecheck", "textbook"}, {"exp_oracle", "log_oracle", "robot_configuration"}, {"double"}};
    o.cases = cases, o.seed = seed, o.quiet = true;
    return o;
  }
  std::string run(const std::string& name, const CampaignOptions& o, bool resume = false) const {
    Store store(file(name), Store::Open::create);
    run_stored(o, built_in_robot(), store, resume);
    return file(name);
  }
  std::vector<std::string> shards(unsigned n, std::uint64_t seed = 42) const {
    std::vector<std::string> all;
    for (unsigned i = 1; i <= n; ++i) {
      CampaignOptions o = options(210, seed);
      o.shard = i, o.shards = n;
      all.push_back(run(fmt::format("{}.{}-of-{}", seed, i, n), o));
    }
    return all;
  }
  static std::string text(const std::string& name) { return export_text(load_campaign(name)); }

  /// The message of the exception that f throws, or "".
  static std::string error(const auto& f) { return test::refusal<std::exception>(f); }
  /// The program's exit code; its standard error goes to `file("stderr")`.
  int program(const std::string& arguments) const {
    const int code = std::system(
        ("'" LIECHECK_PROGRAM "' " + arguments + " >" + file("stdout") + " 2>" + file("stderr")).c_str());
    return WIFEXITED(code) ? WEXITSTATUS(code) : -1;
  }
  std::string written(const std::string& name) const { return read_whole(file(name)); }

  /// The seed of all random choices: the damaged bytes, the times of kills, the orders of merged files.
  static unsigned seed() {
    const char* given = std::getenv("LIECHECK_SEED");
    return given ? static_cast<unsigned>(std::strtoul(given, nullptr, 10)) : std::random_device{}();
  }

  fs::path folder_;
  const unsigned seed_ = seed();
  std::mt19937 random_{seed_};
  const testing::ScopedTrace trace_{__FILE__, __LINE__, fmt::format("to repeat: LIECHECK_SEED={}", seed_)};
};

#define EXPECT_SAYS(what, words) EXPECT_NE((what).find(words), std::string::npos) << (what)

TEST(RangesOfCases, AreDisjointAndCoalesced) {
  Ranges r;
  EXPECT_TRUE(r.add(10, 20));
  EXPECT_TRUE(r.add(30, 40));
  EXPECT_FALSE(r.add(19, 21));
  EXPECT_FALSE(r.add(5, 11));
  EXPECT_FALSE(r.add(0, 100));
  EXPECT_EQ(r.gaps(0, 50), (std::vector<Range>{{0, 10}, {20, 30}, {40, 50}}));
  EXPECT_EQ(r.gaps(12, 35), (std::vector<Range>{{20, 30}}));
  EXPECT_TRUE(r.add(20, 30));
  EXPECT_EQ(std::distance(r.begin(), r.end()), 1);
  EXPECT_TRUE(r.covers(10, 40));
  EXPECT_EQ(r.count(), 30u);
}

TEST_F(Stores, ExportTheSameForOneOrTwoThreadsAndForSevenShardsInAnyOrder) {
  const std::string one = text(run("one", options()));
  CampaignOptions two = options();
  two.jobs = 2, two.checkpoint_seconds = 0;
  EXPECT_EQ(text(run("two", two)), one);
  auto parts = shards(7);
  for (int i = 0; i < 3; ++i) {
    std::shuffle(parts.begin(), parts.end(), random_);
    merge_into(file("merged"), parts, false);  // merging into the same file again changes nothing
    EXPECT_EQ(text(file("merged")), one);
  }
  EXPECT_EQ(Store(file("merged"), Store::Open::existing).campaigns(), 1);
  EXPECT_NE(text(run("other", options(210, 43))), one);
}

TEST_F(Stores, ExportTheSameForThreeRanks) {
  if (std::system("mpirun --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no mpirun";
  const std::string what =
      " campaign --subject liecheck --subject textbook --property exp_oracle --scalar double --cases 210 "
      "--store ";
  program(what + file("one"));
  const int code =
      std::system(("OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe "
                   "-n 3 '" LIECHECK_PROGRAM "'" +
                   what + file("ranks") + " >" + file("out") + " 2>&1")
                      .c_str());
  if (written("out").find("built without MPI") != std::string::npos) GTEST_SKIP() << "built without MPI";
  EXPECT_EQ(WEXITSTATUS(code), 1) << written("out");  // textbook fails
  EXPECT_EQ(text(file("ranks")), text(file("one")));
}

TEST_F(Stores, ResumeAfterKillsToTheSameExport) {
  CampaignOptions o = options(600);
  for (double seconds = 0; seconds < 1; o.cases *= 2) {  // until a run can be killed several times
    const auto start = std::chrono::steady_clock::now();
    run("whole" + std::to_string(2 * o.cases), options(2 * o.cases));
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  const std::string whole = text(file("whole" + std::to_string(o.cases)));
  o.jobs = 2, o.checkpoint_seconds = 0;  // a transaction for every chunk, so that kills interrupt some
  std::uint64_t last = 0;
  int kills = 0, progressed = 0;
  while (kills < 30) {
    const pid_t child = fork();
    if (child == 0) {
      run("killed", o, true);
      _exit(0);
    }
    // The longest wait grows with each kill: a busy machine may be slow to start the process.
    std::this_thread::sleep_for(
        std::chrono::milliseconds(random_() % static_cast<unsigned>(30 + 10 * kills)));
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    if (WIFEXITED(status)) break;
    ++kills;
    Store store(file("killed"), Store::Open::create);  // throws if the file is not valid
    if (store.campaigns() == 0) continue;
    std::uint64_t done = 0;
    for (const auto& s : store.load(1).series) done += s.tally.cases;
    EXPECT_GE(done, last);
    if (done > last) ++progressed;
    last = done;
  }
  EXPECT_GE(kills, 10);
  EXPECT_GE(progressed, 3);
  EXPECT_EQ(text(run("killed", o, true)), whole);
}

TEST_F(Stores, RefuseAnotherCampaignAndNameWhatDiffers) {
  const std::string name = run("a", options());
  EXPECT_SAYS(error([&] { run("a", options()); }), "--resume");
  EXPECT_SAYS(error([&] { run("a", options(210, 7), true); }), "seed 42 against 7");
  EXPECT_SAYS(error([&] { run("a", options(211), true); }), "cases 210 against 211");
  CampaignOptions less = options();
  less.selection.subjects = {"textbook"};
  EXPECT_SAYS(error([&] { run("a", less, true); }), "exp_oracle of liecheck");
  CampaignOptions part = options();
  part.shards = 2;
  run("b", part);
  part.shard = 2;
  EXPECT_SAYS(error([&] { run("b", part, true); }), "cases 0..105 against 105..210");
}

TEST_F(Stores, ReplayEarlierCounterexamplesWithoutCountingThem) {
  run("a", options());
  CampaignOptions o = options(50, 7);
  Store store(file("a"), Store::Open::create);
  const StoredRun r = run_stored(o, built_in_robot(), store, false);
  EXPECT_GT(r.counterexamples.replayed, 0u);
  EXPECT_GT(r.counterexamples.failing.size(), 0u);
  EXPECT_EQ(text(file("a")), text(run("fresh", o)));
  EXPECT_EQ(text(file("a@1")), text(run("first", options())));
  o.shard = 2, o.shards = 2, o.seed = 8;
  EXPECT_EQ(run_stored(o, built_in_robot(), store, false).counterexamples.replayed, 0u);
}

TEST_F(Stores, MergeNamesMissingOverlappingAndForeignRanges) {
  const auto p = shards(3), q = shards(2), foreign = shards(1, 43);
  EXPECT_SAYS(error([&] { merge({p[0], p[2]}, false); }), "cases 70..140 of 0..210 are in none of");
  const std::string overlap = error([&] { merge({p[0], q[0], p[1], p[2]}, false); });
  EXPECT_SAYS(overlap, p[0] + " (cases 0..70)");
  EXPECT_SAYS(overlap, q[0] + " (cases 0..105)");
  EXPECT_SAYS(overlap, "overlap");
  EXPECT_SAYS(error([&] { merge({p[0], foreign[0]}, false); }), "seed 42 against 43");
  EXPECT_EQ(export_text(merge({p[0], p[1], p[0], p[2]}, false)), export_text(merge(p, false)));
  merge_into(file("part"), {p[2], p[0]}, true);
  EXPECT_FALSE(load_campaign(file("part")).complete());
  EXPECT_SAYS(error([&] { merge_into(file("part"), foreign, false); }),
              "part: holds a different campaign, which is unfinished or still runs");
  EXPECT_EQ(text(run("part", options(), true)), text(run("whole", options())));
  EXPECT_SAYS(error([&] { merge_into(file("part"), {p[0]}, true); }), "holds cases");
}

TEST_F(Stores, OfAnotherKindOrDamagedAreRefusedWithOneLine) {
  std::ofstream(file("text")) << "this is not a database, though it is long enough to be taken for one\n";
  EXPECT_SAYS(error([&] { run("text", options()); }), "not an SQLite database");
  EXPECT_SAYS(error([&] { load_campaign(file("none")); }), "no such store");
  EXPECT_SAYS(error([&] { Store(folder_.string(), Store::Open::create); }), "not a regular file");
  SQLite::Database(file("foreign"), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE).exec("CREATE TABLE t(x)");
  EXPECT_SAYS(error([&] { run("foreign", options()); }), "another program");
  const std::string good = run("good", options());
  const std::string bytes = written("good");
  int refused = 0;
  for (int i = 0; i < 40; ++i) {  // a damaged byte is refused unless it is unused
    std::string bad = bytes;
    bad[random_() % bad.size()] ^= static_cast<char>(1 + random_() % 255);
    std::ofstream(file("bad"), std::ios::binary) << bad;
    std::string now;
    const std::string why = error([&] { now = text(file("bad")); });
    refused += !why.empty();
    EXPECT_TRUE(!why.empty() || now == text(good));
    EXPECT_EQ(why.find('\n'), std::string::npos) << why;
  }
  EXPECT_GT(refused, 0);
  for (std::size_t size : {0, 100, 5000, 40000}) {
    std::ofstream(file("short"), std::ios::binary) << bytes.substr(0, size);
    EXPECT_NE(error([&] { text(file("short")); }), "");
  }
}

TEST_F(Stores, WithTrueSealsAndWhatNoCampaignWritesAreRefused) {
  const StoredCampaign good = load_campaign(run("good", options()));
  const auto written_as = [&](const std::string& name, auto change) {
    StoredCampaign bad = good;
    change(bad.series.at(0));
    Store(file(name), Store::Open::create).write(bad, false, {});
    return file(name);
  };
  const std::string unseen = written_as("unseen",
                                        [](StoredSeries&s) { s.labels.begin()->second.band += "\u200b"; }),
                    lost = written_as("lost", [](StoredSeries&s) {
                      s.tally.rows.begin()->second.failed = 1, s.failures.clear();
                    });
  EXPECT_SAYS(error([&] { load_campaign(unseen); }),
              "band_name of its table cells has a letter that cannot be seen");
  EXPECT_SAYS(error([&] { Store(lost, Store::Open::existing).counterexamples(); }), "a failure is missing");
  EXPECT_SAYS(error([&] { Store(file("new@1"), Store::Open::create); }), "a new one needs another name");
  EXPECT_FALSE(fs::exists(file("new@1")));
}

TEST_F(Stores, KeepTheirDataIfTheDiskIsFullOrReadOnly) {
  const std::string name = run("full", options(210));
  const std::string before = text(name);
  const std::string more = "campaign --subject textbook --scalar double --seed 7 --cases 2000 --store ";
  // A limit on the file's size [512 bytes] acts as a full disk.
  const auto limit = std::to_string(fs::file_size(name) / 512 + 16);
  EXPECT_EQ(std::system(("ulimit -f " + limit + "; '" LIECHECK_PROGRAM "' " + more + name + " >/dev/null 2>" +
                         file("stderr"))
                            .c_str()) >>
                8,
            2);
  EXPECT_SAYS(written("stderr"), name + ": ");
  EXPECT_EQ(text(file("full@1")), before);
  if (geteuid() != 0 || std::system("setpriv --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "needs root";
  fs::permissions(folder_, fs::perms(0755));
  fs::permissions(name, fs::perms(0444));
  EXPECT_EQ(std::system(("setpriv --reuid 65534 --clear-groups '" LIECHECK_PROGRAM "' " + more + name +
                         " >/dev/null 2>" + file("stderr"))
                            .c_str()) >>
                8,
            2);
  EXPECT_SAYS(written("stderr"), "read-only");
  EXPECT_EQ(text(file("full@1")), before);
}

TEST_F(Stores, StopAtASignalAndSayHowToResume) {
  const std::string store = "'" + file("a b") + "'";
  const std::string quoted = "campaign --no-hard-cases --subject textbook --cases 100000000 --store " + store;
  // The signal handlers are installed before the store is created.
  const int code =
      std::system(("'" LIECHECK_PROGRAM "' " + quoted + " >" + file("stdout") + " 2>&1 & while ! test -s " +
                   store + "; do sleep 0.1; done; sleep 1; kill -TERM $!; wait $!")
                      .c_str());
  EXPECT_EQ(WEXITSTATUS(code), 3);
  EXPECT_SAYS(written("stdout"), quoted + " --resume\n");
  EXPECT_SAYS(written("stdout"), "verdict incomplete");
  EXPECT_GT(load_campaign(file("a b")).series.at(0).tally.cases, 0u);
  EXPECT_EQ(program("campaign --store " + file("x") + " --shard 3/2"), 2);
  EXPECT_SAYS(written("stderr"), "--shard: '3/2' is not I/N");
}

TEST(Counted, IsGivenUpAtASignalUnlessItHasJustBegun) {
  Counted rows("reading");
  const auto read = [&] {
    for (int i = 0; i < 256; ++i) rows.next();
  };
  stop_requested = true;
  EXPECT_NO_THROW(read());
  std::this_thread::sleep_for(std::chrono::milliseconds(600));
  EXPECT_THROW(read(), GivenUp);
  stop_requested = false;
}

/// Such as the check of a large store, of which no row comes that next() could count.
TEST(Looking, EndsALongStatementAtASignal) {
  SQLite::Database database(":memory:", SQLite::OPEN_READWRITE);
  Counted shown("checking", "");
  const Looking looking(database, shown);
  std::this_thread::sleep_for(std::chrono::milliseconds(600));
  stop_requested = true;
  const char* const long_one =
      "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n WHERE i < 100000000) SELECT max(i) "
      "FROM n";
  EXPECT_THROW(database.execAndGet(long_one), SQLite::Exception);
  stop_requested = false;
}

}  // namespace
}  // namespace liecheck::properties

#undef EXPECT_SAYS

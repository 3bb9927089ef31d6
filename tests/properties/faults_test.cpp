// The program where the machine is not as usual: odd paths, no HOME, a locale with a decimal comma, a clock that
// is set back, files from the future, a full disk, a quota. It computes the same, or says what is wrong and loses nothing.

#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <store/merge.hpp>
#include <store/store.hpp>
#include <support/files.hpp>

#include "../sample.hpp"
#include "../scratch.hpp"

namespace liecheck::properties {
namespace {

namespace fs = std::filesystem;

/// A folder in which shell lines run. $L is the program, $S a scene, $R a robot.
class Faults : public testing::Test {
 protected:
  fs::path usual = fs::path(scratch()) / "usual";
  void SetUp() override { fs::create_directories(usual); }

  static std::string quoted(const std::string& text) {
    std::string out = "'";
    for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
  }
  /// The exit code, or 128 + the signal.
  static int shell(const fs::path& folder, const std::string& line) {
    const std::string whole = "cd " + quoted(folder.string()) + " && export L='" + LIECHECK_PROGRAM +
                              "' S='" LIECHECK_FIXTURES "/scenes/damped_spring.yaml' R='" LIECHECK_FIXTURES
                              "/robots/quadruped.urdf'; { " +
                              line + "; } >out 2>err </dev/null";
    const int status = std::system(whole.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
};

/// The beginning of a line whose commands run with a changed system: tests/adapters/odd_machine.c.
std::string preloaded(const std::string& how) {
  return "export ASAN_OPTIONS=verify_asan_link_order=0 LD_PRELOAD='" LIECHECK_ODD_MACHINE "' " + how + "; ";
}

const std::string campaign =
    "$L campaign --no-hard-cases --property exp_oracle --subject liecheck --scalar double --cases 50 -j 2 ";
/// What each command writes, without times.
const std::pair<std::string, std::string> commands[] = {
    {campaign + "--store s.db --json r.json && $L export s.db --out e.txt", "e.txt"},
    {campaign + "--shard 1/2 --store a.db && " + campaign +
         "--shard 2/2 --store b.db && $L merge m.db a.db b.db && $L export m.db --out f.txt",
     "f.txt"},
    {"$L report s.db --out page && tail -c 8 page/report.html >tail", "tail"},
    {"$L scene run \"$S\" --csv s.csv", "s.csv"},
    {"cp \"$R\" q.urdf && $L robot q.urdf --root free-flyer >q.txt", "q.txt"},
    {"$L replay raw.exp_oracle.liecheck.double.none.1,0,0,0,0,1e-5 >p.txt", "p.txt"}};

void expect_the_same(const fs::path& usual, const fs::path& odd,
                     const std::function<int(const fs::path&, const std::string&)>& there,
                     const std::function<int(const fs::path&, const std::string&)>& here) {
  for (const fs::path& folder : {usual, odd})
    for (const char* file : {"s.db", "a.db", "b.db", "m.db"}) fs::remove(folder / file);
  for (const auto& [line, file] : commands) {
    ASSERT_EQ(here(usual, line), 0) << line << read_whole(usual / "err");
    EXPECT_EQ(there(odd, line), 0) << line << read_whole(odd / "err");
    EXPECT_FALSE(read_whole(usual / file).empty()) << line;
    EXPECT_EQ(read_whole(odd / file), read_whole(usual / file)) << line;
  }
}

TEST_F(Faults, OddPathsChangeNothing) {
  for (const char* name :
       {"with spaces", "Größe 机器人", "a'b\"c$d`e;f&g*h", "-n --help", "100% {} \\n", "line\nbreak"}) {
    const fs::path odd = fs::path(scratch()) / name;
    fs::create_directories(odd);
    SCOPED_TRACE(name);
    expect_the_same(usual, odd, shell, shell);
  }
}

TEST_F(Faults, NoHomeAndNoTerminalAndNothingInTheEnvironmentChangeNothing) {
  const fs::path odd = fs::path(scratch()) / "bare";
  fs::create_directories(odd);
  expect_the_same(
      usual, odd,
      [](const fs::path& folder, const std::string& line) {
        return shell(folder, "env -i L=\"$L\" S=\"$S\" R=\"$R\" /bin/sh -c " + quoted(line));
      },
      shell);
}

TEST_F(Faults, ALocaleWithADecimalCommaChangesNothing) {
  const fs::path odd = fs::path(scratch()) / "comma";
  fs::create_directories(odd);
  // Compiled here, since few machines have one installed.
  if (shell(odd, "localedef -i de_DE -f UTF-8 ./de_DE.UTF-8") != 0)
    GTEST_SKIP() << "no source of a locale: " << read_whole(odd / "err");
  ASSERT_EQ(shell(odd, "LOCPATH=\"$PWD\" LC_ALL=de_DE.UTF-8 locale decimal_point"), 0);
  ASSERT_EQ(read_whole(odd / "out"), ",\n");
  expect_the_same(
      usual, odd,
      [](const fs::path& folder, const std::string& line) {
        return shell(folder, "export LOCPATH=\"$PWD\" LC_ALL=de_DE.UTF-8; " + line);
      },
      shell);
}

TEST_F(Faults, AClockThatIsSetBackChangesNothing) {
  const fs::path odd = fs::path(scratch()) / "clock";
  fs::create_directories(odd);
  const std::string back = preloaded("LIECHECK_CLOCK=back");
  ASSERT_EQ(shell(odd, back + "test $(date +%s) -lt $(( $(env -u LD_PRELOAD date +%s) - 3000 ))"), 0);
  expect_the_same(
      usual, odd, [&](const fs::path& folder, const std::string& line) { return shell(folder, back + line); },
      shell);
}

// A clock that was set back: what is there comes from the future.
TEST_F(Faults, FilesFromTheFutureAreUsedAsOthers) {
  fs::remove(usual / "s.db");
  ASSERT_EQ(shell(usual, campaign + "--store s.db"), 0) << read_whole(usual / "err");
  ASSERT_EQ(shell(usual, "touch -d '2099-01-01' s.db . && " + campaign + "--store s.db --resume"), 0)
      << read_whole(usual / "err");
  ASSERT_EQ(
      shell(usual, "touch -d '1970-01-02' s.db && $L export s.db --out e.txt && $L report s.db --out page"),
      0)
      << read_whole(usual / "err");
}

/// A disk of `size`, where this process may mount one.
class Disk {
 public:
  Disk(const fs::path& at, const std::string& size) : at_(at) {
    fs::create_directories(at);
    there_ = ::mount("tmpfs", at.c_str(), "tmpfs", 0, ("size=" + size).c_str()) == 0;
  }
  ~Disk() {
    if (there_) ::umount2(at_.c_str(), MNT_DETACH);
  }
  explicit operator bool() const { return there_; }

 private:
  fs::path at_;
  bool there_;
};

/// Runs commands in a folder after the line `before`, where files may end early. Returns how many ended with an error.
int errors_of_commands(const fs::path& folder, const std::string& before,
                       const std::function<int(const fs::path&, const std::string&)>& shell) {
  int errors = 0;
  for (const std::string& command :
       {campaign + "--store s.db --json r.json", std::string("$L scene run \"$S\" --csv s.csv --json s.json"),
        std::string("$L report --subject liecheck --cases 2 --no-cost --no-scenes --out page"),
        std::string("$L hunt --subject textbook --op exp6 --evaluations 100 --corpus c.txt")}) {
    // Its messages go to another disk.
    const int code =
        shell(fs::path(scratch()), before + "cd " + folder.filename().string() + " && " + command);
    const std::string err = read_whole(fs::path(scratch()) / "err");
    EXPECT_TRUE(code == 0 || code == 1 || code == 2 || code == 3) << code << command << err;
    if (code == 2) {
      ++errors;
      EXPECT_NE(err.find("liecheck: "), std::string::npos) << command << err;
      EXPECT_NE(err.find(": "), err.rfind(": ")) << "it names no file and reason: " << command << err;
    }
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      const std::string name = entry.path().string();
      if (name.ends_with(".json")) {
        EXPECT_TRUE(nlohmann::json::accept(read_whole(name))) << name;
      }
      if (name.ends_with(".html")) {
        EXPECT_TRUE(read_whole(name).ends_with("</html>\n")) << name;
      }
      if (!name.ends_with(".db")) continue;
      Store store(name, Store::Open::existing);  // throws if it is not whole
      for (int i = 1; i <= store.campaigns(); ++i) EXPECT_NO_THROW(store.load(i)) << name;
    }
    for (const auto& entry : fs::directory_iterator(folder)) fs::remove_all(entry.path());
  }
  return errors;
}

// The disk is full at another place of the output in each round, and empty again afterwards.
TEST_F(Faults, AFullDiskIsAnErrorThatLosesNothingThatWasStored) {
  const fs::path full = fs::path(scratch()) / "full";
  int errors = 0;
  for (int pages = 1; pages < 40; pages += sample(9, 3)) {
    const Disk disk(full, std::to_string(4 * pages) + "k");
    if (!disk) GTEST_SKIP() << "this process may not mount a small disk";
    SCOPED_TRACE(pages);
    errors += errors_of_commands(full, "", shell);
  }
  EXPECT_GT(errors, sample(3, 10));
}

TEST_F(Faults, AFullDiskNamesTheStoreThatWasToBeMerged) {
  const fs::path all = scratch(), full = all / "small";
  ASSERT_EQ(shell(all, campaign + "--store whole.db"), 0);
  const Disk disk(full, "16k");
  if (!disk) GTEST_SKIP() << "this process may not mount a small disk";
  EXPECT_EQ(shell(all, "$L merge small/m.db whole.db"), 2);
  EXPECT_EQ(read_whole(all / "err"), "liecheck: small/m.db: the disk is full\n");
  EXPECT_TRUE(fs::is_empty(full));
}

TEST_F(Faults, AQuotaIsAnErrorThatLosesNothingThatWasStored) {
  const fs::path folder = fs::path(scratch()) / "quota";
  fs::create_directories(folder);
  int errors = 0;
  for (const int bytes : sample(std::vector{0, 5000, 50000}, {0, 1000, 5000, 20000, 50000, 100000})) {
    SCOPED_TRACE(bytes);
    errors += errors_of_commands(folder, preloaded("LIECHECK_QUOTA=" + std::to_string(bytes)), shell);
    // At most so many blocks a file, which are those of the messages, too.
    if (bytes > 0)
      errors += errors_of_commands(folder, "ulimit -f " + std::to_string(bytes / 512) + "; ", shell);
  }
  EXPECT_GT(errors, sample(5, 10));
}

}  // namespace
}  // namespace liecheck::properties

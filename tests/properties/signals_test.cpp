// SIGINT, SIGTERM and SIGHUP at random moments of every command: it ends soon, by itself, with exit code 3 (or
// as usual, if it was done), and what it leaves is whole. Only before main() has begun may a signal kill it.
//
// By default each command gets one signal within its first seconds, and two in the preset `nightly`.
// LIECHECK_SIGNALS=50 sends each of the three signals at 50 moments, as many in each octave of the time since the
// start. Moments of the whole run take hours; LIECHECK_SIGNALS_WITHIN=2 keeps them within the first 2 s of each
// command. LIECHECK_SEED repeats the moments, and GTEST_TOTAL_SHARDS with GTEST_SHARD_INDEX divides the commands
// among several runs.

#include <gtest/gtest.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <random>
#include <store/merge.hpp>
#include <store/store.hpp>
#include <store/store_path.hpp>
#include <thread>

#include "../sample.hpp"
#include "../scratch.hpp"

namespace liecheck::properties {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// Processor time from the signal to the end, for each thread. The longest step between two looks at
// stop_requested is one case of a law, a fraction of a second. A sanitizer makes the program about ten times
// slower.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr double soon = 20;
#else
constexpr double soon = 2;
#endif
constexpr double hang = 60;  ///< [s] of the clock: other programs may use the processor

const std::string robot = LIECHECK_FIXTURES "/robots/quadruped.urdf", scenes = LIECHECK_FIXTURES "/scenes/";

struct Command {
  const char* name;
  std::string arguments;
  double seconds;           ///< about how long it runs
  std::string record = {};  ///< the file of --json
  bool stores = false;      ///< needs the stores in/a, in/b and in/c
};
std::ostream& operator<<(std::ostream& out, const Command& c) {
  return out << "liecheck " << c.arguments;
}

std::string read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A run of the program in a folder; its output goes to the files `out` and `err` there.
class Process {
 public:
  Process(const fs::path& folder, const std::string& arguments) : child_(::fork()) {
    if (child_ != 0) return;
    const auto open = [&](const char* name, int as) {
      const int file = ::open((folder / name).c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
      ::dup2(file, as);
      ::close(file);
    };
    open("out", 1), open("err", 2);
    for (const int number :
         {SIGINT, SIGTERM, SIGHUP})  // a test in the background may inherit that they are ignored
      std::signal(number, SIG_DFL);
    const std::string line = "exec '" LIECHECK_PROGRAM "' " + arguments;
    if (::chdir(folder.c_str()) == 0) ::execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
    ::_exit(127);
  }
  ~Process() {
    if (!ended_) ::kill(child_, SIGKILL), ::waitpid(child_, nullptr, 0);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void signal(int number) const { ::kill(child_, number); }
  bool ended() {
    ended_ = ended_ || ::wait4(child_, &status_, WNOHANG, &usage_) == child_;
    return ended_;
  }
  /// Returns false if it does not end within `seconds`.
  bool ends_within(double seconds) {
    const auto start = Clock::now();
    while (!ended()) {
      if (std::chrono::duration<double>(Clock::now() - start).count() > seconds) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return true;
  }
  /// Whether it has installed its handler of this signal. The shell that starts it may have one of its own.
  bool handles(int number) const {
    std::error_code none;
    if (!fs::equivalent(fmt::format("/proc/{}/exe", child_), LIECHECK_PROGRAM, none)) return false;
    const std::string status = read(fmt::format("/proc/{}/status", child_));
    const auto at = status.find("SigCgt:\t");
    return at != status.npos && (std::stoull(status.substr(at + 8, 16), nullptr, 16) >> (number - 1) & 1);
  }
  /// The processor time of all its threads so far [s].
  double processor_time() const {
    clockid_t clock;
    timespec t{};
    if (!ended_) {
      if (::clock_getcpuclockid(child_, &clock) == 0) ::clock_gettime(clock, &t);
      return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
    }
    const auto seconds = [](const timeval& v) {
      return static_cast<double>(v.tv_sec) + 1e-6 * static_cast<double>(v.tv_usec);
    };
    return seconds(usage_.ru_utime) + seconds(usage_.ru_stime);
  }
  int code() const { return WIFEXITED(status_) ? WEXITSTATUS(status_) : -1; }
  int killed_by() const { return WIFSIGNALED(status_) ? WTERMSIG(status_) : 0; }

 private:
  pid_t child_;
  bool ended_ = false;
  int status_ = 0;
  rusage usage_{};
};

class StoppedProgram : public testing::Test {
 protected:
  int run(const std::string& arguments) const {
    Process p(folder_, arguments);
    return p.ends_within(300) ? p.code() : -1;
  }
  const fs::path folder_ = own_folder();
};

constexpr const char* few_cases =
    "campaign --no-hard-cases --subject liecheck --subject textbook --property exp_oracle --scalar double -j "
    "2";

/// What is checked of a program that was stopped or killed.
class CheckedFiles : public StoppedProgram {
 protected:
  /// in/long.yaml.
  void make_scene(const std::string& duration) const {
    std::string scene = read(scenes + "damped_spring.yaml");
    scene.replace(scene.find("duration: 10 s"), 14, "duration: " + duration);
    std::ofstream(folder_ / "in" / "long.yaml") << scene;
  }
  void make_stores() const {
    for (const auto& [name, flags] :
         {std::pair("a", "--shard 1/2"), std::pair("b", "--shard 2/2"), std::pair("c", "--seed 7")})
      ASSERT_EQ(run(fmt::format("{} --cases 200 {} --store in/{}", few_cases, flags, name)), 1);
  }

  /// Checks what a stopped or finished command left behind.
  void check_files(const Command& c, const Process& p, bool killed) const {
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
      const fs::path file = entry.path();
      const std::string extension = file.extension().string(), text = entry.is_directory() ? "" : read(file);
      if (!killed) {
        EXPECT_TRUE(extension.size() != 7 || extension == ".limits")  // .XXXXXX
            << file << ": an unfinished file";
        EXPECT_EQ(file.string().find("-journal"), std::string::npos) << file << ": an unfinished transaction";
      }
      if (extension == ".json") {
        EXPECT_TRUE(nlohmann::json::accept(text)) << file;
      }
      if (extension == ".csv" || extension == ".html") {
        EXPECT_TRUE(text.ends_with('\n')) << file;
      }
      if (extension == ".db") {
        Store store(file.string(), Store::Open::create);  // throws if it is not valid
        for (int i = 1; i <= store.campaigns(); ++i) EXPECT_NO_THROW(store.load(i)) << file;
      }
    }
    if (c.record.empty() || killed) return;
    const std::string err = read(folder_ / "err");
    if (!fs::exists(folder_ / c.record)) {  // the signal came before there was a result
      EXPECT_TRUE(err.ends_with("interrupted\n")) << err;
      return;
    }
    const auto record = nlohmann::json::parse(read(folder_ / c.record));
    const bool partial = record["verdict"] == "incomplete" || record["verdict"] == "stopped";
    EXPECT_EQ(partial, p.code() == 3) << record["verdict"];
  }
};

class Signals : public CheckedFiles, public testing::WithParamInterface<Command> {
 protected:
  /// Runs the command in an empty folder, and sends a signal after `moment` seconds and, if `again`, another.
  void trial(const Command& c, int number, double moment, bool again) {
    for (const auto& entry : fs::directory_iterator(folder_))
      if (entry.path().filename() != "in") fs::remove_all(entry.path());
    const std::string what =
        fmt::format("{} after {:.3f} s{}", ::strsignal(number), moment, again ? ", and again" : "");
    SCOPED_TRACE(what);
    Process p(folder_, c.arguments);
    std::this_thread::sleep_for(std::chrono::duration<double>(moment));
    const bool handled = p.handles(number);
    const double before = p.processor_time();
    const bool done = p.ended();  // asked after `before`, which is 0 for a process that has ended
    p.signal(number);
    if (again) {
      std::this_thread::sleep_for(std::chrono::milliseconds(400));  // within 0.3 s they count as one
      p.signal(number);
    }
    ASSERT_TRUE(p.ends_within(hang)) << "it hangs";
    const double after = done ? 0 : p.processor_time() - before;
    fmt::print("{:<60} {:<8} {:.2f} s later\n", what,
               p.killed_by() ? fmt::format("signal {}", p.killed_by()) : fmt::format("exit {}", p.code()),
               after);
    const bool killed = p.killed_by() == number && (again || !handled);
    const std::string err = read(folder_ / "err");
    EXPECT_TRUE(killed || p.killed_by() == 0) << "killed by signal " << p.killed_by() << "\n" << err;
    EXPECT_TRUE(killed || p.code() == 0 || p.code() == 1 || p.code() == 3) << p.code() << "\n" << err;
    EXPECT_LE(after, soon * 2) << "processor time of two threads after the signal [s]";
    check_files(c, p, killed);
  }
};

TEST_P(Signals, EndTheProgramSoonAndLeaveWholeFiles) {
  const Command& c = GetParam();
  const char *moments = std::getenv("LIECHECK_SIGNALS"), *given = std::getenv("LIECHECK_SEED");
  const unsigned seed =
      given ? static_cast<unsigned>(std::strtoul(given, nullptr, 10)) : std::random_device{}();
  fmt::print("LIECHECK_SEED={}\n", seed);
  SCOPED_TRACE(fmt::format("to repeat: LIECHECK_SEED={}", seed));
  std::mt19937 random(seed);
  fs::create_directory(folder_ / "in");
  make_scene("20000 s");
  if (c.stores) make_stores();
  const auto moment = [&](double end) { return std::uniform_real_distribution<double>(0, end)(random); };
  std::vector<int> numbers{SIGINT, SIGTERM, SIGHUP};
  if (!moments) {
    std::shuffle(numbers.begin(), numbers.end(), random);
    trial(c, numbers[0], moment(std::min(c.seconds, 1.2)), sample(random() % 2 == 0, false));
    if (sample(false, true)) trial(c, numbers[1], moment(std::min(c.seconds, 1.2)), random() % 2);
    return;
  }
  constexpr double start = 0.005;  // [s], before main()
  const char* within = std::getenv("LIECHECK_SIGNALS_WITHIN");
  const double octaves = std::log2((within ? std::min(c.seconds, std::atof(within)) : c.seconds) / start);
  for (const int number : numbers)
    for (long i = std::atol(moments); i > 0; --i)
      trial(c, number, start * std::exp2(moment(octaves)), i % 5 == 0);
}

INSTANTIATE_TEST_SUITE_P(
    Of, Signals,
    testing::Values(
        Command{"list", "list", 0.5}, Command{"operations", "list --operations", 0.1},
        Command{"completion", "completion bash", 0.1}, Command{"robot", "robot " + robot, 0.1},
        Command{"scene_keys", "scene keys", 0.1},
        Command{"scene_explain", "scene explain " + scenes + "dzhanibekov_1e-6.yaml", 0.3},
        Command{"replay", "replay raw.exp_oracle.textbook.double.none.1,0,0,0,0,1e-5", 0.2},
        Command{"merge", "merge m.db in/a in/b", 0.2, "", true},
        Command{"export", "export in/c --out text", 0.2, "", true},
        Command{"compare", "compare in/c in/c", 0.2, "", true},
        Command{"report_of_a_store", "report in/c --out r", 0.5, "", true},
        Command{"hard_cases", "hard-cases --subject all --json r.json", 10, "r.json"},
        Command{"campaign", "campaign --subject all --cases 20000 --store s.db --json r.json", 20, "r.json"},
        Command{"campaign_that_fails",
                "campaign --no-hard-cases --subject textbook --cases 20000 --json r.json", 10, "r.json"},
        Command{"campaign_by_time", "campaign --no-hard-cases --for 5s --json r.json", 8, "r.json"},
        Command{"hunt", "hunt --subject textbook --op exp6 --for 3s --versus-random --corpus c.txt", 7},
        Command{"promise", "promise textbook --cases 20000 --out p.limits", 20},
        Command{"sweep", "lab sweep --json r.json", 60, "r.json"},
        Command{"sweep_of_an_operation", "lab sweep --operation exp6 --json r.json", 60, "r.json"},
        Command{"cost", "cost --for 5s --json r.json", 20, "r.json"},
        Command{"cost_with_flags", "cost --flags --op exp6 --op integrate --for 3s --json r.json", 8,
                "r.json"},
        Command{"cost_of_batches", "cost --batches", 60},
        Command{"bounds", "lab bounds --boxes 10000000 --state s.json --json r.json", 60, "r.json"},
        Command{"horizons", "lab horizons --steps 3000000 --state s.json --json r.json", 120, "r.json"},
        Command{"environments", "environments --only up --only gcc-O0 --dir builds --json r.json", 120,
                "r.json"},
        Command{"rounding", "lab rounding --inputs 3000 --json r.json", 60, "r.json"},
        Command{"bugs", "lab bugs --for-each 1s --json r.json", 60, "r.json"},
        Command{"history", "lab history --cases 1000000 --json r.json", 60, "r.json"},
        Command{"lattice", "lab lattice --faults 300 --resume f.txt --json r.json", 60, "r.json"},
        Command{"limits", "lab limits --cases 100 --out .", 30},
        Command{"wire", "lab wire --for-each 0.1s --json r.json --adapter in-process:" LIECHECK_EXP6_ADAPTER,
                60, "r.json"},
        Command{"speed", "lab speed --for-each 0.1s --json r.json", 60, "r.json"},
        Command{"league", "lab league --record r.json", 60, "r.json"},
        Command{"scene_run", "scene run in/long.yaml --csv s.csv --json r.json", 10, "r.json"},
        Command{"scene_sweep", "scene sweep --for 5s --json r.json", 120, "r.json"},
        Command{"scene_sweep_of_a_file",
                "scene sweep " + scenes + "chain_zero_gravity.yaml --no-orders --for 3s --json r.json", 30,
                "r.json"},
        Command{"report", "report --cases 20 --no-cost --no-scenes --out r", 90},
        Command{"whole_report", "report --cases 1 --out r", 180}),
    [](const auto& info) { return std::string(info.param.name); });

// Nothing is lost: cases that were done are not run again, and the export is that of a run without a signal.
TEST_F(StoppedProgram, ResumesACampaignToTheSameExport) {
  const std::string campaign = fmt::format("{} --cases 150000 --store ", few_cases);
  ASSERT_EQ(run(campaign + "whole.db"), 1);
  const std::string whole = export_text(load_campaign((folder_ / "whole.db").string()));
  std::uint64_t done = 0;
  int stops = 0;
  for (int code = 3; code == 3 && stops < 30; ++stops) {
    Process p(folder_, campaign + "s.db --resume");
    std::this_thread::sleep_for(std::chrono::milliseconds(300 + 100 * stops));
    p.signal(SIGTERM);
    ASSERT_TRUE(p.ends_within(hang));
    code = p.code();
    if (!fs::exists(folder_ / "s.db")) continue;
    std::uint64_t now = 0;
    for (const auto& s : load_campaign((folder_ / "s.db").string()).series) now += s.tally.cases;
    EXPECT_GE(now, done);
    done = now;
  }
  EXPECT_GT(stops, 1);
  EXPECT_EQ(export_text(load_campaign((folder_ / "s.db").string())), whole);
}

/// A command that is killed, the same command afterwards, and the file that both write.
struct Killed {
  const char* name;
  std::string arguments, again, result;
  int code;  ///< of the whole command
};

class Kills : public CheckedFiles, public testing::WithParamInterface<Killed> {
 protected:
  /// What a result says, without times.
  std::string content(const std::string& file) const {
    const std::string path = (folder_ / file).string();
    if (file.ends_with(".db")) return export_text(load_campaign(path));
    const std::string text = read(path);
    if (!file.ends_with(".html")) return text;
    return text.ends_with("</html>\n") ? "a whole page" : "a part of a page";
  }
};

// kill -9 at random moments of the run: LIECHECK_KILLS=100 kills each command a hundred times.
TEST_P(Kills, LeaveWholeFilesAndTheCommandSucceedsAfterwards) {
  const Killed& k = GetParam();
  const char *number = std::getenv("LIECHECK_KILLS"), *given = std::getenv("LIECHECK_SEED");
  const int kills = number ? std::atoi(number) : sample(1, 3);
  std::mt19937 random(given ? static_cast<unsigned>(std::strtoul(given, nullptr, 10))
                            : std::mt19937::default_seed);
  fs::create_directory(folder_ / "in");
  make_scene("1000 s");
  make_stores();
  const auto begin = Clock::now();
  ASSERT_EQ(run(k.arguments), k.code) << read(folder_ / "err");
  const double whole = std::chrono::duration<double>(Clock::now() - begin).count();
  const std::string right = content(k.result);
  int during = 0;
  for (int i = 0; i < kills; ++i) {
    for (const auto& entry : fs::directory_iterator(folder_))
      if (entry.path().filename() != "in") fs::remove_all(entry.path());
    const double moment = std::uniform_real_distribution<double>(0, whole)(random);
    SCOPED_TRACE(fmt::format("killed after {:.3f} of {:.3f} s", moment, whole));
    {
      Process p(folder_, k.arguments);
      std::this_thread::sleep_for(std::chrono::duration<double>(moment));
      p.signal(SIGKILL);
      ASSERT_TRUE(p.ends_within(hang));
      during += p.killed_by() == SIGKILL;
      check_files({k.name, k.arguments, whole}, p, true);
    }
    fs::remove(folder_ / "err");
    ASSERT_EQ(run(k.again), k.code) << read(folder_ / "err");
    EXPECT_EQ(content(k.result), right);
  }
  fmt::print("{} of {} kills while it ran, {:.2f} s\n", during, kills, whole);
  EXPECT_GT(during, 0);
}

const std::string killed_campaign = fmt::format("{} --cases 60000 --store s.db", few_cases);
INSTANTIATE_TEST_SUITE_P(
    Of, Kills,
    testing::Values(Killed{"campaign", killed_campaign, killed_campaign + " --resume", "s.db", 1},
                    Killed{"merge", "merge m.db in/a in/b", "merge m.db in/a in/b", "m.db", 0},
                    Killed{"report", "report in/c --out r", "report in/c --out r", "r/report.html", 0},
                    Killed{"scene", "scene run in/long.yaml --csv s.csv",
                           "scene run in/long.yaml --csv s.csv", "s.csv", 0}),
    [](const auto& info) { return std::string(info.param.name); });

// The first signal must not wait for a program that sends no data, or that does not read.
TEST_F(StoppedProgram, EndsWhileItWaitsForAPipe) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  const int writer = ::open((folder_ / "pipe").c_str(), O_RDWR);  // a writer that sends nothing
  for (const char* arguments :
       {"robot pipe", "campaign --robot pipe", "hunt --subject liecheck --op exp6 --robot pipe",
        "scene run pipe", "scene explain pipe", "scene sweep pipe", "report pipe"}) {
    Process p(folder_, arguments);
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    p.signal(SIGTERM);
    EXPECT_TRUE(p.ends_within(10)) << arguments;
    EXPECT_EQ(p.code(), 3) << arguments << read(folder_ / "err");
  }
  ::close(writer);
}

TEST_F(StoppedProgram, EndsWhileItsOutputIsNotRead) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  const int reader = ::open((folder_ / "pipe").c_str(), O_RDWR);
  const std::string full(static_cast<std::size_t>(::fcntl(reader, F_GETPIPE_SZ)), 'x');
  ASSERT_EQ(::write(reader, full.data(), full.size()), static_cast<ssize_t>(full.size()));
  Process p(folder_, "list --operations >pipe");
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  EXPECT_FALSE(p.ended());
  p.signal(SIGTERM);
  EXPECT_TRUE(p.ends_within(10));
  EXPECT_EQ(p.code(), 3);
  ::close(reader);
}

TEST_F(StoppedProgram, EndsWithinACaseOfALargeRobot) {
  std::string urdf = "<robot name='chain'>";
  constexpr int joints = 800;  // a case takes two minutes
  for (int i = 0; i <= joints; ++i) {
    urdf += fmt::format(
        "<link name='l{}'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' "
        "izz='1'/>"
        "</inertial></link>\n",
        i);
    if (i > 0)
      urdf += fmt::format(
          "<joint name='j{}' type='prismatic'><parent link='l{}'/><child link='l{}'/><limit lower='-1' "
          "upper='1' effort='1' velocity='1'/></joint>\n",
          i, i - 1, i);
  }
  std::ofstream(folder_ / "r.urdf") << urdf << "</robot>";
  Process p(folder_, "campaign --no-hard-cases --robot r.urdf --property tree_momentum --cases 9 -j 1");
  std::this_thread::sleep_for(std::chrono::seconds(3));
  EXPECT_NE(read(folder_ / "err").find("801 joints: a case of a law on trees takes about"),
            std::string::npos);
  const double before = p.processor_time();
  ASSERT_FALSE(p.ended());
  p.signal(SIGTERM);
  ASSERT_TRUE(p.ends_within(hang));
  EXPECT_EQ(p.code(), 3);
  EXPECT_LE(p.processor_time() - before, soon);
}

TEST_F(StoppedProgram, EndsWhatTheShellOfAnAdapterStarted) {
  std::ofstream(folder_ / "start") << "echo $$ >id; exec sleep 1000\n";
  Process p(folder_, "adapter check 'sh ./start; true'");
  std::string id;
  for (int looks = 0; looks < 600 && !id.ends_with('\n'); ++looks) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    id = read(folder_ / "id");
  }
  ASSERT_TRUE(id.ends_with('\n'));
  const std::string started = fmt::format("/proc/{}/cmdline", std::stoi(id));
  EXPECT_NE(read(started), "");
  p.signal(SIGTERM);
  EXPECT_TRUE(p.ends_within(hang));
  EXPECT_EQ(p.code(), 3);
  for (int looks = 0; looks < 100 && !read(started).empty(); ++looks)
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_EQ(read(started), "");
  if (!read(started).empty()) ::kill(std::stoi(id), SIGKILL);
}

}  // namespace
}  // namespace liecheck::properties

// Times of adapters: `cost --adapter` and `report --adapter`.

#include <gtest/gtest.h>

#include <conventions/stated.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <operations/operations.hpp>
#include <support/files.hpp>

#include "../scratch.hpp"

namespace liecheck::properties {
namespace {

class AdapterCost : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  int run(const std::string& arguments, const std::string& way = "none") const {
    return WEXITSTATUS(std::system(("cd '" + folder_.string() + "' && LIECHECK_BAD=" + way +
                                    " timeout 120 " LIECHECK_PROGRAM " " + arguments + " >out 2>err")
                                       .c_str()));
  }
  std::string text(const char* file) const { return read_whole(folder_ / file); }
  nlohmann::json row(const nlohmann::json& cost, const char* subject) const {
    for (const auto& r : cost["rows"])
      if (r["subject"] == subject) return r;
    return {};
  }
  const std::filesystem::path folder_ = std::filesystem::path(liecheck::scratch()) / "adapter_cost";
};

TEST_F(AdapterCost, IsMeasuredBesideThatOfTheSameFunctionInTheProgram) {
  ASSERT_EQ(run("cost --op exp6 --scalar double --for 2s --json r.json --adapter " LIECHECK_EXP6_ADAPTER), 0)
      << text("err");
  const auto cost = nlohmann::json::parse(text("r.json"));
  const auto own = row(cost, "liecheck"), outside = row(cost, "exp6");
  ASSERT_FALSE(own.is_null() || outside.is_null());
  EXPECT_EQ(own["error"], outside["error"]);  // the same code on the same inputs
  // The same code, called directly, costs about the same: not the microseconds of another process.
  const double ratio = outside["sets"].back()["latency"]["ns"].get<double>() /
                       own["sets"].back()["latency"]["ns"].get<double>();
  EXPECT_GT(ratio, 0.2);
  EXPECT_LT(ratio, 5);
}

TEST_F(AdapterCost, IsThatOfTheLoopsThatAreCompiledWithIt) {
  const std::string cost = "cost --scalar double --for 2s --json r.json --op ";
  ASSERT_EQ(run(cost + "exp6 --adapter " LIECHECK_EXP6_ADAPTER), 0) << text("err");
  const auto by_loops = row(nlohmann::json::parse(text("r.json")), "exp6");
  EXPECT_EQ(by_loops["timed"], "numbers");
  EXPECT_GT(by_loops["sets"].back()["interface"]["ns"].get<double>(), 0);
  EXPECT_NE(text("out").find("timed by its own loops on numbers; through the interface, a call takes"),
            std::string::npos);
  // One in C has no loops.
  ASSERT_EQ(run(cost + "exp3_quaternion --adapter " LIECHECK_C_ADAPTER), 0) << text("err");
  const auto by_calls = row(nlohmann::json::parse(text("r.json")), "rotations");
  EXPECT_EQ(by_calls["timed"], "calls");
  EXPECT_FALSE(by_calls["sets"].back().contains("interface"));
}

TEST_F(AdapterCost, OfACommandIsMeasuredInItsProcess) {
  // It takes a microsecond for one input, and a hundredth for many at once, as it says, and refuses every call.
  std::ofstream(folder_ / "slow.py") << R"(
import sys
read, answers = sys.stdin.buffer, sys.stdout.buffer
def say(line, more=b""):
    answers.write(line.encode() + b"\n" + more)
    answers.flush()
read.readline()
say('{"protocol": 1, "name": "slow", "version": "1", "operations": {"exp3_quaternion": ["double"]}, '
    '"timed": {"exp3_quaternion": "one, many"}}')
for line in iter(read.readline, b""):
    words = line.decode().split()
    if words[0] == "time":
        n, passes = int(words[4]), int(words[5])
        read.read(n * 24)
        say(f"timed {dict(one=1000, many=10, nothing=100)[words[1]] * n * passes}")
    else:
        n = int(words[3])
        read.read(n * 24)
        say(f"done {n} no", bytes([1]) * n + bytes(n * 32))
)";
  ASSERT_EQ(
      run("cost --op exp3_quaternion --scalar double --for 2s --json r.json --adapter 'python3 slow.py'"), 0)
      << text("err");
  const auto set = row(nlohmann::json::parse(text("r.json")), "slow")["sets"].back();
  const auto ns = [&](const char* what) { return set[what]["ns"].get<double>(); };
  EXPECT_NEAR(ns("latency") / ns("throughput"), 100, 30);  // of another moment of the machine
  EXPECT_NEAR(ns("latency") / ns("interface"), 10, 3);
  EXPECT_NE(text("out").find("on numbers, one at a time, and as throughput 1280 at once; its loop alone takes"),
            std::string::npos);
}

TEST_F(AdapterCost, OfACommandThatDoesNotTimeItselfIsRefused) {
  EXPECT_EQ(run("cost --op exp3_quaternion --adapter 'python3 " LIECHECK_BAD_PYTHON "'"), 2);
  EXPECT_NE(text("err").find("is a command that does not time itself"), std::string::npos) << text("err");
}

TEST_F(AdapterCost, EndsWithAnErrorIfTheLibraryEndsTheProcess) {
  const std::string cost =
      "cost --op exp3_quaternion --scalar double --for 1s --json r.json --adapter " LIECHECK_BAD_CITIZENS;
  for (const auto& [way, words] : {std::pair("segfault", "signal 11"), {"exit", "ended before it wrote"}}) {
    EXPECT_EQ(run(cost, way), 2) << way;
    EXPECT_NE(text("err").find(words), std::string::npos) << text("err");
  }
  EXPECT_EQ(run(cost, "stdio"), 0) << text("err");  // what it prints is not read as a time
}

TEST_F(AdapterCost, IsLeftOutOfAReportIfItCannotBeMeasured) {
  ASSERT_EQ(run("report --cases 60 --out page --adapter " LIECHECK_BAD_CITIZENS, "segfault"), 0)
      << text("err");
  EXPECT_NE(text("err").find("the report has no times: a process that measures was ended by signal 11"),
            std::string::npos)
      << text("err");
  const auto record = nlohmann::json::parse(text("page/campaign.json"));
  EXPECT_EQ(record["verdict"], "fail");
  EXPECT_FALSE(record.contains("cost"));
  EXPECT_GT(std::filesystem::file_size(folder_ / "page/report.html"), 100000u);
}

TEST(DirectFunction, TakesArgumentsInTheOrderThatTheAdapterStates) {
  const conventions::Statements stated{{"quaternion", "wxyz"}, {"quaternion sense", "passive"}};
  EXPECT_EQ(conventions::given(op::normalize, stated, {1, 2, 3, 4}, false),
            (std::vector<double>{4, -1, -2, -3}));
}

}  // namespace
}  // namespace liecheck::properties

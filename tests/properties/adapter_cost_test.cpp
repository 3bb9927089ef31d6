// Times of adapters: `cost --adapter` and `report --adapter`.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <support/files.hpp>
#include <timing/rows.hpp>

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

TEST_F(AdapterCost, OfACommandIsRefused) {
  EXPECT_EQ(run("cost --op exp6 --adapter 'python3 adapter.py'"), 2);
  EXPECT_NE(text("err").find("'python3 adapter.py' is a command"), std::string::npos) << text("err");
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

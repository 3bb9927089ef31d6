// A campaign prepares only what its selected subjects need: nobody else's URDF reader runs.

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

#include "../campaigns.hpp"
#include "../own_subject.hpp"

namespace liecheck::properties {
namespace {

std::atomic<int> reads{0}, refusals{0};

TypedSubject<double> reader(const std::string& name, decltype(TypedOperations<double>::robot) robot) {
  TypedSubject<double> s{name, "counts", {}};
  s.operations.robot = robot;
  return s;
}

const Registered<double> counting(reader("reads:counted", [](const std::string& urdf, bool fixed) {
  ++reads;
  return own_subject().operations.robot(urdf, fixed);
}));
const Registered<double> refusing(reader("reads:refused",
                                         [](const std::string&, bool) -> RobotOperations<double> {
                                           ++refusals;
                                           throw std::runtime_error("this reader refuses every robot");
                                         }));

CampaignResult run(std::vector<std::string> subjects, unsigned jobs = 1) {
  return run_quietly({std::move(subjects), {"robot_configuration"}, {}}, 70, jobs);
}

TEST(UrdfReaders, RunOnlyIfTheirSubjectIsSelected) {
  reads = 0, refusals = 0;
  EXPECT_FALSE(run({"liecheck"}).failed);
  EXPECT_EQ(reads, 0);
  select({}, built_in_robot());  // as `liecheck list` does
  select({{"reads:counted"}, {}, {}}, built_in_robot());
  EXPECT_EQ(reads, 0);
  EXPECT_FALSE(run({"liecheck", "reads:counted"}).failed);
  EXPECT_EQ(reads, 1);  // also for the calls that are checked
  EXPECT_FALSE(run({"reads:counted"}, 2).failed);
  EXPECT_EQ(reads, 2);
  EXPECT_EQ(refusals, 0);
}

TEST(UrdfReaders, ThatThrowAreRefusalsOfTheirSubjectAloneAndRunOnce) {
  refusals = 0;
  const CampaignResult r = run({"liecheck", "reads:refused"});
  EXPECT_TRUE(r.failed);
  EXPECT_EQ(refusals, 1);
  for (const SeriesResult& s : r.series)
    for (const auto& [cell, row] : s.tally.rows)
      EXPECT_EQ(row.refused, s.series->subject == "reads:refused" ? 70U : 0U) << s.series->subject;
}

}  // namespace
}  // namespace liecheck::properties

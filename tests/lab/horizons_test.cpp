// Long horizons: drifts that are planted are found, and a path that is interrupted goes on with the same bits.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <horizons/scene_horizons.hpp>
#include <nlohmann/json.hpp>
#include <random>
#include <support/checksum.hpp>
#include <support/file_lock.hpp>
#include <support/files.hpp>
#include <support/json.hpp>
#include <support/stop.hpp>

#include "../own_subject.hpp"
#include "../refusal.hpp"
#include "../scratch.hpp"

namespace liecheck::properties {
namespace {

using O = TypedOperations<double>;

const O& good() {
  return own_subject().operations;
}

/// integrate with an error of 2^-40 in the angle of each call, always to the same side; with a norm that grows; and with
/// NaN from some rotation on.
const Registered<double> wrong[] = {
    registered("horizon:drifts", op::integrate,
               [](const O::V7& q, const O::V6& d) -> O::V7 {
                 O::V6 more = d;
                 more.tail<3>() *= 1 + 0x1p-40;
                 return good()[op::integrate](q, more);
               }),
    registered("horizon:grows", op::integrate,
               [](const O::V7& q, const O::V6& d) -> O::V7 {
                 O::V7 next = good()[op::integrate](q, d);
                 next.tail<4>() *= q.tail<4>().norm() * (1 + 0x1p-50);
                 return next;
               }),
    registered("horizon:nan", op::integrate, [](const O::V7& q, const O::V6& d) -> O::V7 {
      O::V7 next = good()[op::integrate](q, d);
      if (std::fabs(q[3]) > 0.3) next[6] = std::nan("");
      return next;
    })};

Horizon one(HorizonOptions o, const std::string& subject, const std::string& walk) {
  o.subjects = {subject}, o.scalars = {"double"}, o.walks = {walk};
  Horizon found;
  EXPECT_TRUE(measure_horizons(o, [&](const Horizon& h) { found = h; }));
  return found;
}

TEST(Horizons, ASystematicErrorGrowsWithTheNumberOfCallsAndARandomOneWithItsRoot) {
  HorizonOptions o;
  o.steps = 100'000, o.paths = 2;
  const Horizon bad = one(o, "horizon:drifts", "pure");
  EXPECT_NEAR(bad.exponent, 1, 0.02);
  // 2^-40 of 1e-3 rad in each call, in eps of 2^-52
  EXPECT_NEAR(bad.points.back().attitude, 4.096 * static_cast<double>(bad.points.back().n), 0.01 * 4.1e5);
  const Horizon ours = one(o, "liecheck", "random");
  EXPECT_LT(ours.low, 0.5);
  EXPECT_LT(ours.points.back().attitude, std::sqrt(1e5));
  EXPECT_GT(ours.points.back().attitude, 0);
  EXPECT_LE(ours.points.back().norm, 4);
}

TEST(Horizons, ANormThatGrowsIsMeasured) {
  HorizonOptions o;
  o.steps = 6400, o.paths = 1;
  const Horizon bad = one(o, "horizon:grows", "random");
  // Each call adds 8 eps to |Q|^2 - 1, and its rounding of the norm changes that by up to 2 eps.
  const double expected = 8.0 * static_cast<double>(bad.points.back().n);
  EXPECT_GT(expected, 8 * 6000);
  EXPECT_NEAR(bad.points.back().norm, expected, 0.25 * expected);
}

TEST(Horizons, ANotFiniteResultIsNotForgotten) {
  HorizonOptions o;
  o.steps = 6400, o.paths = 2;
  const Horizon bad = one(o, "horizon:nan", "random");
  EXPECT_TRUE(std::isnan(bad.points.back().norm));
  EXPECT_TRUE(std::isnan(bad.points.back().attitude));
}

TEST(Horizons, AStateThatDoesNotFitIsRefusedByItsName) {
  HorizonOptions o;
  o.steps = 6400, o.paths = 1, o.scalars = {"double"}, o.walks = {"random"};
  o.state = (std::filesystem::path(liecheck::scratch()) / "tampered.json").string();
  const auto run = [&] { return measure_horizons(o, [](const Horizon&) {}); };
  std::filesystem::remove(o.state);
  ASSERT_TRUE(run());
  const auto whole = nlohmann::json::parse(read_whole(o.state));
  const std::string path = "liecheck double random 0";
  ASSERT_TRUE(whole.at("parts").contains(path));
  bool sealed = false;
  const auto refusal = [&](const std::function<void(nlohmann::json&)>& change) -> std::string {
    nlohmann::json changed = whole;
    change(changed);
    if (changed.contains("parts") && sealed) changed["checksum"] = checksum(dumped(changed["parts"]));
    write_whole(o.state, changed.dump());
    return test::refusal([&] { run(); });
  };
  EXPECT_EQ(refusal([](auto&) {}), "");
  const std::string name = o.state + ": ", its = name + "'" + path + "': ";
  EXPECT_EQ(refusal([](auto& j) { j["options"] = "x"; }).substr(0, name.size()), name);
  EXPECT_EQ(refusal([](auto& j) { j.erase("parts"); }).substr(0, name.size()), name);
  EXPECT_EQ(refusal([&](auto& j) { j["parts"][path]["norm"] = 0; }),
            name + "was changed since it was written: its checksum is another one");
  sealed = true;
  for (const char* member : {"n", "norm", "longest", "numbers", "truth", "errors"}) {
    EXPECT_EQ(refusal([&](auto& j) { j["parts"][path].erase(member); }).substr(0, its.size()), its) << member;
    EXPECT_EQ(refusal([&](auto& j) { j["parts"][path][member] = "x"; }).substr(0, its.size()), its) << member;
  }
  for (const double n : {-1.0, 1030.0, 3.7, 1e300, 0x1p62})
    EXPECT_EQ(refusal([&](auto& j) { j["parts"][path]["n"] = n; }).substr(0, its.size()), its) << n;
  for (const std::uint64_t n : {64u, 1030u, 12800u})
    EXPECT_EQ(refusal([&](auto& j) { j["parts"][path]["n"] = n; }).substr(0, its.size()), its) << n;
  const FileLock other(o.state);
  EXPECT_NE(refusal([](auto&) {}).find("another program"), std::string::npos);
}

TEST(Horizons, APathThatIsInterruptedGoesOnWithTheSameBits) {
  HorizonOptions o;
  o.steps = 20'000, o.paths = 1;
  const Horizon whole = one(o, "liecheck", "random");
  o.state = (std::filesystem::path(liecheck::scratch()) / "horizon_state.json").string();
  std::filesystem::remove(o.state);
  o.subjects = {"liecheck"}, o.scalars = {"double"}, o.walks = {"pure", "random"};
  EXPECT_FALSE(measure_horizons(o, [](const Horizon&) { stop_requested = true; }));
  stop_requested = false;
  std::vector<Horizon> all;
  EXPECT_TRUE(measure_horizons(o, [&](const Horizon& h) { all.push_back(h); }));
  ASSERT_EQ(all.size(), 2u);
  ASSERT_EQ(all[1].points.size(), whole.points.size());
  for (std::size_t i = 0; i < whole.points.size(); ++i)
    EXPECT_EQ(all[1].points[i].attitude, whole.points[i].attitude) << i;
  o.steps = 30'000;
  EXPECT_THROW(measure_horizons(o, [](const Horizon&) {}), std::invalid_argument);
}

TEST(Horizons, ScenesStayNearTheirClosedForms) {
  HorizonOptions o;
  o.steps = 6400;  // 100 s
  std::vector<std::string> names;
  EXPECT_TRUE(measure_scene_horizons(o, [&](const Horizon& h) {
    names.push_back(h.walk);
    EXPECT_GE(h.points.back().n, 6400u) << h.walk;
    EXPECT_LT(h.points.back().attitude, 1e4) << h.walk;
    EXPECT_GT(h.points[1].attitude, 0) << h.walk;
    EXPECT_LE(h.points.back().norm, 4) << h.walk;
  }));
  EXPECT_EQ(names, (std::vector<std::string>{"scene triaxial", "scene axisymmetric", "scene thrown",
                                             "scene pendulum", "scene spring", "scene top"}));
  o.scalars = {"float"};
  EXPECT_TRUE(measure_scene_horizons(o, [](const Horizon& h) { ADD_FAILURE() << h.walk; }));
}

TEST(Horizons, TheIntervalOfAGrowthContainsIt) {
  Horizon h;
  for (std::uint64_t n = 1000; n <= 1'000'000'000; n *= 10)
    h.points.push_back({n, 0, std::sqrt(static_cast<double>(n)) * (n % 7 == 1 ? 1.2 : 0.9)});
  fit_growth(h, 4);
  EXPECT_LT(h.low, 0.5);
  EXPECT_GT(h.high, 0.5);
  EXPECT_LT(h.high - h.low, 0.2);
}

// Of 200 random walks, about 5 % lie outside.
TEST(Horizons, TheIntervalOfAGrowthHoldsFor95PercentOfRandomWalks) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  int outside = 0;
  for (int walk = 0; walk < 200; ++walk) {
    Horizon h;
    double angle[3] = {}, before = 0;
    for (std::uint64_t n = 1024; n <= 1'000'000; n *= 4) {
      for (double& a : angle) a += std::sqrt(static_cast<double>(n) - before) * normal(random);
      before = static_cast<double>(n);
      h.points.push_back({n, 0, std::hypot(angle[0], angle[1], angle[2])});
    }
    fit_growth(h, 1);
    outside += h.low > 0.5 || h.high < 0.5;
  }
  EXPECT_GE(outside, 2);
  EXPECT_LE(outside, 20);
}

}  // namespace
}  // namespace liecheck::properties

// What the report says of simulated scenes.

#include <gtest/gtest.h>

#include <reports/field.hpp>
#include <reports/scenes.hpp>

namespace {

using namespace liecheck::reports;

Json point(double error, Json time = nullptr) {
  const Json drift = {{"slope", -2e-9}, {"oscillation", 3e-8}};
  return {{"steps", 16u},        {"tolerance", nullptr},      {"attitude", error},
          {"position", nullptr}, {"angular_velocity", error}, {"linear_velocity", nullptr},
          {"energy", drift},     {"momentum", nullptr},       {"time_ns", time},
          {"diverged", ""}};
}

Json scenes() {
  const Json time = {{"median", 100}, {"low", 90}, {"high", 110}, {"repetitions", 7u}};
  const Json series = {{"subject", "liecheck"}, {"version", "1"},
                       {"integrator", "rkmk4"}, {"order", 4u},
                       {"adaptive", false},     {"smallest", 2e-15},
                       {"at_floor", true},      {"points", Json::array({point(1e-2), point(5e-4, time)})}};
  const Json order = {
      {"integrator", "rkmk4"}, {"scalar", "float128"}, {"promised", 4u},         {"exact", false},
      {"observed", 4.003},     {"halvings", 5u},       {"settled", true},        {"first", 0u},
      {"floor", nullptr},      {"steps", {16u, 32u}},  {"errors", {1e-2, "inf"}}};
  const Json scene = {{"scene", "a<b>"},
                      {"what", "swings"},
                      {"duration", 4},
                      {"truth", "pendulum"},
                      {"closed", true},
                      {"disagreement", 0},
                      {"series", Json::array({series})},
                      {"orders", Json::array({order})}};
  const Json pose = {0, 0, -1, 0, 0, 0, 1};
  const Json link = {{"name", "body"},
                     {"centre", {0, 0, -1}},
                     {"half", {1, 1, 1}},
                     {"axes", {1, 0, 0, 0, 1, 0, 0, 0, 1}},
                     {"joints", Json::array()}};
  return {{"version", "0.1.0"},
          {"verdict", "pass"},
          {"elapsed", 20},
          {"wrong_orders", Json::array()},
          {"absent", {"DART"}},
          {"scenes", Json::array({scene})},
          {"peers", Json::array({{{"scene", "a<b>"},
                                  {"peer", "MuJoCo"},
                                  {"integrator", "RK4"},
                                  {"points", 3u},
                                  {"ratio", 0.25},
                                  {"error", 1e-6},
                                  {"ours", "rkmk4"},
                                  {"unmatched", false}}})},
          {"spins", Json::array({{{"integrator", "gauss12"},
                                  {"order", 12u},
                                  {"turns", 1000u},
                                  {"steps_per_turn", 24u},
                                  {"error", 7e-12},
                                  {"limit", 1.4e-12},
                                  {"seconds", 0.5}}})},
          {"flips", Json::array({{{"perturbation", 1e-8},
                                  {"scalar", "double"},
                                  {"integrator", "gauss12"},
                                  {"exact", {34.8, 102.2}},
                                  {"relative", {5e-17, "inf"}},
                                  {"predicted", 1u},
                                  {"horizon", 34.8}}})},
          {"costs", Json::array({{{"scene", "s"},
                                  {"stage", "gravity"},
                                  {"equation", "g"},
                                  {"energy", "conserves"},
                                  {"when", "evaluation"},
                                  {"why", "asked"},
                                  {"nanoseconds", 3.5}}})},
          {"films", Json::array({{{"name", "n"},
                                  {"what", "w"},
                                  {"integrator", "rkmk4"},
                                  {"interval", 0.02},
                                  {"ground", nullptr},
                                  {"links", Json::array({link})},
                                  {"frames", Json::array({Json::array({pose})})}}})}};
}

std::string complaint(const Json& s) {
  const std::string file = "r.json";
  try {
    check_scenes(Field(file, "scenes", s));
    return "";
  } catch (const std::runtime_error& e) {
    return e.what();
  }
}

TEST(ScenesReport, ShowsOrderFloorSpinFlipsPeersAndCosts) {
  ASSERT_EQ(complaint(scenes()), "");
  Merged merged;
  merged.records.push_back({{"scenes", scenes()}});
  const std::string page = scenes_section(merged);
  for (const char* text : {"4.003 over 5, float128; floor 2e-15", "5.00", "5e-17, lost", "34.8 s", "0.250",
                           "3.5 ns", "absent from this build", "data-films=\"[0]\"", "a&lt;b&gt;", "-2e-09"})
    EXPECT_NE(page.find(text), std::string::npos) << text;
  EXPECT_EQ(page.find("a<b>"), std::string::npos);
  EXPECT_NE(scenes_section({}).find("hold no scenes"), std::string::npos);
}

TEST(ScenesReport, RefusesARecordThatIsNotOne) {
  Json s = scenes();
  s["films"][0]["frames"][0].push_back(s["films"][0]["frames"][0][0]);
  EXPECT_NE(complaint(s).find("scenes.films[0].frames[0]: expected 1 entries"), std::string::npos)
      << complaint(s);
  s = scenes();
  s["scenes"][0]["orders"][0]["observed"] = "four";
  EXPECT_NE(complaint(s).find("orders[0].observed"), std::string::npos);
  s = scenes();
  s["spins"][0].erase("limit");
  EXPECT_NE(complaint(s).find("limit is missing"), std::string::npos);
}

}  // namespace

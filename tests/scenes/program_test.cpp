// The command `liecheck scene sweep`.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "../shell.hpp"

namespace {

liecheck::Answer run(const std::string& arguments) {
  return liecheck::shell(LIECHECK_PROGRAM " " + arguments);
}

TEST(SceneSweepProgram, RefusesBadArgumentsWithOneLine) {
  for (const auto& [arguments, says] :
       {std::pair<std::string, std::string>{"scene sweep --integrator rkmk5", "rkmk5"},
        {"scene sweep --steps 10", "--steps 10"},
        {"scene sweep --steps 0", "--steps"},
        {"scene sweep --steps -4", "--steps"},
        {"scene sweep no_such_scene.yaml", "no_such_scene.yaml"},
        {"scene sweep --json /no/such/folder/x.json --no-times", "/no/such/folder"}}) {
    const auto r = run(arguments);
    EXPECT_EQ(r.code, 2) << arguments << "\n" << r.text;
    EXPECT_NE(r.text.find(says), std::string::npos) << r.text;
    EXPECT_EQ(std::count(r.text.begin(), r.text.end(), '\n'), 1) << r.text;
  }
}

TEST(SceneSweepProgram, SweepsASceneFileAndWritesItsRecord) {
  const auto path = std::filesystem::temp_directory_path() / "liecheck_scene_sweep_test.json";
  const auto r =
      run("scene sweep " LIECHECK_FIXTURES
          "/scenes/damped_spring.yaml --integrator rk2 --integrator rkmk4 --no-peers --for 1s --json " +
          path.string());
  EXPECT_EQ(r.code, 0) << r.text;
  std::ifstream file(path);
  const auto record = nlohmann::json::parse(file);
  const auto& scene = record["scenes"][0];
  EXPECT_EQ(scene["truth"], "damped spring");
  ASSERT_EQ(scene["series"].size(), 2U);
  ASSERT_EQ(scene["orders"].size(), 2U);
  EXPECT_NEAR(scene["orders"][0]["observed"].get<double>(), 2, 0.1);
  EXPECT_NEAR(scene["orders"][1]["observed"].get<double>(), 4, 0.1);
  EXPECT_LT(scene["series"][1]["smallest"].get<double>(), 1e-3);  // it depends on the machine
  EXPECT_FALSE(scene["series"][1]["points"][0]["time_ns"].is_null());
  std::filesystem::remove(path);
}

}  // namespace

// scene/effects/curve.hpp and its users: forces and targets from tables and CSV files. References are closed forms.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "recorded.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;

/// A mass of 2 kg on a rail along x.
const std::string rail = "robot: {body: ball, mass: 2, radius: 0.1, root: prismatic, axis: [1, 0, 0]}\n";
const std::string end = "integrator: {name: gauss6, step: 0.1 s}\nduration: 2 s\nobservers: [state]\n";

scene::Value rows(const std::vector<double>& times, double (*x)(double)) {
  scene::Value table{{}, {}, 2};
  for (const double t : times) table.numbers.push_back(t), table.numbers.push_back(x(t));
  return table;
}

TEST(Curve, OfACubicTableIsExactForParabolasAndContinuousInItsRate) {
  const std::vector<double> times{0, 0.5, 0.7, 1.5, 2};
  const auto parabola = [](double t) { return 3 * t * t - t + 2; };
  const scene::Curve<double> curve(rows(times, parabola), true);
  for (const double t : {0.1, 0.5, 0.6, 1.0, 1.9}) {
    const auto p = curve.at(t, t, 0);
    EXPECT_NEAR(p.x, parabola(t), 1e-14);
    EXPECT_NEAR(p.rate, 6 * t - 1, 1e-13);
  }
  const scene::Curve<double> wave(rows(times, [](double t) { return std::sin(3 * t); }), true);
  for (const double t : {0.5, 0.7, 1.5}) {
    const auto before = wave.at(t, t - 0.1, 0), after = wave.at(t, t, 0);
    EXPECT_NEAR(before.x, after.x, 1e-15);
    EXPECT_NEAR(before.rate, after.rate, 1e-14);
    const double e = 1e-6;  // the rate is that of x
    EXPECT_NEAR((wave.at(t + e, t + e, 0).x - after.x) / e, after.rate, 1e-4);
  }
  EXPECT_EQ(curve.at(5, 5, 0).x, 12);
  EXPECT_EQ(curve.at(5, 5, 0).rate, 0);
  EXPECT_EQ(curve.at(-1, -1, 0).x, 2);
}

TEST(Curve, OfALinearTableIsALineBetweenRowsOfSeveralNumbers) {
  const scene::Curve<double> curve({{0, 1, 10, 2, 3, 20}, {}, 3}, false);
  EXPECT_EQ(curve.width(), 2u);
  EXPECT_EQ(curve.at(0.5, 0.5, 0).x, 1.5);
  EXPECT_EQ(curve.at(0.5, 0.5, 1).x, 12.5);
  EXPECT_EQ(curve.at(0.5, 0.5, 1).rate, 5);
}

TEST(ForceTable, WithTwoRowsAtOneTimeJumpsThere) {
  const Recorded run(
      rail + "actuation: [table: {rows: [[0, 3], [0.55, 3], [0.55, -1], [1.5, -1], [1.5, 0]]}]\n" + end);
  EXPECT_NEAR(run["v.root_joint"].back(), (0.55 * 3 - 0.95) / 2, 1e-14);
  EXPECT_NEAR(run["q.root_joint"].back(),
              (3 * 0.55 * 0.55 / 2 + 3 * 0.55 * 1.45 - 0.95 * 0.95 / 2 - 0.95 * 0.5) / 2, 1e-14);
}

TEST(Samples, ShowTheForcesJustBeforeThem) {
  const std::string force = "effects: [wrench: {frame: body, force: [4, 0, 0], from: 1 s, until: 2 s}]\n";
  const std::vector<double> a = Recorded(rail + force + end)["a.root_joint"];
  ASSERT_EQ(a.size(), 21u);
  for (std::size_t i = 0; i <= 20; ++i) EXPECT_EQ(a[i], i > 10 ? 2 : 0) << i;
  // A trajectory that ends with the run keeps its rate until then.
  const Recorded pd(rail +
                    "initial: {joint_velocities: {root_joint: 0.5}}\nactuation: [pd: {stiffness: 50, "
                    "damping: 20, rows: [[0 s, 0], [1, 0.5], [2, 1]], interpolation: cubic}]\n" +
                    end);
  EXPECT_NEAR(pd["a.root_joint"].back(), 0, 1e-13);
}

TEST(PdTarget, MayBeOneNumber) {
  const auto last = [](const std::string& target) {
    return Recorded(rail + "actuation: [pd: {stiffness: 50, damping: 20, target: " + target + "}]\n" +
                    end)["q.root_joint"]
        .back();
  };
  EXPECT_EQ(last("30 cm"), last("[0.3]"));
  EXPECT_GT(last("30 cm"), 0.2);
}

class Csv : public testing::Test {
 protected:
  static inline const std::string name = "liecheck_tables_test.csv", file = testing::TempDir() + name;
  static void write(const std::string& text) { std::ofstream(file) << text; }
  static void TearDownTestSuite() { std::filesystem::remove(file); }
  static std::string textOf(const std::string& keys) {
    return rail + "actuation:\n  - pd: {stiffness: 1, damping: 1, rows: {file: " + name + keys + "}}\n" + end;
  }
  static std::vector<double> numbers(const std::string& keys) {
    return loadSceneText(textOf(keys), "s.yaml", testing::TempDir()).effects.at(0).parameters.numbers("rows");
  }
  static std::string refusal(const std::string& keys = "") { return test::refusal(textOf(keys)); }
};

TEST_F(Csv, IsReadByNamesOrNumbersOfColumnsInTheirUnits) {
  write("t [ms],\"q.hip [rad]\",knee [mrad]\r\n0,1,2000\n\n500,3,4000\n");
  const std::vector<double> hip{0, 1, 0.5, 3}, knee{0, 2, 0.5, 4};
  EXPECT_EQ(numbers(", columns: q.hip"), hip);
  EXPECT_EQ(numbers(", columns: 3"), knee);
  EXPECT_EQ(numbers(", columns: [3], time: t"), knee);
  EXPECT_EQ(refusal(", columns: [q.hip, knee]"), "s.yaml:3: pd has 2 targets for 1 coordinates");
}

TEST_F(Csv, WithoutNamesHasNumberedColumns) {
  write("0, 1 mm\n1 s, 2 mm\n");
  EXPECT_EQ(numbers(""), (std::vector<double>{0, 1e-3, 1, 2e-3}));
}

TEST_F(Csv, IsRefusedWithFileLineAndValue) {
  const auto expect = [](const std::string& got, const std::string& part) {
    EXPECT_TRUE(has(got, "s.yaml:3: pd.rows: "));
    EXPECT_TRUE(has(got, part));
  };
  write("t,x\n0,1\n1,oops\n");
  expect(refusal(), name + ":3: column 'x': 'oops' is not a number");
  write("t,x\n1,1\n0,2\n");
  expect(refusal(), name + ":3: the time '0' is before the time before it");
  write("t,x\n0,1\n1,2,3\n");
  expect(refusal(), name + ":3: has 3 columns, and the first line has 2");
  write("t,x\n0,1\n1,nan\n");
  expect(refusal(), "'nan' is not finite");
  write("t,hip\n0,1\n");
  expect(refusal(", columns: hop"), "has no column 'hop'");
  write("t,x\n");
  expect(refusal(), "has no row of numbers");
  write("t\n0\n");
  expect(refusal(), "has no column besides the time");
  std::filesystem::remove(file);
  expect(refusal(), "cannot be opened");
}

TEST(Tables, AreRefusedInOneLine) {
  const auto refusal = [](const std::string& part) {
    return test::refusal(rail + "actuation:\n  - " + part + "\n" + end);
  };
  const std::string pd = "pd: {stiffness: 1, damping: 1, ";
  EXPECT_TRUE(has(refusal(pd + "rows: [[1, 1], [0, 2]]}"), "rows[1] is before"));
  EXPECT_TRUE(
      has(refusal(pd + "rows: [[0, 1], [0, 2]], interpolation: cubic}"), "has no cubic interpolation"));
  EXPECT_TRUE(has(refusal(pd + "rows: [[0, 1], [1]]}"), "rows[1] is a time and 1 numbers"));
  EXPECT_TRUE(has(refusal(pd + "rows: 3}"), "is a list of rows"));
  EXPECT_TRUE(has(refusal(pd + "rows: [[0, 1]], target: [1]}"), "keep one"));
  EXPECT_TRUE(has(refusal(pd + "rows: [[0, 1, 2]]}"), "2 targets for 1 coordinates"));
  EXPECT_TRUE(has(refusal("table: {times: [0, 1]}"), "needs 'rows', or 'times' and 'forces'"));
  EXPECT_THROW(
      Recorded("robot: {body: ball, radius: 1}\neffects: [wrench: {frame: body, rows: [[0, 1], [1, 1]]}]\n" +
               end),
      SceneError);
  EXPECT_TRUE(has(refusal("table: {rows: [[0, 1]], times: [0], forces: [1]}"), "needs 'rows', or"));
}

}  // namespace

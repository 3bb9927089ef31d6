// scene/observers/imu.hpp: its readings in a motion computed by hand, and the statistics of its noise.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "contact_run.hpp"

namespace {

using namespace liecheck;
using test::column;
namespace sc = liecheck::scene;

sc::Run watched(const std::string& imu, const std::string& motion, const std::string& duration) {
  return sc::run(loadSceneText("robot: {body: box, size: [0.3, 0.1, 0.2], centre: [0.1, -0.2, 0.05]}\n" +
                                   motion + "integrator: {name: rkmk4, step: 10 ms}\nduration: " + duration +
                                   "\nobservers: [imu: {frame: body" + imu + "}]\noutput: {every: 10 ms}\n",
                               "s.yaml", "."));
}

/// A box in free fall spins about its z axis, and the origin of its frame circles its centre of mass c. The
/// specific force at the origin is omega^2 c in the x-y plane and 0 along z. Gravity is not measured.
TEST(Imu, ReadsTheSpecificForceAtItsFrameOriginPlusItsBiases) {
  const double w = 3;
  const sc::Run run = watched(", gyro_bias: [0.01, 0.02, 0.03], accel_bias: [1, 2, 3]",
                              "initial: {velocity: [1, 2, 3], angular_velocity: [0, 0, 3], attitude: [20 "
                              "deg, 10 deg, 0]}\neffects: [gravity]\n",
                              "2 s");
  const double expected[6] = {0.01, 0.02, 3.03, 1 + w * w * 0.1, 2 - w * w * 0.2, 3};
  const char* const names[6] = {"gyro_x", "gyro_y", "gyro_z", "accel_x", "accel_y", "accel_z"};
  for (int i = 0; i < 6; ++i)
    for (double x : column(run, std::string("body.") + names[i]))
      EXPECT_NEAR(x, expected[i], 1e-12)
          << names[i];  // 200 steps of rkmk4 about a principal axis: rounding errors only
}

struct Statistics {
  double mean = 0, deviation = 0, lag1 = 0;
};
Statistics of(const std::vector<double>& x) {
  Statistics s;
  for (double v : x) s.mean += v / double(x.size());
  for (double v : x) s.deviation += (v - s.mean) * (v - s.mean) / double(x.size());
  for (std::size_t i = 1; i < x.size(); ++i)
    s.lag1 += (x[i] - s.mean) * (x[i - 1] - s.mean) / double(x.size()) / s.deviation;
  s.deviation = std::sqrt(s.deviation);
  return s;
}
/// Expects white Gaussian noise with standard deviation sigma. Checks the mean, the variance, the correlation
/// with the sample before, and the share of samples beyond one and two sigma. Each may be off by five of its
/// standard deviations, which happens by chance once in a million times; the seed is fixed.
void expectWhite(const std::vector<double>& x, double sigma) {
  const Statistics s = of(x);
  const double n = double(x.size());
  EXPECT_NEAR(s.mean, 0, 5 * sigma / std::sqrt(n));
  EXPECT_NEAR(s.deviation / sigma, 1, 5 / std::sqrt(2 * n));
  EXPECT_NEAR(s.lag1, 0, 5 / std::sqrt(n));
  for (double k : {1.0, 2.0}) {
    double beyond = 0;
    for (double v : x) beyond += std::abs(v) > k * sigma;
    const double p = std::erfc(k / std::sqrt(2.0));
    EXPECT_NEAR(beyond / n, p, 5 * std::sqrt(p * (1 - p) / n)) << k;
  }
}

/// Samples of white noise of density d, taken every T = 10 ms, have the standard deviation d / sqrt(T).
TEST(Imu, NoiseIsWhiteWithTheGivenDensity) {
  const sc::Run run = watched(", gyro_noise: 0.02, accel_noise: 0.3", "", "400 s");
  for (const char* axis : {"x", "y", "z"}) {
    SCOPED_TRACE(axis);
    expectWhite(column(run, std::string("body.gyro_") + axis), 0.02 / 0.1);
    expectWhite(column(run, std::string("body.accel_") + axis), 0.3 / 0.1);
  }
  const auto x = column(run, "body.gyro_x"), y = column(run, "body.gyro_y"), a = column(run, "body.accel_x");
  for (const auto& other : {y, a}) {
    double together = 0;
    for (std::size_t i = 0; i < x.size(); ++i) together += x[i] * other[i] / double(x.size());
    EXPECT_NEAR(together / (of(x).deviation * of(other).deviation), 0, 5 / std::sqrt(double(x.size())));
  }
  EXPECT_EQ(watched(", gyro_noise: 0.02, accel_noise: 0.3", "", "1 s").rows,
            std::vector<double>(run.rows.begin(), run.rows.begin() + 101 * 7));
  EXPECT_NE(watched(", gyro_noise: 0.02, accel_noise: 0.3, seed: 43", "", "1 s").rows.at(1), run.rows.at(1));
}

/// The rate of a bias is white noise of density d. Its increments in T have the standard deviation d sqrt(T).
TEST(Imu, TheIncrementsOfABiasAreWhiteWithTheGivenDensity) {
  const sc::Run run = watched(", gyro_bias: [5, 5, 5], gyro_walk: 0.004, accel_walk: 0.05", "", "400 s");
  for (const char* axis : {"x", "y", "z"}) {
    SCOPED_TRACE(axis);
    for (const auto& [part, density, start] : {std::tuple("gyro_", 0.004, 5.0), {"accel_", 0.05, 0.0}}) {
      std::vector<double> b = column(run, std::string("body.") + part + axis);
      EXPECT_EQ(b[0], start);
      for (std::size_t i = b.size() - 1; i > 0; --i) b[i] -= b[i - 1];
      expectWhite({b.begin() + 1, b.end()}, density * 0.1);
    }
  }
}

}  // namespace

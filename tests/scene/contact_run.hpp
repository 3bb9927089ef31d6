#pragma once
// Runs of scenes with contacts.

#include <cstdio>
#include <fstream>

#include "bodies.hpp"

namespace liecheck::test {

constexpr double g = 9.81;

/// The run of a scene without an estimate. It must reach its end.
inline scene::Run runOf(const std::string& text) {
  scene::Run run = scene::run(loadSceneText(text, "scene text", testing::TempDir()));
  EXPECT_FALSE(run.outcome.diverged) << run.outcome.t << " s: " << run.outcome.why;
  return run;
}
/// All samples of a column.
inline std::vector<double> column(const scene::Run& run, const std::string& name) {
  std::vector<double> x;
  for (std::size_t k = 0; k < run.columns.size(); ++k)
    if (run.columns[k].name == name)
      for (std::size_t i = k; i < run.rows.size(); i += run.columns.size()) x.push_back(run.rows[i]);
  EXPECT_FALSE(x.empty()) << name;
  return x;
}
/// The attitude of a free body whose q begins at `at`.
inline SO3<double> attitude(const Vec& q, int at = 0) {
  return SO3<double>(Vector4<double>(q.segment<4>(at + 3)));
}
/// The velocity of the body's origin in the world.
inline V3 velocity(const scene::Run& run) {
  return attitude(run.q).act(V3(run.v.head<3>()));
}
/// The angular velocity in the world.
inline V3 spin(const scene::Run& run) {
  return attitude(run.q).act(V3(run.v.tail<3>()));
}
/// A number as a scene file has it.
inline std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}
inline std::string vector(const V3& x) {
  return "[" + number(x[0]) + ", " + number(x[1]) + ", " + number(x[2]) + "]";
}
/// Writes a file for runOf; returns its name.
inline std::string file(const std::string& name, const std::string& content) {
  std::ofstream(testing::TempDir() + "/" + name, std::ios::binary) << content;
  return name;
}
inline std::string radau(double duration, const std::string& tolerance = "1e-9", int samples = 1) {
  return "integrator: {name: radau5, tolerance: " + tolerance + "}\nduration: " + number(duration) +
         " s\noutput: {every: " + number(duration / samples) + " s}\n";
}

}  // namespace liecheck::test

#include <liecheck/scene_file/warnings.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <liecheck/algorithms/kinematics.hpp>
#include <sstream>

namespace liecheck::scene_file_detail {
namespace {

using scene::Request;
using scene::Scene;
using Warnings = std::function<void(int line, const std::string& what)>;

std::string inWords(double x) {
  std::ostringstream text;
  text.precision(3);
  text << x;
  return text.str();
}

/// Warns of each loop that is open at the start by more than the accepted error, or 1 mm or 1 mrad.
void warnOfOpenLoops(const Warnings& warn_of, const Scene& scene, const scene::Now<double>& now) {
  const auto accepted = [](double stated) { return stated > 0 ? stated : 1e-3; };
  for (const Request& r : scene.effects) {
    if (r.name != "closed_loops") continue;
    const auto& names = r.parameters.names("frames");
    std::size_t k = 0;
    for (const auto& [a, b] : scene::pairsOf(r.parameters, scene.model)) {
      const scene::Gap<double> gap(now, a, b);
      const auto warn = [&](double size, double limit, const char* unit) {
        if (size > limit)
          warn_of(r.line, "the loop of '" + names[k] + "' and '" + names[k + 1] + "' is open by " +
                              std::to_string(size) + unit +
                              " at the start: give initial joints that close it");
      };
      warn(gap.r.head<3>().norm(), accepted(scene.accepted_position), " m");
      if (r.parameters.word("type") == "weld")
        warn(gap.r.tail<3>().norm(), accepted(scene.accepted_angle), " rad");
      k += 2;
    }
  }
}

/// Warns of joints that begin beyond their limits, in one line.
void warnOfLimits(const Warnings& warn_of, int line, const Scene& scene) {
  const Model<double>& m = scene.model;
  std::string joints;
  int count = 0;
  for (std::size_t i = 1; i < m.joints.size(); ++i) {
    if (m.nqs[i] != 1 || m.nvs[i] != 1) continue;
    const double q = scene.q[m.idx_qs[i]], low = m.lowerPositionLimit[m.idx_qs[i]],
                 high = m.upperPositionLimit[m.idx_qs[i]];
    const double slack = 1e-9 * (1 + std::abs(q));
    if (!(q < low - slack || q > high + slack) || ++count > 3) continue;
    joints += (count > 1 ? ", " : "") + ("'" + m.names[i] + "' at " + inWords(q)) + ", limit " +
              inWords(q < low ? low : high);
  }
  if (count > 3) joints += " and " + std::to_string(count - 3) + " more";
  if (count > 0)
    warn_of(line, "joints begin beyond their limits: " + joints + ": give initial joints within them");
}

/// Warns of a contact that begins much deeper in the ground than the robot's weight presses it.
void warnOfDepth(const Warnings& warn_of, const Scene& scene, const scene::Now<double>& now) {
  double mass = 0;
  for (const auto& inertia : scene.model.inertias) mass += inertia.mass();
  for (const Request& r : scene.effects) {
    if (r.name != "contact") continue;
    const double stiffness = r.parameters.number("stiffness"), exponent = r.parameters.number("exponent");
    const double pressed = std::pow(9.81 * mass / stiffness, 1 / exponent);
    // The depth of one point with the potential energy of all: V = k x^(e+1)/(e+1).
    const double energy = scene::makeEffect<double>(r, scene.model, scene.around)->potential(now),
                 depth = std::pow((exponent + 1) * energy / stiffness, 1 / (exponent + 1));
    if (depth > std::max(1e-3, 10 * pressed))
      warn_of(r.line,
              "this contact begins " + inWords(depth) +
                  " m below the ground, which throws the robot up: give it a higher initial position");
  }
}

bool isZero(const Request& r, std::initializer_list<const char*> keys) {
  return std::ranges::all_of(keys, [&](const char* key) {
    return std::ranges::all_of(r.parameters.numbers(key), [](double x) { return x == 0; });
  });
}

/// Warns of effects without a coefficient, and of added mass in a current.
void warnOfCoefficients(const Warnings& warn_of, const Scene& scene) {
  for (const Request& r : scene.effects) {
    const auto none = [&](const char* give) {
      warn_of(r.line, "this " + r.name + " has no coefficient, so that it has no effect: give " + give);
    };
    if (r.name == "drag" && isZero(r, {"linear", "quadratic", "angular_linear", "angular_quadratic"}))
      none("'linear' or 'quadratic', or their angular ones");
    if (r.name == "wrench" && !r.parameters.has("rows") && isZero(r, {"force", "moment"}))
      none("'force', 'moment' or 'rows'");
    if (r.name != "added_mass") continue;
    if (isZero(r, {"masses", "inertias"})) none("'masses' or 'inertias'");
    for (const Request& other : scene.effects)
      if (other.name == "drag" && !isZero(other, {"current"}))
        warn_of(r.line, "added_mass is that of a fluid at rest: in the current of the drag in line " +
                            std::to_string(other.line) + " its forces are wrong");
  }
}

}  // namespace

void addWarnings(const Text& text, const YAML::Node& root, const Scene& scene,
                 std::vector<std::string>& warnings) {
  const Warnings warn_of = [&](int line, const std::string& what) {
    warnings.push_back(text.file() + ":" + std::to_string(line) + ": " + what);
  };
  Data<double> data(scene.model);
  forwardKinematics(scene.model, data, scene.q, scene.v);
  scene::Now<double> now{};
  now.X_WJ = data.oMi(), now.V = {data.v(), now.X_WJ, false};
  warnOfOpenLoops(warn_of, scene, now);
  warnOfLimits(warn_of, Text::lineOf(root["initial"].IsDefined() ? root["initial"] : root["robot"]), scene);
  warnOfDepth(warn_of, scene, now);
  warnOfCoefficients(warn_of, scene);
}

}  // namespace liecheck::scene_file_detail

// random_scenes SEED FIRST END judges the estimates of `scene run` on random scenes: bodies that drop, slide, tumble and
// collide, chains with limits, friction and motors, all methods, steps from 0.2 to 20 ms. The truth of each scene is a run
// with much shorter steps that a run by another method confirms; scenes without such a truth are counted as unresolved.
// Prints a line for each scene, and at the end the counts by method and by effect, and the worst scenes. Exit code 1 if the
// shares below are missed. `random_scenes show SEED INDEX` prints a scene, `random_scenes judge FILE` judges a file.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <liecheck/scene/run.hpp>
#include <liecheck/scene_file/scene_file.hpp>
#include <map>
#include <numeric>
#include <random>
#include <sstream>

namespace {

using namespace liecheck;
namespace fs = std::filesystem;

/// Choices from one seed, the same on every machine.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : bits_(seed) {}
  double unit() { return double(bits_() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  double log(double low, double high) { return low * std::pow(high / low, unit()); }
  int below(int n) { return int(unit() * n); }
  bool chance(double p) { return unit() < p; }

 private:
  std::mt19937_64 bits_;
};

template <class... Numbers>
std::string text(const char* format, Numbers... numbers) {
  char line[600];
  std::snprintf(line, sizeof line, format, numbers...);
  return line;
}
std::string vector(Dice& dice, double size) {
  const double x = dice.between(-size, size), y = dice.between(-size, size), z = dice.between(-size, size);
  return text("[%.3g, %.3g, %.3g]", x, y, z);
}

/// A chain of n hinges about x and y in turn, with limits of one radian and efforts of 2 N m.
void writeChain(const fs::path& folder, int n) {
  std::ofstream out(folder / text("chain%d.urdf", n));
  out << "<robot name=\"chain\">\n";
  for (int k = 0; k <= n; ++k)
    out << "<link name=\"bar" << k << "\"><inertial><origin xyz=\"0 0 -0.15\"/><mass value=\"" << 1 - 0.1 * k
        << "\"/><inertia ixx=\"0.0076\" ixy=\"0\" ixz=\"0\" iyy=\"0.0076\" iyz=\"0\" "
           "izz=\"0.0008\"/></inertial></link>\n";
  for (int k = 1; k <= n; ++k)
    out << "<joint name=\"hinge" << k << "\" type=\"revolute\"><parent link=\"bar" << k - 1
        << "\"/><child link=\"bar" << k << "\"/><origin xyz=\"0 0 " << (k == 1 ? 0 : -0.3)
        << "\"/><axis xyz=\"" << (k % 2 ? "1 0 0" : "0 1 0")
        << "\"/><limit lower=\"-1\" upper=\"1\" effort=\"2\" velocity=\"100\"/></joint>\n";
  out << "</robot>\n";
}

/// A scene as text, with the names of its effects. `integrator` is the whole line.
class Drawn {
 public:
  std::string integrator, text_before, method;
  std::vector<std::string> effects;
  double h = 0;
  long steps = 0;

  Drawn(std::uint64_t seed, long index) : dice(seed * 1000003 + std::uint64_t(index)) {
    static const char* const methods[] = {"euler",
                                          "semi_implicit_euler",
                                          "rk2",
                                          "implicit_midpoint",
                                          "quaternion_rk4",
                                          "rkmk4",
                                          "rkmk4",
                                          "cf4",
                                          "dopri5",
                                          "radau5",
                                          "rkmk6",
                                          "rkmk6",
                                          "gauss6",
                                          "gauss12"};
    method = methods[dice.below(14)];
    h = std::stod(text("%.2g", dice.log(2e-4, 2e-2)));
    steps = std::max(20L, std::lround(std::min(dice.log(0.1, 2), 400 * h) / h));
    duration = h * double(steps);
    const int kind = dice.below(10);
    kind < 5 ? body() : kind < 7 ? bodies() : chain();
    if (dice.chance(0.4))
      text_before +=
          text("accuracy: {position: %.2g, angle: %.2g}\n", dice.log(1e-5, 1e-2), dice.log(1e-5, 1e-2));
    if (methodInfo().adaptive)
      integrator = text("{name: %s, tolerance: %.1g}", method.c_str(), dice.log(1e-10, 1e-4));
    else
      integrator = text("{name: %s, step: %.12g}", method.c_str(), h);
  }
  scene::MethodInfo methodInfo() const { return scene::methodInfo(method); }
  /// The scene with an integrator whose steps divide those of the samples.
  std::string with(const std::string& chosen) const {
    return text_before + "integrator: " + chosen +
           text("\nduration: %.15g\nobservers: [state]\noutput: {every: %.15g}\n", duration,
                h * double(every()));
  }
  std::string whole() const { return with(integrator); }
  long every() const {
    long best = steps;
    for (long d = 1; d <= steps; ++d)
      if (steps % d == 0 && steps / d <= 40) return d;
    return best;
  }

 private:
  void add(const std::string& name, const std::string& keys = "") {
    effects.push_back(name);
    text_before += "  - " + name + (keys.empty() ? "" : ": {" + keys + "}") + "\n";
  }
  std::string contactLaw(double mass) {
    const double rate = dice.log(40, 3000);  // of the contact's oscillation [rad/s]
    std::string law = text("stiffness: %.3g", mass * rate * rate);
    if (dice.chance(0.15)) law += text(", exponent: %.2g", dice.chance(0.5) ? 1.5 : 2.);
    if (dice.chance(0.6)) law += text(", dissipation: %.2g", dice.log(0.01, 2));
    if (dice.chance(0.5))
      law += text(", friction: %.2g", dice.between(0.1, 1)) + text(", slip: %.2g", dice.log(0.001, 0.1));
    if (dice.chance(0.1)) law += text(", rolling: %.2g", dice.log(1e-4, 1e-2));
    return law;
  }
  std::string window() {
    if (dice.chance(0.3)) return "";
    const double from = dice.between(0, duration);
    return text(", from: %.6g", from) +
           (dice.chance(0.6) ? text(", until: %.6g", from + dice.log(2e-4, 0.3)) : "");
  }
  /// Forces on a body of this frame.
  void forces(const std::string& frame, double mass) {
    if (dice.chance(0.25))
      add("drag", "frame: " + frame + text(", linear: %.2g", mass * dice.log(0.01, 3)) +
                      text(", quadratic: %.2g", mass * dice.log(0.01, 3)) +
                      (dice.chance(0.3) ? ", current: " + vector(dice, 2) : ""));
    if (dice.chance(0.25)) {
      const std::string force = vector(dice, 20 * mass), moment = vector(dice, 0.05 * mass);
      add("wrench", "frame: " + frame + ", force: " + force + ", moment: " + moment + window());
    }
    if (dice.chance(0.1))
      add("thruster", "frame: " + frame + text(", thrust: %.2g", mass * dice.between(1, 20)) + window());
    if (dice.chance(0.08))
      add("buoyancy", "frame: " + frame + text(", volume: %.2g", mass / 1000 * dice.between(0.2, 2)));
  }
  void body() {
    const double mass = std::stod(text("%.2g", dice.log(0.1, 10)));
    const int shape = dice.below(5);
    const std::string of[] = {"ball, radius: 0.1", "box, size: [0.2, 0.3, 0.1]",
                              "needle, length: 0.5, radius: 0.02", "plate, length: 0.3, width: 0.2",
                              "box, size: [0.1, 0.1, 0.4], centre: [0.01, 0, 0.05]"};
    text_before = "robot: {body: " + of[shape] + text(", mass: %.3g}\n", mass) + "ground: {height: 0}\n";
    const double height = dice.log(0.05, 0.6);
    text_before += text("initial: {position: [0, 0, %.3g], attitude: ", height + 0.1) +
                   vector(dice, dice.chance(0.3) ? 0 : 2) + ", velocity: " + vector(dice, dice.log(0.1, 3)) +
                   ", angular_velocity: " + vector(dice, dice.log(0.1, 10)) + "}\neffects:\n";
    if (dice.chance(0.9)) add("gravity");
    if (dice.chance(0.75)) add("contact", "bodies: all, " + contactLaw(mass));
    if (dice.chance(0.08))
      add("added_mass", text("masses: [%.2g, %.2g, 0.1]", mass * dice.unit(), mass * dice.unit()));
    forces("body", mass);
    if (effects.empty()) add("gravity");
  }
  void bodies() {
    text_before = "robot: {bodies: [";
    const int n = 2 + dice.below(3);
    for (int k = 0; k < n; ++k)
      text_before +=
          text("%s{name: b%d, body: ball, radius: 0.1, mass: %.2g", k ? ", " : "", k, dice.log(0.3, 3)) +
          text(", position: [%.3g, %.3g, %.3g]", 0.25 * k + dice.between(0, 0.04), dice.between(-0.1, 0.1),
               0.15 + dice.between(0, 0.4)) +
          ", velocity: " +
          text("[%.2g, %.2g, %.2g]", (k ? -1 : 1) * dice.log(0.2, 3), dice.between(-0.3, 0.3),
               dice.between(-0.3, 0.3)) +
          "}";
    text_before += "]}\nground: {height: 0}\neffects:\n";
    if (dice.chance(0.6)) add("gravity");
    add("collisions", "bodies: all, " + contactLaw(1));
    if (dice.chance(0.5)) add("contact", "bodies: all, " + contactLaw(1));
    forces("b0", 1);
  }
  void chain() {
    const int n = 1 + dice.below(4);
    const bool floating = dice.chance(0.25);
    text_before = text("robot: {urdf: chain%d.urdf, root: %s}\nground: {height: 0}\n", n,
                       floating ? "free_flyer" : "fixed");
    std::string initial = "initial: {", speeds = ", joint_velocities: {";
    if (floating) initial += "position: [0, 0, 1.5], angular_velocity: " + vector(dice, 2) + ", ";
    initial += "joints: {";
    for (int k = 1; k <= n; ++k) {
      initial += text("%shinge%d: %.3g", k > 1 ? ", " : "", k, dice.between(-0.9, 0.9));
      speeds += text("%shinge%d: %.3g", k > 1 ? ", " : "", k, dice.between(-3, 3));
    }
    text_before += initial + "}" + speeds + "}}\neffects:\n";
    if (dice.chance(0.9)) add("gravity");
    const double inertia = 0.03;
    if (dice.chance(0.6)) {
      const double rate = dice.log(30, 1500);
      add("joint_limits", text("stiffness: %.3g", inertia * rate * rate) +
                              (dice.chance(0.6) ? text(", dissipation: %.2g", dice.log(0.01, 2)) : ""));
    }
    if (dice.chance(0.4)) add("joint_damping", text("coefficient: %.2g", inertia * dice.log(0.1, 100)));
    if (dice.chance(0.3))
      add("joint_friction",
          text("force: %.2g", dice.log(0.01, 1)) + text(", slip: %.2g", dice.log(0.001, 0.1)));
    if (dice.chance(0.25)) add("joint_spring", text("stiffness: %.2g", inertia * dice.log(10, 1e5)));
    if (dice.chance(0.2)) add("armature", text("inertia: %.2g", dice.log(1e-3, 0.1)));
    if (floating && dice.chance(0.5))
      add("contact", text("frames: [bar%d], radius: 0.05, ", n) + contactLaw(1));
    forces(text("bar%d", n), 1);
    if (effects.empty()) add("gravity");
    const int drive = dice.below(6);
    if (drive < 3) text_before += "actuation:\n";
    if (drive == 0)
      add("pd", text("joints: all, stiffness: %.3g", dice.log(3, 1000)) +
                    text(", damping: %.2g", dice.log(0.05, 10)) +
                    text(", target: %.2g", dice.between(-1, 1)));
    if (drive == 1) {
      const double t = dice.between(0, duration);
      add("table",
          text("joints: all, times: [0, %.6g, %.6g], forces: [%.2g, %.2g, %.2g]", t, t + dice.log(1e-4, 0.2),
               dice.between(-2, 2), dice.between(-2, 2), dice.between(-2, 2)) +
              (dice.chance(0.5) ? ", interpolation: cubic" : ""));
    }
    if (drive == 2)
      add("motor",
          text("joints: all, ratio: %.2g, rotor_inertia: 1e-5, stall_torque: %.2g, no_load_speed: %.3g",
               dice.log(5, 100), dice.log(0.01, 0.5), dice.log(20, 500)) +
              text(", stiffness: %.3g, damping: %.2g, target: %.2g", dice.log(3, 300), dice.log(0.05, 3),
                   dice.between(-1, 1)) +
              (dice.chance(0.5)
                   ? text(", efficiency: %.2g, slip: %.2g", dice.between(0.6, 1), dice.log(0.01, 0.3))
                   : ""));
  }
  Dice dice;
  double duration = 1;
};

/// The largest errors of positions and angles over the samples of two runs.
struct Error {
  double position = 0, angle = 0;
};
Error between(const scene::Scene& s, const scene::Run& a, const scene::Run& b) {
  Error error;
  const std::size_t n = a.columns.size(), samples = std::min(a.rows.size(), b.rows.size()) / n;
  for (std::size_t i = 0; i < samples; ++i) {
    const Eigen::Map<const VectorX<double>> p(a.rows.data() + i * n + 1, s.model.nq),
        q(b.rows.data() + i * n + 1, s.model.nq);
    const VectorX<double> d = difference(s.model, VectorX<double>(p), VectorX<double>(q));
    for (std::size_t j = 1; j < s.model.joints.size(); ++j)
      for (int k = 0; k < s.model.nvs[j]; ++k) {
        const bool linear = std::holds_alternative<FreeFlyer<double>>(s.model.joints[j]) && k < 3;
        double& e = linear ? error.position : error.angle;
        e = std::max(e, std::abs(d[s.model.idx_vs[j] + k]));
      }
  }
  return error;
}

enum class Kind { Right, Wrong, AlarmDue, AlarmUnneeded, Diverged, Unresolved, Refused };
struct Judged {
  Kind kind = Kind::Refused;
  double excess = 0;  ///< true error / accepted error
  double ratio = 0;   ///< true error / stated error, or 0 without a statement
  double cost = 0;
  std::string finer, line;
};

Judged judge(const Drawn& drawn, const std::string& folder) {
  Judged j;
  const scene::Scene s = loadSceneText(drawn.whole(), "random", folder);
  const scene::Run run = scene::run(s, {}, true);
  if (run.outcome.diverged || !run.estimate) {
    j.kind = Kind::Diverged;
    j.line = run.outcome.why;
    return j;
  }
  const scene::Estimate& e = *run.estimate;
  j.cost = e.cost, j.finer = e.finer;
  const auto scaled = [&](const Error& x) {
    return std::max(x.position / e.accepted.position, x.angle / e.accepted.angle);
  };
  // Runs that confirm each other: ever shorter steps of one method and ever smaller tolerances of the other.
  std::optional<Error> truth;
  double apart = 0;
  const auto begin = std::chrono::steady_clock::now();
  for (int level = 0;
       level < 3 && !truth && std::chrono::steady_clock::now() - begin < std::chrono::seconds(5); ++level) {
    const double shorter = std::max(10., std::ceil(drawn.h / (4e-5 / std::pow(5, level))));
    const auto reference = [&](const std::string& chosen) {
      return scene::run(loadSceneText(drawn.with(chosen), "truth", folder));
    };
    const scene::Run fine = reference(text("{name: rkmk6, step: %.15g}", drawn.h / shorter)),
                     other =
                         reference(text("{name: dopri5, tolerance: %.1g}", 1e-10 * std::pow(0.03, level)));
    if (fine.outcome.diverged || other.outcome.diverged) continue;
    apart = scaled(between(s, fine, other));
    const Error error = between(s, run, fine);
    if (apart < 0.02 || apart < 0.05 * scaled(error)) truth = error;
  }
  if (!truth) {
    j.kind = Kind::Unresolved;
    j.line = text("references differ by %.2g of the accepted error", apart);
    return j;
  }
  j.excess = scaled(*truth);
  const auto part = [&](double x, double stated, double accepted) {
    return x > 1e-11 && x > 1e-7 * accepted && x > 10 * apart * accepted ? x / std::max(stated, 1e-300) : 0;
  };
  // The kind of coordinate that decides.
  const bool linear = truth->position / e.accepted.position > truth->angle / e.accepted.angle;
  j.ratio = linear ? part(truth->position, e.error.position, e.accepted.position)
                   : part(truth->angle, e.error.angle, e.accepted.angle);
  const bool alarmed = !e.alarms.empty();
  // That energy or momentum has changed is measured, and no estimate.
  const bool measured = alarmed && e.alarms[0].what.find("by more than 1 %") != std::string::npos;
  j.kind = alarmed        ? (measured || j.excess > 1 ? Kind::AlarmDue : Kind::AlarmUnneeded)
           : j.excess > 1 ? Kind::Wrong
                          : Kind::Right;
  j.line = text("true/accepted %.3g true/stated %.3g cost %.2f order %.2g events %ld", j.excess, j.ratio,
                e.cost, e.order.value_or(0), run.outcome.events) +
           (alarmed ? ", " + e.alarms[0].what + ": " + e.alarms[0].cause : "");
  return j;
}

struct Counts {
  long all = 0, right = 0, wrong = 0, twice = 0, due = 0, unneeded = 0, unresolved = 0, diverged = 0;
  std::vector<double> ratios, costs;
  void count(const Judged& j) {
    ++all;
    right += j.kind == Kind::Right, wrong += j.kind == Kind::Wrong,
        twice += j.kind == Kind::Wrong && j.excess > 2;
    due += j.kind == Kind::AlarmDue, unneeded += j.kind == Kind::AlarmUnneeded;
    unresolved += j.kind == Kind::Unresolved, diverged += j.kind == Kind::Diverged;
    if (j.ratio > 0) ratios.push_back(j.ratio);
    if (j.cost > 0) costs.push_back(j.cost);
  }
  static double quantile(std::vector<double> x, double share) {
    if (x.empty()) return 0;
    std::sort(x.begin(), x.end());
    return x[std::min(x.size() - 1, std::size_t(share * double(x.size())))];
  }
  void print(const std::string& name) const {
    std::printf(
        "%-40s %5ld: right %4ld wrong %3ld (beyond twice %2ld) alarms %4ld (unneeded %2ld) diverged %3ld "
        "unresolved %3ld"
        " true/stated %.2f (99 %%: %.3g) cost %.2f (mean %.2f, above 0.5 %.1f %%)\n",
        name.c_str(), all, right, wrong, twice, due + unneeded, unneeded, diverged, unresolved,
        quantile(ratios, 0.5), quantile(ratios, 0.99), quantile(costs, 0.5),
        std::accumulate(costs.begin(), costs.end(), 0.) / std::max(1., double(costs.size())),
        100. * double(std::ranges::count_if(costs, [](double c) { return c > 0.5; })) /
            std::max(1., double(costs.size())));
  }
};

int judgeAll(std::uint64_t seed, long first, long end, const std::string& folder) {
  Counts total, quiet;
  std::map<std::string, Counts> by;
  std::multimap<double, std::string, std::greater<>> worst;
  for (long i = first; i < end; ++i) {
    const Drawn drawn(seed, i);
    const auto begin = std::chrono::steady_clock::now();
    Judged j;
    try {
      j = judge(drawn, folder);
    } catch (const std::exception& e) {
      std::printf("%ld refused: %s\n%s", i, e.what(), drawn.whole().c_str());
      return 2;
    }
    static const char* const names[] = {"right",    "WRONG",      "alarm due", "alarm unneeded",
                                        "diverged", "unresolved", ""};
    std::string effects;
    for (const std::string& e : drawn.effects) effects += (effects.empty() ? "" : "+") + e;
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const std::string line = text("%ld %s %s %.3g ", i, names[int(j.kind)], drawn.method.c_str(), drawn.h) +
                             effects + ": " + j.line;
    std::printf("%s (%.1f s)\n", line.c_str(), seconds);
    std::fflush(stdout);
    total.count(j), by["method " + drawn.method].count(j);
    if (j.kind == Kind::Right || j.kind == Kind::Wrong) quiet.count(j);
    if (!j.finer.empty())
      by[(j.kind == Kind::Right || j.kind == Kind::Wrong ? "quiet, shorter steps: "
                                                         : "alarm, shorter steps: ") +
         j.finer]
          .count(j);
    for (const std::string& e : drawn.effects) by["effect " + e].count(j);
    if (j.kind == Kind::Wrong) worst.emplace(j.excess, line);
    if (worst.size() > 5) worst.erase(std::prev(worst.end()));
  }
  for (const auto& [name, counts] : by) counts.print(name);
  quiet.print("all without alarm");
  total.print("all");
  for (const auto& [excess, line] : worst) std::printf("worst: %s\n", line.c_str());
  const double alarms = double(total.due + total.unneeded);
  bool right = total.twice == 0 && double(total.wrong) <= 0.003 * double(total.all) &&
               double(total.unneeded) <= std::max(1., 0.03 * alarms);
  if (total.all >= 500) {  // below, the 99th percentile is one scene
    const double median = total.quantile(total.ratios, 0.5);
    right = right && median > 0.5 && median < 2 && total.quantile(total.ratios, 0.99) < 5;
  }
  return right ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  const fs::path folder =
      fs::temp_directory_path() / ("random_scenes." + std::to_string(std::random_device()()));
  fs::create_directories(folder);
  for (int n = 1; n <= 4; ++n) writeChain(folder, n);
  int code = 2;
  if (argc == 4 && !std::strcmp(argv[1], "show")) {
    std::printf("%s", Drawn(std::strtoull(argv[2], nullptr, 10), std::atol(argv[3])).whole().c_str());
    code = 0;
  } else if (argc == 4) {
    code = judgeAll(std::strtoull(argv[1], nullptr, 10), std::atol(argv[2]), std::atol(argv[3]),
                    folder.string());
  }
  fs::remove_all(folder);
  return code;
}

#include <lattice/trigger.hpp>

#include <fmt/format.h>
#include <cmath>
#include <numbers>

namespace liecheck::properties {
namespace {

using F = Feature;
constexpr double pi = std::numbers::pi, infinity = std::numeric_limits<double>::infinity();

class Table {
 public:
  std::vector<Trigger> all;

  void begin(const char* family) { family_ = family; }
  void add(const std::string& name, F feature, double low, double high) {
    all.push_back({family_, name, feature, low, high});
  }
  /// One trigger for each interval between consecutive edges.
  void add_slices(const char* what, F feature, const std::vector<double>& edges) {
    for (std::size_t i = 0; i + 1 < edges.size(); ++i)
      add(fmt::format("{} in [{:.4g}, {:.4g})", what, edges[i], edges[i + 1]), feature, edges[i],
          edges[i + 1]);
  }
  /// One trigger for each number from `low` to `high`.
  void add_counts(const char* what, F feature, int low, int high) {
    for (int i = low; i <= high; ++i) add(fmt::format("{} = {}", what, i), feature, i, i + 1);
  }
  /// Sizes from zero and subnormal to overflow, as shares of the exponents. In double 0.49 is 1e150, where
  /// squares overflow, 0.15 is 1e46, 0.03 is 1e9 and 0.004 is 16.
  void add_scales(const char* what, F feature, double largest = 1.1) {
    const double edges[] = {-infinity, -2,    -0.9975, -0.49, -0.15, -0.03,
                            -0.004,    0.004, 0.03,    0.15,  0.49,  1.1};
    const char* names[] = {"zero",    "subnormal", "below 1e-150", "1e-150", "1e-40",      "1e-6",
                           "about 1", "1e5",       "1e30",         "1e100",  "above 1e150"};
    for (std::size_t i = 0; i < std::size(names) && edges[i] < largest; ++i)
      add(fmt::format("{} {}", what, names[i]), feature, edges[i], edges[i + 1]);
  }

 private:
  std::string family_;
};

std::vector<double> decades(int from, int to) {
  std::vector<double> edges;
  for (int e = from; e <= to; ++e) edges.push_back(std::pow(10, e));
  return edges;
}
std::vector<double> equal_parts(double low, double high, int parts) {
  std::vector<double> edges;
  for (int i = 0; i <= parts; ++i) edges.push_back(low + (high - low) * i / parts);
  return edges;
}

void add_angles(Table& t) {
  t.begin("theta near 0");
  t.add_scales("theta", F::theta_scale, -0.05);
  t.add_slices("theta", F::theta, decades(-19, 0));
  t.begin("theta in (0, pi)");
  t.add_slices("theta", F::theta, equal_parts(0, pi, 32));
  t.add("1 % of (0, pi)", F::theta, 1.1, 1.1 + pi / 100);
  t.begin("theta near pi");
  t.add("pi, rounded", F::pi_minus_theta, -1e-15, 1e-15);
  t.add_slices("pi - theta", F::pi_minus_theta, decades(-15, -1));
  t.add_slices("theta - pi", F::turn_minus_pi, decades(-15, -1));
  t.begin("theta beyond pi");
  t.add_slices("theta", F::turn, equal_parts(pi, 2 * pi, 8));
  t.add_slices("theta - 2 pi", F::turn_minus_two_pi, {-1e-1, -1e-4, -1e-8, 0, 1e-8, 1e-4, 1e-1});
  t.add_slices("theta", F::turn, {7, 100, 1e4, 1e6, infinity});
}

void add_vectors(Table& t) {
  t.begin("signs");
  t.add_counts("octant", F::octant, 0, 7);
  t.add_counts("zero components", F::zeros, 1, 3);
  t.add("w < 0", F::w, -infinity, 0);
  t.add("w = 0", F::w, 0, std::numeric_limits<double>::denorm_min());
  t.begin("off unit");
  t.add_slices("||Q|^2 - 1| / eps", F::off_unit, {0.5, 2, 4, 9});
  t.add_slices("|Q|", F::norm, {0.75, 0.999, 1.001, 1.25});
  t.add_slices("|Q|", F::norm, {0, 1e-30, 0.5});
  t.add_slices("|Q|", F::norm, {2, 1e30, infinity});
  t.add_slices("|R^T R - I| / eps", F::off_orthogonal, {0.5, 2, 4, 9});
  t.begin("scales");
  t.add_scales("length", F::length);
  t.add_scales("velocity", F::speed);
  t.add_scales("force", F::force);
  t.add_scales("mass", F::mass);
  t.begin("two points");
  t.add("p1 = p0", F::apart, 0, std::numeric_limits<double>::denorm_min());
  t.add_slices("|p1 - p0| / |p0|", F::apart, {1e-17, 1e-12, 1e-6, 1e-2});
  t.begin("inertia");
  t.add_slices("difference of moments", F::moments_apart, {0, 1e-14, 1e-9, 1e-7, 1e-5, 1e-2});
  t.add_slices("smallest moment", F::thin, {0, 1e-14, 1e-6, 1e-2});
  t.add_slices("flatness", F::flat, {-1, 1e-14, 1e-6, 1e-2});
  t.add("pointlike", F::point, 1, 2);
}

void add_trees(Table& t) {
  t.begin("joints");
  t.add_counts("joints", F::joints, 1, 5);
  t.add_slices("joints", F::joints, {6, 11, 21, 41});
  t.begin("joint type");
  const char* kinds[] = {"revolute",  "continuous", "prismatic",   "helical",
                         "spherical", "planar",     "translation", "free-flyer"};
  for (std::size_t i = 0; i < std::size(kinds); ++i)
    t.add(kinds[i], static_cast<F>(static_cast<std::size_t>(F::revolute) + i), 1, infinity);
  t.add("mimic", F::mimics, 1, infinity);
  t.begin("shape");
  const char* shapes[] = {"chain", "star", "all joints on the world", "another tree"};
  for (int i = 0; i < 4; ++i) t.add(shapes[i], F::shape, i, i + 1);
  t.add_slices("mass ratio", F::mass_ratio, {1e3, 1e6, 1e9, 1e12});
  t.add_counts("armature", F::armature, 0, 1);
  t.begin("joint state");
  t.add_slices("position", F::position, {0, 1, 10, 1e3, 1e6, infinity});
  t.add_slices("speed", F::joint_speed, {0, 1, 10, 1e3, 1e6, infinity});
  t.add_slices("acceleration or torque", F::drive, {0, 1, 10, 1e3, 1e6, infinity});
  t.begin("wrench and view");
  t.add_counts("wrench", F::wrench, 0, 1);
  t.add_counts("reference", F::seen, 0, 2);
}

void add_habits(Table& t) {
  t.begin("habit");
  t.add("first call", F::call, 1, 2);
  t.add("every 1000th call", F::call_mod_1000, 0, 1);
  t.add("every second call", F::call_mod_2, 0, 1);
  t.add("after itself", F::after_itself, 1, 2);
  t.add("after another operation", F::after_itself, 0, 1);
  t.add("same arguments again", F::same_arguments, 1, 2);
  t.add("on a second thread", F::second_thread, 1, 2);
}

}  // namespace

const std::vector<Trigger>& triggers() {
  static const std::vector<Trigger> all = [] {
    Table t;
    t.begin("always");
    t.add("always", F::one, 1, 2);
    add_angles(t);
    add_vectors(t);
    add_trees(t);
    add_habits(t);
    return t.all;
  }();
  return all;
}

}  // namespace liecheck::properties

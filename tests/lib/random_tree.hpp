#pragma once
// Random robots of every joint type, and states of them.

#include <functional>
#include <liecheck/multibody/configuration.hpp>
#include <random>

namespace liecheck::test {

using Vec = VectorX<double>;
using V3 = Vector3<double>;

class Random {
 public:
  explicit Random(unsigned seed) : bits_(seed) {}
  double uniform(double low, double high) { return low + (high - low) * double(bits_() >> 11) * 0x1p-53; }
  int below(int n) { return int(bits_() % unsigned(n)); }
  V3 vector(double size) { return {uniform(-size, size), uniform(-size, size), uniform(-size, size)}; }
  Vec tangent(int n, double size) {
    Vec v(n);
    for (double& x : v) x = uniform(-size, size);
    return v;
  }
  SE3<double> pose();
  /// The inertia of a solid box with random sides and attitude. Its mass is in [mass/10, mass].
  Inertia<double> body(double mass);
  std::vector<Force<double>> forces(int njoints) {
    std::vector<Force<double>> all;
    for (int i = 0; i < njoints; ++i) all.emplace_back(vector(5), vector(2));
    return all;
  }

 private:
  std::mt19937_64 bits_;
};

constexpr int joint_kinds = 11;
Joint<double> jointOfKind(int kind, Random& random);

enum class Shape { Chain, Star, Tree };

/// A pose without rotation.
inline SE3<double> at(double x, double y, double z) {
  return {Matrix3<double>(Matrix3<double>::Identity()), V3(x, y, z)};
}

/// n joints, which cycle through all kinds from a random one. Masses decrease from 1 kg to 1/mass_ratio kg.
Model<double> randomModel(unsigned seed, int n, Shape shape = Shape::Tree, double mass_ratio = 1);

struct State {
  Vec q, v, a, tau;
};
State randomState(const Model<double>& m, Random& random);

/// Calls f(model, state, random) for chains, stars and trees of every joint type, one for each seed: of so many joints
/// as the seed up to half of `most`, then of `most`. The masses of every fourth differ by a factor of 1000.
void forEachRobot(unsigned first, unsigned last, unsigned most,
                  const std::function<void(const Model<double>&, const State&, Random&)>& f);
/// Relative error bound of a sum of nv terms, each of a few operations: 8 nv eps of the sum of their sizes.
inline double budget(const Model<double>& m) {
  return 8 * m.nv * eps<double>();
}

/// |a - b| / max(|a|, |b|, floor).
template <class A, class B>
double relativeNorm(const A& a, const B& b, double floor) {
  return double((a - b).norm()) / std::max({double(a.norm()), double(b.norm()), floor, 1e-300});
}
double relative(const MatrixX<double>& a, const MatrixX<double>& b, double floor = 0);
template <class A, class B>
requires(A::SizeAtCompileTime != Eigen::Dynamic) double relative(const A& a, const B& b, double floor = 0) {
  return relativeNorm(a, b, floor);
}

}  // namespace liecheck::test

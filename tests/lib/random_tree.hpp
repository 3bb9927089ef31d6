#pragma once
// Random robots of every joint type, and states of them.

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
  SE3<double> pose() { return {quaternion::exp3<double>(vector(2)), vector(0.5)}; }
  /// The inertia of a solid box with random sides and attitude. Its mass is in [mass/10, mass].
  Inertia<double> body(double mass) {
    const double m = mass * uniform(0.1, 1);
    const V3 s = V3(uniform(0.05, 0.4), uniform(0.05, 0.4), uniform(0.05, 0.4)).cwiseAbs2() * (m / 12);
    const Matrix3<double> R = exp3<double>(vector(2));
    const V3 moments(s.y() + s.z(), s.x() + s.z(), s.x() + s.y());
    const Matrix3<double> I = R * moments.asDiagonal() * R.transpose();
    return {m, vector(0.2), Matrix3<double>((I + I.transpose()) / 2)};
  }
  std::vector<Force<double>> forces(int njoints) {
    std::vector<Force<double>> all;
    for (int i = 0; i < njoints; ++i) all.emplace_back(vector(5), vector(2));
    return all;
  }

 private:
  std::mt19937_64 bits_;
};

constexpr int joint_kinds = 11;
inline Joint<double> jointOfKind(int kind, Random& random) {
  const V3 axis = random.vector(1);
  switch (kind) {
    case 0:
      return Revolute<double>(Axis<double>::X());
    case 1:
      return Revolute<double>(Axis<double>::Y());
    case 2:
      return Revolute<double>(axis);
    case 3:
      return Continuous<double>(Axis<double>::Z());
    case 4:
      return Continuous<double>(axis);
    case 5:
      return Prismatic<double>(axis);
    case 6:
      return Helical<double>(axis, random.uniform(-0.3, 0.3));
    case 7:
      return Spherical<double>();
    case 8:
      return Planar<double>();
    case 9:
      return Translation<double>();
    default:
      return FreeFlyer<double>();
  }
}

enum class Shape { Chain, Star, Tree };

/// n joints, which cycle through all kinds from a random one. Masses decrease from 1 kg to 1/mass_ratio kg.
inline Model<double> randomModel(unsigned seed, int n, Shape shape = Shape::Tree, double mass_ratio = 1) {
  Random random(seed);
  Model<double> m;
  m.name = "random" + std::to_string(seed);
  const int first = random.below(joint_kinds);
  for (int i = 0; i < n; ++i) {
    const int parent = shape == Shape::Chain  ? i
                       : shape == Shape::Star ? std::min(i, 1)
                                              : random.below(i + 1);
    const int joint = m.addJoint(parent, jointOfKind((first + i) % joint_kinds, random), random.pose(),
                                 "j" + std::to_string(i));
    m.appendBodyToJoint(joint, random.body(std::pow(mass_ratio, -i / double(n))), random.pose());
    m.addFrame({"f" + std::to_string(i), joint, 0, random.pose(), FrameType::OP_FRAME});
  }
  m.armature = random.tangent(m.nv, 0.01).cwiseAbs();
  return m;
}

struct State {
  Vec q, v, a, tau;
};
inline State randomState(const Model<double>& m, Random& random) {
  return {integrate(m, neutral(m), random.tangent(m.nv, 1.5)), random.tangent(m.nv, 2),
          random.tangent(m.nv, 3), random.tangent(m.nv, 5)};
}

/// The derivative of f at 0 by central differences of order 8 with step 1/1024. For a function that rotates
/// at w rad/s the relative truncation error is (w/1024)^8/630: 9e-16 for w = 30 (chains in which every joint
/// rotates). The rounding error is 1024 eps of f, 1e-16 in long double.
template <class S, class F>
auto derivative(F f) {
  const S h = S(1) / S(1024);
  const auto pair = [&](int k) { return (f(S(k) * h) - f(S(-k) * h)).eval(); };
  return ((pair(1) * (S(4) / S(5)) - pair(2) * (S(1) / S(5)) + pair(3) * (S(4) / S(105)) -
           pair(4) * (S(1) / S(280))) /
          h)
      .eval();
}
/// The second derivative of f at 0 by such differences. The rounding error is 2^20 eps, 1e-13 in long double.
template <class S, class F>
auto secondDerivative(F f) {
  const S h = S(1) / S(1024);
  const auto middle = f(S(0)).eval();
  const auto pair = [&](int k) { return (f(S(k) * h) + f(S(-k) * h) - middle * S(2)).eval(); };
  return ((pair(1) * (S(8) / S(5)) - pair(2) * (S(1) / S(5)) + pair(3) * (S(8) / S(315)) -
           pair(4) * (S(1) / S(560))) /
          (h * h))
      .eval();
}

/// |a - b| / max(|a|, |b|, floor).
template <class A, class B>
double relative(const A& a, const B& b, double floor = 0) {
  return double((a - b).norm()) / std::max({double(a.norm()), double(b.norm()), floor, 1e-300});
}

}  // namespace liecheck::test

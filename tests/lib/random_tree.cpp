#include "random_tree.hpp"

#include <gtest/gtest.h>

namespace liecheck::test {

SE3<double> Random::pose() {
  return {quaternion::exp3<double>(vector(2)), vector(0.5)};
}
Inertia<double> Random::body(double mass) {
  const double m = mass * uniform(0.1, 1);
  const V3 s = V3(uniform(0.05, 0.4), uniform(0.05, 0.4), uniform(0.05, 0.4)).cwiseAbs2() * (m / 12);
  const Matrix3<double> R = exp3<double>(vector(2));
  const V3 moments(s.y() + s.z(), s.x() + s.z(), s.x() + s.y());
  const Matrix3<double> I = R * moments.asDiagonal() * R.transpose();
  return {m, vector(0.2), Matrix3<double>((I + I.transpose()) / 2)};
}

Joint<double> jointOfKind(int kind, Random& random) {
  const V3 axis = random.vector(1);
  const double pitch = kind == 6 ? random.uniform(-0.3, 0.3) : 0;
  const Joint<double> all[joint_kinds] = {Revolute<double>(Axis<double>::X()),
                                          Revolute<double>(Axis<double>::Y()),
                                          Revolute<double>(axis),
                                          Continuous<double>(Axis<double>::Z()),
                                          Continuous<double>(axis),
                                          Prismatic<double>(axis),
                                          Helical<double>(axis, pitch),
                                          Spherical<double>(),
                                          Planar<double>(),
                                          Translation<double>(),
                                          FreeFlyer<double>()};
  return all[kind];
}

Model<double> randomModel(unsigned seed, int n, Shape shape, double mass_ratio) {
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

State randomState(const Model<double>& m, Random& random) {
  return {integrate(m, neutral(m), random.tangent(m.nv, 1.5)), random.tangent(m.nv, 2),
          random.tangent(m.nv, 3), random.tangent(m.nv, 5)};
}

void forEachRobot(unsigned first, unsigned last, unsigned most,
                  const std::function<void(const Model<double>&, const State&, Random&)>& f) {
  for (unsigned seed = first; seed <= last; ++seed) {
    const unsigned n = seed <= most / 2 ? seed : most;
    const Model<double> m = randomModel(seed, int(n), Shape(seed % 3), seed % 4 == 0 ? 1e3 : 1);
    SCOPED_TRACE(m.name);
    Random random(1000 + seed);
    f(m, randomState(m, random), random);
  }
}

double relative(const MatrixX<double>& a, const MatrixX<double>& b, double floor) {
  return relativeNorm(a, b, floor);
}

}  // namespace liecheck::test

#include "random_tree.hpp"

#include "long_double.hpp"

namespace liecheck {

template class Model<Real>;
template class Data<Real>;
template Model<Real> Model<double>::cast<Real>() const;
template VectorX<Real> integrate<Real>(const Model<Real>&, const VectorX<Real>&, const VectorX<Real>&);
template VectorX<Real> difference<Real>(const Model<Real>&, const VectorX<Real>&, const VectorX<Real>&);

namespace test {

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

VecL along(const Model<Real>& m, const State& s, Real t) {
  return integrate(m, VecL(s.q.cast<Real>()), VecL(t * s.v.cast<Real>() + t * t / 2 * s.a.cast<Real>()));
}

MatrixX<Real> derivative(const std::function<MatrixX<Real>(Real)>& f) {
  const Real h = Real(1) / Real(1024);
  const auto pair = [&](int k) { return MatrixX<Real>(f(Real(k) * h) - f(Real(-k) * h)); };
  return (pair(1) * (Real(4) / Real(5)) - pair(2) * (Real(1) / Real(5)) + pair(3) * (Real(4) / Real(105)) -
          pair(4) * (Real(1) / Real(280))) /
         h;
}
MatrixX<Real> secondDerivative(const std::function<MatrixX<Real>(Real)>& f) {
  const Real h = Real(1) / Real(1024);
  const MatrixX<Real> middle = f(Real(0));
  const auto pair = [&](int k) { return MatrixX<Real>(f(Real(k) * h) + f(Real(-k) * h) - middle * Real(2)); };
  return (pair(1) * (Real(8) / Real(5)) - pair(2) * (Real(1) / Real(5)) + pair(3) * (Real(8) / Real(315)) -
          pair(4) * (Real(1) / Real(560))) /
         (h * h);
}

double relative(const MatrixX<double>& a, const MatrixX<double>& b, double floor) {
  return relativeNorm(a, b, floor);
}

}  // namespace test
}  // namespace liecheck

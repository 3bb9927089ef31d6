// The arguments at which an operation is probed.

#include <Eigen/Geometry>
#include <cmath>
#include <conventions/probe.hpp>

namespace liecheck::properties::conventions {
namespace {

constexpr double angles[] = {0.3, 2.1, 0.8, 1.3, 2.5, 1.7};  // [rad]

/// Values without symmetry that differ with `seed`.
class Generic {
 public:
  explicit Generic(int seed) : seed_(seed) {}
  double number() { return std::sin(5.0 * seed_ + 1.7 * count_++ + 1); }
  Eigen::Vector3d vector() { return {number(), number(), number()}; }
  Eigen::Vector3d of_length(double length) { return length * vector().normalized(); }
  Eigen::Quaterniond rotation(double angle) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle, of_length(1)));
  }

 private:
  int seed_, count_ = 0;
};

template <class... T>
Numbers joined(const T&... blocks) {
  Numbers all;
  ((all.insert(all.end(), blocks.data(), blocks.data() + blocks.size())), ...);
  return all;
}
Eigen::Matrix3d by_rows(const Eigen::Matrix3d& M) {  // as Eigen stores it
  return M.transpose();
}

Numbers value(const Layout& layout, Generic& g, double angle) {
  switch (kind_of(layout)) {
    case Kind::rotation_vector:
      return joined(g.of_length(angle));
    case Kind::quaternion:
      return joined(g.rotation(angle).coeffs());
    case Kind::rotation_matrix: {
      const Eigen::Matrix3d R = g.rotation(angle).matrix();
      if (layout.name != "A") return joined(by_rows(R));
      Eigen::Matrix3d off = Eigen::Matrix3d::Identity();  // A is not quite a rotation
      for (int i = 0; i < 9; ++i) off(i / 3, i % 3) += g.number() / 20;
      return joined(by_rows(R * off));
    }
    case Kind::tangent:
      return joined(g.vector(), g.of_length(angle));
    case Kind::pose:
      return joined(by_rows(g.rotation(angle).matrix()), g.vector());
    case Kind::configuration: {
      // The angle between two of them is below 2.5, and the first four numbers are a unit quaternion, too.
      const Eigen::Quaterniond Q = g.rotation(angle / 2);
      return joined(g.of_length(std::sqrt(1 - Q.x() * Q.x())), Q.coeffs());
    }
    case Kind::body: {
      const Eigen::Vector3d c = g.vector() / 2, r = g.vector();
      const Eigen::Matrix3d I_C = 4 * Eigen::Matrix3d::Identity() - r * r.transpose() / 2;
      return joined(std::array{2 + g.number() / 2}, c, I_C);
    }
    case Kind::angle:
      return {angle};
    case Kind::parameters:
      return joined(g.of_length(std::tan(angle / 4)));
    case Kind::weights:
      return {1 + g.number() / 2, 1 + g.number() / 2, 1 + g.number() / 2};
    case Kind::covariance: {
      Eigen::Matrix<double, 6, 6> L = Eigen::Matrix<double, 6, 6>::Identity();
      for (int i = 1; i < 6; ++i) L(i, i - 1) = g.number(), L(i, 0) = g.number() / 2;
      return joined(Eigen::Matrix<double, 6, 6>(L * L.transpose()));
    }
    case Kind::extended_pose:
      return joined(by_rows(g.rotation(angle).matrix()), g.vector(), g.vector());
    case Kind::extended_tangent:
      return joined(g.vector(), g.vector(), g.of_length(angle));
    case Kind::samples:
      return joined(g.vector(), g.vector(), g.vector());
    case Kind::vector:
      return joined(g.vector());
    case Kind::direction:
      return joined(g.of_length(1));
    case Kind::euler_angles:
      return joined(g.of_length(angle / 2));
    case Kind::scalar:  // the fraction of slerp
      return {(1 + g.number()) / 2};
    case Kind::order:  // probe_arguments() takes each of them
      return {0};
    case Kind::planar_tangent:
      return {g.number(), g.number(), angle};
    case Kind::planar_pose:
      return {g.number(), g.number(), std::cos(angle / 2), std::sin(angle / 2)};
    default:
      return joined(g.vector(), g.vector());  // a twist or a wrench
  }
}

}  // namespace

bool has_order(const Operation& operation) {
  return operation.arguments[0]->parts[0].name == "order";
}

template <class S>
std::vector<Numbers> probe_arguments(const Operation& operation) {
  std::vector<Numbers> all;
  const bool in_order = has_order(operation);
  for (int i = 0; i < (in_order ? 24 : 6); ++i) {
    Generic g(i + 1);
    Numbers x;
    for (const Layout* l : operation.arguments)
      for (const double number : value(*l, g, angles[i % 6])) x.push_back(static_cast<S>(number));
    if (in_order) x[0] = i;
    all.push_back(x);
  }
  return all;
}
template std::vector<Numbers> probe_arguments<float>(const Operation&);
template std::vector<Numbers> probe_arguments<double>(const Operation&);

}  // namespace liecheck::properties::conventions

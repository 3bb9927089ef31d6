#include <scenes/truth.hpp>

#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <oracles/exp.hpp>
#include <oracles/motions/free_body.hpp>
#include <oracles/motions/lagrange_top.hpp>
#include <oracles/motions/one_coordinate.hpp>
#include <oracles/motions/planar_chain.hpp>
#include <oracles/number.hpp>
#include <scenes/runner.hpp>

namespace liecheck::properties {
namespace {

using namespace oracles;
using T = Real100;

std::vector<Real> rounded(std::initializer_list<T> list) {
  std::vector<Real> r;
  for (const T& x : list) r.push_back(Real(x));
  return r;
}

T number(const Eigen::VectorXd& v, Eigen::Index i) {
  return v.size() ? T(v[i]) : T(0);
}

Quaternion<T> quaternion_at(const Eigen::VectorXd& q, Eigen::Index i) {
  return normalized(exact_vector<4, T>(Eigen::Vector4d(q.segment<4>(i))));
}

Body<T> body_of(const Inertia<double>& I) {
  return {T(I.mass()), exact_vector<3, T>(I.lever()), exact_matrix<3, 3, T>(I.inertia())};
}

/// The moment of inertia about an axis (a unit vector) through the joint's origin.
T about_axis(const Body<T>& body, const Vec3<T>& axis) {
  return dot(axis, body.inertia * axis) + body.mass * squared_norm(cross(axis, body.lever));
}

std::optional<Truth> free_body(const Benchmark& s) {
  const BodyState<T> initial{exact_vector<3, T>(Eigen::Vector3d(s.q0.head<3>())), quaternion_at(s.q0, 3),
                             exact_vector<3, T>(Eigen::Vector3d(s.v0.head<3>())),
                             exact_vector<3, T>(Eigen::Vector3d(s.v0.tail<3>()))};
  const auto form =
      std::make_shared<FreeBody<T>>(body_of(s.robot.inertias[1]), initial, exact_vector<3, T>(s.gravity));
  return Truth{form->family(), true, 0, [form](double t) {
                 const BodyState<T> m = form->at(T(t));
                 return Moment{rounded({m.p[0], m.p[1], m.p[2], m.Q[0], m.Q[1], m.Q[2], m.Q[3]}),
                               rounded({m.u[0], m.u[1], m.u[2], m.omega[0], m.omega[1], m.omega[2]})};
               }};
}

Moment coordinate(const CoordinateState<T>& c) {
  return {rounded({c.q}), rounded({c.v})};
}

std::optional<Truth> damped_spring(const Benchmark& s, const T& mass, const T& force) {
  const DampedSpring<T> form{mass,  number(s.damping, 0),    number(s.stiffness, 0), number(s.rest, 0),
                             force, {T(s.q0[0]), T(s.v0[0])}};
  if (!(form.stiffness > 0)) return {};
  return Truth{"damped spring", true, 0, [form](double t) { return coordinate(form.at(T(t))); }};
}

std::optional<Truth> revolute(const Benchmark& s, const Revolute<double>& joint) {
  const Body<T> body = body_of(s.robot.inertias[1]);
  const Vec3<T> stored = exact_vector<3, T>(joint.axis.to_vector()), axis = T(1 / norm(stored)) * stored;
  const T I = about_axis(body, axis);
  if (s.gravity.isZero(0)) return damped_spring(s, I, T(0));
  if (s.stiffness.size() || s.damping.size()) return {};
  // The torque of gravity: m (axis x c(q)) . g = A cos q + B sin q = -torque sin(q - hang).
  const Mat3<T> R = exact_matrix<3, 3, T>(s.robot.jointPlacements[1].rotation());
  const Vec3<T> g = transpose(R) * exact_vector<3, T>(s.gravity), lever = cross(axis, body.lever);
  const T A = body.mass * dot(lever, g), B = body.mass * dot(cross(axis, lever), g);
  const T torque = sqrt(T(A * A + B * B));
  if (torque == 0) return {};
  const T hang = atan2(A, T(-B));
  const Pendulum<T> form{sqrt(T(torque / I)), {T(s.q0[0]) - hang, T(s.v0[0])}};
  return Truth{"pendulum", true, 0, [form, hang](double t) {
                 CoordinateState<T> c = form.at(T(t));
                 c.q += hang;
                 return coordinate(c);
               }};
}

std::optional<Truth> top(const Benchmark& s) {
  const Body<T> body = body_of(s.robot.inertias[1]);
  const SE3<double>& X = s.robot.jointPlacements[1];
  const auto& I = s.robot.inertias[1].inertia();
  const bool symmetric = I.isDiagonal(0) && I(0, 0) == I(1, 1) && body.lever[0] == 0 && body.lever[1] == 0;
  const bool upright = s.gravity.head<2>().isZero(0) && X.rotation().isIdentity(0);
  if (!symmetric || !upright || !(body.lever[2] * T(-s.gravity[2]) > 0)) return {};
  const AttitudeState<T> initial{quaternion_at(s.q0, 0), exact_vector<3, T>(Eigen::Vector3d(s.v0))};
  const auto form = std::make_shared<LagrangeTop<T>>(
      body.inertia(0, 0) + body.mass * body.lever[2] * body.lever[2], body.inertia(2, 2),
      T(-s.gravity[2]) * body.mass * body.lever[2], initial);
  return Truth{"Lagrange top", true, 0, [form](double t) {
                 const AttitudeState<T> m = form->at(T(t));
                 return Moment{rounded({m.Q[0], m.Q[1], m.Q[2], m.Q[3]}),
                               rounded({m.omega[0], m.omega[1], m.omega[2]})};
               }};
}

/// A chain of N parallel revolute joints on the world. At q = 0, all joints and mass centres are on one line.
template <int N>
std::optional<Truth> chain(const Benchmark& s, const std::atomic<bool>* stop) {
  const auto& m = s.robot;
  PlanarChain<N, T> equations;
  Eigen::Vector3d axis = Eigen::Vector3d::Zero(), along = Eigen::Vector3d::Zero();
  for (std::size_t i = 1; i <= N; ++i) {
    const auto* joint = std::get_if<Revolute<double>>(&m.joints[i]);
    if (!joint || m.parents[i] != int(i) - 1 || !m.jointPlacements[i].rotation().isIdentity(0)) return {};
    if (i == 1) axis = joint->axis.to_vector();
    const Eigen::Vector3d to_next = i < N ? m.jointPlacements[i + 1].translation() : m.inertias[i].lever();
    if (along.isZero(0)) along = to_next.normalized();
    for (const Eigen::Vector3d& d : {to_next, m.inertias[i].lever()})
      if (!d.cross(along).isZero(0) || d.dot(axis) != 0) return {};
    if (joint->axis.to_vector() != axis) return {};
    const Body<T> body = body_of(m.inertias[i]);
    const Vec3<T> line = exact_vector<3, T>(along), a = exact_vector<3, T>(axis);
    equations.links[i - 1] = {body.mass, dot(line, body.lever), dot(line, exact_vector<3, T>(to_next)),
                              dot(a, body.inertia * a)};
  }
  if (along.cwiseAbs().maxCoeff() != 1 || axis.cwiseAbs().maxCoeff() != 1) return {};  // not exact
  Vec<2 * N, T> start;
  T angle(0), rate(0);
  for (int i = 0; i < N; ++i) {
    angle += T(s.q0[i]), rate += T(s.v0[i]);
    start[i] = angle, start[N + i] = rate;
  }
  Truth truth{"extrapolation of a planar chain, two orders", false, 0, {}};
  const T tolerance("1e-44");
  const auto motion = [equations, stop](const Vec<2 * N, T>& y) {
    if (stop && *stop) throw Stopped();
    return equations(y);
  };
  const auto end = reference<2 * N, T>(motion, start, T(s.duration), tolerance);
  truth.disagreement = static_cast<double>(end.disagreement);
  auto known = std::make_shared<std::map<double, Vec<2 * N, T>>>();
  (*known)[s.duration] = end.y;
  truth.at = [motion, start, tolerance, known](double t) {
    auto found = known->find(t);
    if (found == known->end())
      found =
          known->emplace(t, t > 0 ? extrapolate<2 * N, T>(motion, start, T(t), 16, tolerance) : start).first;
    Moment r;
    T angle(0), rate(0);
    for (int i = 0; i < N; ++i) {
      const auto& y = found->second;
      r.q.push_back(Real(T(y[i] - angle))), r.v.push_back(Real(T(y[N + i] - rate)));
      angle = y[i], rate = y[N + i];
    }
    return r;
  };
  return truth;
}

}  // namespace

bool Benchmark::force_free() const {
  return !others && gravity.isZero(0) && std::holds_alternative<FreeFlyer<double>>(robot.joints[1]);
}

std::optional<Truth> truth_of(const Benchmark& s, const std::atomic<bool>* stop) {
  const auto& m = s.robot;
  if (s.others || !m.armature.isZero(0)) return {};
  const bool passive = s.stiffness.size() == 0 && s.damping.size() == 0;
  try {
    if (m.njoints == 2) {
      if (std::holds_alternative<FreeFlyer<double>>(m.joints[1]) && passive &&
          m.jointPlacements[1].rotation().isIdentity(0) && m.jointPlacements[1].translation().isZero(0))
        return free_body(s);
      if (const auto* joint = std::get_if<Revolute<double>>(&m.joints[1])) return revolute(s, *joint);
      if (const auto* joint = std::get_if<Prismatic<double>>(&m.joints[1])) {
        const Mat3<T> R = exact_matrix<3, 3, T>(m.jointPlacements[1].rotation());
        const T mass(m.inertias[1].mass());
        return damped_spring(
            s, mass,
            mass * dot(R * exact_vector<3, T>(joint->axis.to_vector()), exact_vector<3, T>(s.gravity)));
      }
      if (std::holds_alternative<Spherical<double>>(m.joints[1]) && passive) return top(s);
    }
    if (!passive || !s.gravity.isZero(0)) return {};
    if (m.njoints == 3) return chain<2>(s, stop);
    if (m.njoints == 4) return chain<3>(s, stop);
    if (m.njoints == 5) return chain<4>(s, stop);
  } catch (const std::domain_error&) {  // no closed form: on a separatrix or upside down
  }
  return {};
}

namespace {

/// q0 exp(t v0) of a robot of one joint, a free-flyer or a spherical joint.
Moment along_constant_twist(const Benchmark& s, double t) {
  const bool flyer = s.v0.size() == 6;
  Vec6<Real> twist = zero_vector<6, Real>();
  for (Eigen::Index k = 0; k < s.v0.size(); ++k) twist[int(k + 6 - s.v0.size())] = Real(s.v0[k]);
  const ExpResult step = exp_se3(Real(t) * twist);
  const Quaternion<Real> Q0 = cast<Real>(quaternion_at(s.q0, flyer ? 3 : 0)),
                         Q = quaternion_product(Q0, step.Q);
  Moment m;
  if (flyer) {
    const Vec3<Real> p = rotation_matrix(Q0) * step.p;
    for (int k = 0; k < 3; ++k) m.q.push_back(Real(s.q0[k]) + p[k]);
  }
  for (int k = 0; k < 4; ++k) m.q.push_back(Q[k]);
  for (const double x : s.v0) m.v.emplace_back(x);
  return m;
}

}  // namespace

Truth named_truth(const Benchmark& s, const std::string& name) {
  const auto& joints = s.robot.joints;
  const bool alone = s.robot.njoints == 2,
             flyer = alone && std::holds_alternative<FreeFlyer<double>>(joints[1]);
  const auto twist = [&]() -> Truth {
    return {name, true, 0, [s](double t) { return along_constant_twist(s, t); }};
  };
  if (name == "constant_twist" && flyer) return twist();
  const std::optional<Truth> found = truth_of(s);
  const bool top = alone && std::holds_alternative<Spherical<double>>(joints[1]);
  if (!found && name == "sleeping_top" && top) return twist();  // exactly upright
  if (!found || !found->closed)
    throw std::invalid_argument("truth: the motion of this scene has no closed form: leave the key out");
  const std::string word = name == "damped_spring"  ? "damped spring"
                           : name.ends_with("_top") ? "Lagrange top"
                           : name == "free_fall"    ? ""
                                                    : name;
  if (name == "free_fall" ? !flyer : found->name.find(word) == std::string::npos)
    throw std::invalid_argument("truth: the closed form of this motion is '" + found->name + "', not '" +
                                name + "'");
  return *found;
}

MotionError MotionError::none() {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  return {nan, nan, nan, nan};
}

double MotionError::leading() const {
  return std::isnan(attitude) ? position : attitude;
}

void MotionError::take_larger(const MotionError& o) {
  // Takes the larger error, or o's if either is NaN. NaN in *this means that there is none yet.
  for (const ErrorMeasure& m : error_measures)
    if (!(this->*m.of >= o.*m.of)) this->*m.of = o.*m.of;
}

MotionError motion_error(const Model<double>& robot, const Moment& found, const Moment& exact) {
  MotionError e = MotionError::none();
  Real position(0), angular(0), linear(0);
  bool moves = false, turns = false;
  const auto attitude = [&](const Real& angle) {
    turns = true;
    const double a = static_cast<double>(angle);
    if (!(e.attitude >= a)) e.attitude = a;
  };
  const auto square = [](const Real& x) -> Real { return x * x; };
  for (std::size_t i = 1; i < robot.joints.size(); ++i) {
    const std::size_t q = std::size_t(robot.idx_qs[i]), v = std::size_t(robot.idx_vs[i]);
    const auto quaternion = [&](const Moment& m, std::size_t at) {
      return Quaternion<T>{{T(m.q[at]), T(m.q[at + 1]), T(m.q[at + 2]), T(m.q[at + 3])}};
    };
    const auto dv = [&](std::size_t k) -> Real { return found.v[v + k] - exact.v[v + k]; };
    const bool free = std::holds_alternative<FreeFlyer<double>>(robot.joints[i]);
    const bool prismatic = std::holds_alternative<Prismatic<double>>(robot.joints[i]);
    if (free || prismatic) {
      moves = true;
      for (std::size_t k = 0; k < (free ? 3U : 1U); ++k)
        position += square(found.q[q + k] - exact.q[q + k]), linear += square(dv(k));
    }
    if (prismatic) continue;
    if (free || std::holds_alternative<Spherical<double>>(robot.joints[i])) {
      const std::size_t Q = free ? q + 3 : q, w = free ? 3 : 0;
      attitude(Real(angle_between(quaternion(found, Q), quaternion(exact, Q))));
      for (std::size_t k = 0; k < 3; ++k) angular += square(dv(w + k));
    } else if (robot.nqs[i] == 1) {
      attitude(abs(Real(found.q[q] - exact.q[q])));
      angular += square(dv(0));
    } else if (robot.nqs[i] == 2 && robot.nvs[i] == 1) {  // cos, sin
      attitude(abs(Real(atan2(Real(found.q[q + 1] * exact.q[q] - found.q[q] * exact.q[q + 1]),
                              Real(found.q[q] * exact.q[q] + found.q[q + 1] * exact.q[q + 1])))));
      angular += square(dv(0));
    } else {
      throw std::invalid_argument("joint '" + robot.names[i] + "' has no measure of error in a sweep");
    }
  }
  if (turns) e.angular_velocity = static_cast<double>(sqrt(angular));
  if (moves)
    e.position = static_cast<double>(sqrt(position)), e.linear_velocity = static_cast<double>(sqrt(linear));
  return e;
}

}  // namespace liecheck::properties

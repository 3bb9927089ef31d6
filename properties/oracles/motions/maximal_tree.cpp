#include <oracles/motions/maximal_tree.hpp>
#include <oracles/motions/sparse_solve.hpp>

namespace liecheck::oracles {
namespace {

template <class T>
Eigen::Quaternion<T> turn_about(const Column3<T>& axis, const T& angle) {
  using std::cos, std::sin;
  const T half = angle / T(2);
  const Column3<T> v = T(sin(half)) * axis;
  return Eigen::Quaternion<T>(T(cos(half)), v[0], v[1], v[2]);
}

template <class T>
Eigen::Quaternion<T> quaternion_at(const std::vector<T>& q, std::size_t i) {
  return Eigen::Quaternion<T>(q[i + 3], q[i], q[i + 1], q[i + 2]).normalized();
}

bool turns(JointKind k) {
  return k == JointKind::revolute || k == JointKind::continuous || k == JointKind::helical;
}

}  // namespace

template <class T>
MaximalTree<T>::MaximalTree(std::vector<MaximalLink<T>> links) : links_(std::move(links)) {
  for (std::size_t i = 0; i < links_.size(); ++i) {
    MaximalLink<T>& l = links_[i];
    l.R = nearest_rotation<T>(l.R), l.axis.normalize();
    if (i && !(l.mass > 0 && l.inertia.determinant() > 0))
      throw std::domain_error("maximal_tree: a body without inertia");
    directions_.push_back(i ? directions(l) : std::vector<Direction>());
    idx_q_.push_back(nq_), idx_v_.push_back(nv_);
    if (i) nq_ += configuration_size(l.kind), nv_ += velocity_size(l.kind);
  }
  armature.assign(std::size_t(nv_), T(0));
  turns_.assign(links_.size(), T(0));
}

/// The directions of the rates, then those of the constraints.
template <class T>
auto MaximalTree<T>::directions(const MaximalLink<T>& link) -> std::vector<Direction> {
  const Column3<T> zero = Column3<T>::Zero(), &a = link.axis, e1 = a.unitOrthogonal(), e2 = a.cross(e1),
                   x = Column3<T>::UnitX(), y = Column3<T>::UnitY(), z = Column3<T>::UnitZ();
  switch (link.kind) {
    case JointKind::revolute:
    case JointKind::continuous:
      return {{zero, a}, {zero, e1}, {zero, e2}, {x, zero}, {y, zero}, {z, zero}};
    case JointKind::helical:
      return {{zero, a}, {zero, e1}, {zero, e2}, {e1, zero}, {e2, zero}, {a, Column3<T>(-link.pitch * a)}};
    case JointKind::prismatic:
      return {{a, zero}, {e1, zero}, {e2, zero}, {zero, x}, {zero, y}, {zero, z}};
    case JointKind::spherical:
      return {{zero, x}, {zero, y}, {zero, z}, {x, zero}, {y, zero}, {z, zero}};
    case JointKind::planar:
      return {{x, zero}, {y, zero}, {zero, z}, {zero, x}, {zero, y}, {z, zero}};
    case JointKind::translation:
    case JointKind::free_flyer:
      return {{x, zero}, {y, zero}, {z, zero}, {zero, x}, {zero, y}, {zero, z}};
  }
  throw std::logic_error("maximal_tree: unknown joint");
}

template <class T>
Numbers<T> MaximalTree<T>::state(const std::vector<T>& q, const std::vector<T>& v) {
  using std::atan2;
  struct Pose {
    Eigen::Quaternion<T> Q = Eigen::Quaternion<T>::Identity();
    Column3<T> o = Column3<T>::Zero(), v = Column3<T>::Zero(), omega = Column3<T>::Zero();
  };
  std::vector<Pose> poses(links_.size());
  Numbers<T> y(13 * Eigen::Index(links_.size() - 1));
  for (std::size_t i = 1; i < links_.size(); ++i) {
    const MaximalLink<T>& l = links_[i];
    const std::size_t at = std::size_t(idx_q_[i]);
    Eigen::Quaternion<T> Q = Eigen::Quaternion<T>::Identity();
    Column3<T> p = Column3<T>::Zero(), u = p, omega = p;
    if (turns(l.kind)) {
      turns_[i] = l.kind == JointKind::continuous ? T(atan2(q[at + 1], q[at])) : q[at];
      Q = turn_about<T>(l.axis, turns_[i]);
      if (l.kind == JointKind::helical) p = l.pitch * turns_[i] * l.axis;
    } else if (l.kind == JointKind::prismatic) {
      p = q[at] * l.axis;
    } else if (l.kind == JointKind::spherical) {
      Q = quaternion_at(q, at);
    } else if (l.kind == JointKind::planar) {
      p = {q[at], q[at + 1], T(0)};
      Q = turn_about<T>(Column3<T>::UnitZ(), T(atan2(q[at + 3], q[at + 2])));
    } else {
      p = {q[at], q[at + 1], q[at + 2]};
      if (l.kind == JointKind::free_flyer) Q = quaternion_at(q, at + 3);
    }
    for (std::size_t k = 0; k < std::size_t(velocity_size(l.kind)); ++k) {
      const Direction& d = directions_[i][k];
      const T& rate = v[std::size_t(idx_v_[i]) + k];
      u += rate * d.u, omega += rate * d.omega;
      if (l.kind == JointKind::helical) u += rate * l.pitch * l.axis;
    }
    const Pose& parent = poses[std::size_t(l.parent)];
    Pose& X = poses[i];
    X.Q = parent.Q * Eigen::Quaternion<T>(l.R).normalized();
    X.o = parent.o + parent.Q * l.p + X.Q * p;
    X.Q = (X.Q * Q).normalized();
    X.omega = parent.omega + X.Q * omega;
    X.v = parent.v + parent.omega.cross(Column3<T>(X.o - parent.o)) + X.Q * u;
    const Column3<T> arm = X.Q * l.lever;
    const Square3<T> R = X.Q.toRotationMatrix();
    auto body = y.template segment<13>(13 * Eigen::Index(i - 1));
    body.template head<3>() = X.o + arm;
    body.template segment<4>(3) = X.Q.coeffs();
    body.template segment<3>(7) = l.mass * (X.v + X.omega.cross(arm));
    body.template tail<3>() = R * Column3<T>(l.inertia * Column3<T>(R.transpose() * X.omega));
  }
  return y;
}

template <class T>
Snapshot<T> MaximalTree<T>::unpack(const Numbers<T>& y) const {
  const Column3<T> zero = Column3<T>::Zero();
  Snapshot<T> s;
  s.bodies.push_back(
      {Square3<T>::Identity(), Square3<T>::Zero(), zero, zero, zero, zero, zero, zero, zero, T(0)});
  for (std::size_t i = 1; i < links_.size(); ++i) {
    const MaximalLink<T>& l = links_[i];
    const auto part = y.template segment<13>(13 * Eigen::Index(i - 1));
    const Eigen::Quaternion<T> Q(part[6], part[3], part[4], part[5]);
    const Square3<T> R = Q.toRotationMatrix(), inverse = R * Square3<T>(l.inertia.inverse()) * R.transpose();
    const Column3<T> c = part.template head<3>();
    s.bodies.push_back({R, inverse, c - R * l.lever, c, part.template segment<3>(7) / l.mass,
                        inverse * part.template tail<3>(), part.template tail<3>(), zero, zero,
                        T(1) / l.mass});
  }
  return s;
}

template <class T>
auto MaximalTree<T>::row(const Snapshot<T>& s, std::size_t link, const Direction& d) const -> Row {
  const std::size_t parent = std::size_t(links_[link].parent);
  const auto &child = s.bodies[link], &base = s.bodies[parent];
  const Column3<T> f = child.R * d.u, m = child.R * d.omega, arm = child.o - child.c,
                   reach = child.o - base.c, v_o = child.v + child.omega.cross(arm),
                   turning = child.omega - base.omega, slip = v_o - base.v - base.omega.cross(reach);
  // The row is f . slip + m . turning; f and m turn with the child.
  const T bias = f.dot(Column3<T>(child.omega.cross(child.omega.cross(arm)) -
                                  base.omega.cross(Column3<T>(v_o - base.v)))) +
                 child.omega.cross(f).dot(slip) + child.omega.cross(m).dot(turning);
  return {link, parent, f, m + arm.cross(f), -f, -m - reach.cross(f), bias, T(0)};
}

template <class T>
T MaximalTree<T>::speed(const Snapshot<T>& s, const Row& r) {
  const auto &c = s.bodies[r.child], &p = s.bodies[r.parent];
  return r.v_c.dot(c.v) + r.omega_c.dot(c.omega) + r.v_p.dot(p.v) + r.omega_p.dot(p.omega);
}

/// The pose of a link in its joint's frame at q = neutral.
template <class T>
void MaximalTree<T>::relative(const Snapshot<T>& s, std::size_t link, Eigen::Quaternion<T>& Q,
                              Column3<T>& p) const {
  const MaximalLink<T>& l = links_[link];
  const auto &child = s.bodies[link], &base = s.bodies[std::size_t(l.parent)];
  const Square3<T> R = base.R * l.R;
  Q = Eigen::Quaternion<T>(Square3<T>(R.transpose() * child.R)).normalized();
  p = R.transpose() * Column3<T>(child.o - base.o - base.R * l.p);
}

template <class T>
T MaximalTree<T>::angle(std::size_t link, const Eigen::Quaternion<T>& Q) const {
  using std::atan2, std::round;
  const T near = T(2) * T(atan2(T(links_[link].axis.dot(Q.vec())), Q.w())),
          turn = T(8) * T(atan2(T(1), T(1)));
  return near + turn * T(round(T((turns_[link] - near) / turn)));
}

/// The coordinates of joints, and their rates.
template <class T>
void MaximalTree<T>::fill(Snapshot<T>& s) const {
  s.rates.resize(std::size_t(nv_)), s.drives.assign(std::size_t(nv_), T(0));
  s.positions.assign(std::size_t(nv_), std::numeric_limits<T>::quiet_NaN());
  for (std::size_t i = 1; i < links_.size(); ++i) {
    const JointKind kind = links_[i].kind;
    const std::size_t at = std::size_t(idx_v_[i]), n = std::size_t(velocity_size(kind));
    for (std::size_t k = 0; k < n; ++k) s.rates[at + k] = speed(s, row(s, i, directions_[i][k]));
    Eigen::Quaternion<T> Q;
    Column3<T> p;
    relative(s, i, Q, p);
    if (kind == JointKind::revolute || kind == JointKind::helical) s.positions[at] = angle(i, Q);
    if (kind == JointKind::prismatic) s.positions[at] = links_[i].axis.dot(p);
    if (kind == JointKind::translation)
      for (std::size_t k = 0; k < 3; ++k) s.positions[at + k] = p[Eigen::Index(k)];
  }
}

template <class T>
void MaximalTree<T>::coordinates(const Numbers<T>& y, std::vector<T>& q, std::vector<T>& v) {
  using std::cos, std::sin;
  Snapshot<T> s = unpack(y);
  fill(s);
  v = s.rates;
  q.clear();
  for (std::size_t i = 1; i < links_.size(); ++i) {
    const JointKind kind = links_[i].kind;
    Eigen::Quaternion<T> Q;
    Column3<T> p;
    relative(s, i, Q, p);
    if (turns(kind)) turns_[i] = angle(i, Q);
    if (kind == JointKind::revolute || kind == JointKind::helical) q.push_back(turns_[i]);
    if (kind == JointKind::continuous) q.push_back(T(cos(turns_[i]))), q.push_back(T(sin(turns_[i])));
    if (kind == JointKind::prismatic) q.push_back(s.positions[std::size_t(idx_v_[i])]);
    if (kind == JointKind::planar) {
      const T c = Q.w() * Q.w() - Q.z() * Q.z(), sine = T(2) * Q.w() * Q.z();
      q.insert(q.end(), {p[0], p[1], c, sine});
    }
    if (kind == JointKind::translation || kind == JointKind::free_flyer)
      q.insert(q.end(), {p[0], p[1], p[2]});
    if (kind == JointKind::spherical || kind == JointKind::free_flyer)
      q.insert(q.end(), {Q.x(), Q.y(), Q.z(), Q.w()});
  }
}

/// Adds the rows of a loop. Their biases hold the terms of the stabilisation.
template <class T>
void MaximalTree<T>::close(const Snapshot<T>& s, const Loop<T>& loop, std::vector<Row>& rows) {
  using std::atan2;
  const auto a = std::size_t(loop.a.link), b = std::size_t(loop.b.link);
  const auto &A = s.bodies[a], &B = s.bodies[b];
  const Column3<T> zero = Column3<T>::Zero(), p_a = s.point(loop.a), p_b = s.point(loop.b), arm_a = p_a - A.c,
                   arm_b = p_b - B.c;
  const auto back = [&loop](const Column3<T>& r, const Column3<T>& rate) {
    return Column3<T>(T(2) * loop.alpha * rate + loop.alpha * loop.alpha * r);
  };
  const Column3<T> bias =
      A.omega.cross(A.omega.cross(arm_a)) - B.omega.cross(B.omega.cross(arm_b)) +
      back(Column3<T>(p_a - p_b), Column3<T>(s.velocity(loop.a.link, p_a) - s.velocity(loop.b.link, p_b)));
  for (int k = 0; k < 3; ++k) {
    const Column3<T> e = Column3<T>::Unit(k);
    rows.push_back({a, b, e, arm_a.cross(e), -e, -arm_b.cross(e), bias[k], T(0)});
  }
  if (!loop.weld) return;
  Eigen::Quaternion<T> Q(Square3<T>(s.axes(loop.a) * s.axes(loop.b).transpose()));
  if (Q.w() < 0) Q.coeffs() = -Q.coeffs();
  const T sine = Q.vec().norm(), factor = sine > 0 ? T(T(2) * T(atan2(sine, Q.w())) / sine) : T(2);
  const Column3<T> turn = back(Column3<T>(factor * Q.vec()), Column3<T>(A.omega - B.omega));
  for (int k = 0; k < 3; ++k) {
    const Column3<T> e = Column3<T>::Unit(k);
    rows.push_back({a, b, zero, e, zero, -e, turn[k], T(0)});
  }
}

/// Adds the forces of all joints and loops: drives, and multipliers of constraints and armatures.
template <class T>
void MaximalTree<T>::constrain(Snapshot<T>& s, std::vector<Row>& rows) const {
  const auto pull = [&s](const Row& r, const T& force) {
    auto &c = s.bodies[r.child], &p = s.bodies[r.parent];
    c.f += force * r.v_c, c.n += force * r.omega_c, p.f += force * r.v_p, p.n += force * r.omega_p;
  };
  rows.clear();
  for (std::size_t i = links_.size() - 1; i > 0; --i)  // leaves first, so that zeros stay
    for (std::size_t k = 0; k < 6; ++k) {
      const std::size_t n = std::size_t(velocity_size(links_[i].kind)), at = std::size_t(idx_v_[i]) + k;
      if (k < n && s.drives[at] == 0 && armature[at] == 0) continue;
      Row r = row(s, i, directions_[i][k]);
      if (k < n) {
        pull(r, s.drives[at]);
        if (armature[at] == 0) continue;
        r.compliance = T(1) / armature[at];
      }
      rows.push_back(r);
    }
  for (const Loop<T>& loop : loops) close(s, loop, rows);
  if (rows.empty()) return;
  const Eigen::Index n = Eigen::Index(rows.size());
  Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic> A(n, n);
  Numbers<T> b(n);
  A.setZero();
  for (Eigen::Index i = 0; i < n; ++i) {
    const Row& r = rows[std::size_t(i)];
    b[i] = -r.bias;
    for (const bool child : {true, false}) {
      const std::size_t link = child ? r.child : r.parent;
      if (link == 0) continue;
      const auto& body = s.bodies[link];
      const Column3<T> v = (child ? r.v_c : r.v_p) * body.inverse_mass,
                       omega = body.inverse * (child ? r.omega_c : r.omega_p);
      b[i] -= v.dot(body.f) + omega.dot(Column3<T>(body.n - body.omega.cross(body.L)));
      for (Eigen::Index j = i; j < n; ++j) {
        const Row& o = rows[std::size_t(j)];
        if (o.child == link) A(i, j) += v.dot(o.v_c) + omega.dot(o.omega_c);
        if (o.parent == link) A(i, j) += v.dot(o.v_p) + omega.dot(o.omega_p);
      }
    }
    A(i, i) += r.compliance;
  }
  const Numbers<T> lambda = sparse_solve<T>(std::move(A), std::move(b));
  for (Eigen::Index i = 0; i < n; ++i) pull(rows[std::size_t(i)], lambda[i]);
}

template <class T>
Numbers<T> MaximalTree<T>::rate(const T& t, const T& inside, const Numbers<T>& y,
                                Branches<T>& branches) const {
  Snapshot<T> s = unpack(y);
  fill(s);
  s.t = t, s.inside = inside, s.branches = &branches;
  branches.g.clear();
  for (const Law<T>& law : laws) law.add(s);
  std::vector<Row> rows;
  constrain(s, rows);
  Numbers<T> rate(y.size());
  for (std::size_t i = 1; i < links_.size(); ++i) {
    const auto& b = s.bodies[i];
    const Eigen::Index at = 13 * Eigen::Index(i - 1);
    const Eigen::Quaternion<T> Q(y[at + 6], y[at + 3], y[at + 4], y[at + 5]),
        turning(T(0), b.omega[0], b.omega[1], b.omega[2]);
    rate.template segment<3>(at) = b.v;
    rate.template segment<4>(at + 3) = (turning * Q).coeffs() / T(2);
    rate.template segment<3>(at + 7) = b.f;
    rate.template segment<3>(at + 10) = b.n;
  }
  return rate;
}

template <class T>
std::vector<T> MaximalTree<T>::times() const {
  std::vector<T> all;
  for (const Law<T>& law : laws) all.insert(all.end(), law.times.begin(), law.times.end());
  std::sort(all.begin(), all.end());
  return all;
}

template class MaximalTree<boost::multiprecision::float128>;
template class MaximalTree<long double>;

}  // namespace liecheck::oracles

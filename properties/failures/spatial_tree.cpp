#include <failures/spatial_tree.hpp>

namespace liecheck::properties::spatial {

using enum Step;

Matrix3 hat(const Vector3& a) {
  Matrix3 m;
  m << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
  return m;
}
Matrix6 motion_matrix(const Matrix3& R, const Vector3& p) {
  Matrix6 X = Matrix6::Zero();
  X.topLeftCorner<3, 3>() = X.bottomRightCorner<3, 3>() = R;
  X.topRightCorner<3, 3>() = hat(p) * R;
  return X;
}

namespace {

/// V x of motions; V x* of forces is the opposite of its transpose.
Matrix6 cross_motion(const Vector6& V) {
  Matrix6 m = Matrix6::Zero();
  m.topLeftCorner<3, 3>() = m.bottomRightCorner<3, 3>() = hat(V.tail<3>());
  m.topRightCorner<3, 3>() = hat(V.head<3>());
  return m;
}
/// X with its lever arm times a factor: 0 if it turns alone.
Matrix6 with_arm(Matrix6 X, double factor) {
  X.topRightCorner<3, 3>() *= factor;
  return X;
}
std::pair<Matrix3, Vector3> pose_of(const oracles::Mat34<oracles::Real>& X) {
  std::pair<Matrix3, Vector3> pose;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) pose.first(i, k) = approximate(X(i, k));
    pose.second[i] = approximate(X(i, 3));
  }
  return pose;
}

Vector6 gyroscopic(const Link& l, const Vector6& V, Step step, const Vector6* held) {
  Vector6 momentum = l.I * (step == held_momentum ? *held : V);
  if (step == diagonal_gyroscopic)
    momentum.tail<3>() -= (l.I_C - Matrix3(l.I_C.diagonal().asDiagonal())) * V.tail<3>();
  const Matrix6 ad = cross_motion(step == held_V_of_momentum ? *held : V);
  Vector6 F = step == gyroscopic_of_motions ? Vector6(ad * momentum) : Vector6(-ad.transpose() * momentum);
  if (step == no_gyroscopic) F.setZero();
  if (step == opposite_gyroscopic) F = -F;
  if (step == no_gyroscopic_force) F.head<3>().setZero();
  if (step == no_gyroscopic_moment) F.tail<3>().setZero();
  if (step == spin_gyroscopic) F << Vector3::Zero(), V.tail<3>().cross(momentum.tail<3>());
  if (step == no_gyroscopic_arm) F.tail<3>() -= V.head<3>().cross(momentum.head<3>());
  return F;
}

}  // namespace

Matrix inverse_of(const Matrix& M) {
  return M.ldlt().solve(Matrix::Identity(M.rows(), M.cols()));
}
Matrix6 moved_by(const Vector6& V) {
  const Matrix6 ad = cross_motion(V);
  return Matrix6::Identity() - ad + 0.5 * ad * ad;
}

Tree::Tree(const std::vector<double>& numbers) {
  const CaseAt<oracles::Real> c(TreeLayout::of_size(numbers.size()), numbers);
  const oracles::TreePoses<oracles::Real>& poses = *c.poses();
  const oracles::TreeOf<double>& tree = c.stored.tree;
  gravity = Vector3(tree.gravity.x.data());
  at.v = c.v, at.a = c.a, d = c.d;
  for (std::size_t i = 0; i < tree.joints.size(); ++i) {
    const oracles::JointOf<double>& j = tree.joints[i];
    const auto [R, p] = pose_of(poses.L[i]);
    at.X.push_back(motion_matrix(R.transpose(), -R.transpose() * p));
    Link l{};
    l.kind = j.kind, l.parent = j.parent, l.v = tree.idx_v[i], l.size = oracles::velocity_size(j.kind);
    std::tie(l.R, l.p) = pose_of(poses.X[i]);
    l.mass = j.body.mass, l.com = Vector3(j.body.c.x.data()), l.I_C = Matrix3(j.body.I_C.x.data());
    l.armature = j.primary < 0 ? j.armature : 0;
    l.wrench = static_cast<int>(i) == c.F_joint ? c.F : Vector6(Vector6::Zero());
    l.S.resize(6, l.size);
    for (int k = 0; k < l.size; ++k)
      for (int r = 0; r < 6; ++r)
        l.S(r, k) = approximate(poses.S[poses.first[i] + static_cast<std::size_t>(k)][r]);
    const Matrix3 C = hat(l.com);
    l.I << l.mass * Matrix3::Identity(), -l.mass * C, l.mass * C, l.I_C - l.mass * C * C;
    has_mimics = has_mimics || j.primary >= 0;
    links.push_back(l);
  }
  frame_joint = c.stored.frame_joint;
  frame_R = Eigen::Quaterniond(c.stored.frame_Q.x.data()).normalized().toRotationMatrix();
  frame_p = Vector3(c.stored.frame_p.x.data());
}

Motions motions(const Tree& t, const State& at, const Vector3& gravity, const Wrong& wrong,
                const State* before, const Motions* held) {
  Motions m;
  for (std::size_t i = 0; i < t.links.size(); ++i) {
    const Link& l = t.links[i];
    const Step step = wrong.of(l);
    const auto p = static_cast<std::size_t>(std::max(l.parent, 0));
    Vector6 V = Vector6::Zero(), A = Vector6::Zero();
    if (l.parent >= 0)
      V = m.V[p], A = m.A[p];
    else if (i == 0 || step != gravity_of_first)
      A.head<3>() = -gravity;
    const Vector6 joint = l.S * at.v.segment(l.v, l.size);
    const bool turns = step == turned_motions;
    V = step == own_velocities ? Vector6(Vector6::Zero())
                               : Vector6(with_arm(at.X[i], turns || step == turned_velocities ? 0 : 1) * V);
    V += joint;
    if (step == held_velocities) V = held->V[i];
    const Matrix6& X = step == held_motions ? before->X[i] : at.X[i];
    if (step == own_accelerations && l.parent >= 0)
      A.setZero();
    else
      A = with_arm(X, turns || step == turned_accelerations ? 0 : 1) * A;
    const Vector6 c = cross_motion(step == held_V_of_coriolis ? held->V[i] : V) *
                      (step == held_joint_velocity ? Vector6(l.S * before->v.segment(l.v, l.size)) : joint);
    Vector6 coriolis = step == no_coriolis ? Vector6(Vector6::Zero()) : c;
    if (step == opposite_coriolis) coriolis = -c;
    if (step == no_linear_coriolis) coriolis.head<3>().setZero();
    if (step == no_angular_coriolis) coriolis.tail<3>().setZero();
    A += l.S * at.a.segment(l.v, l.size) + coriolis;
    m.V.push_back(V), m.A.push_back(A);
  }
  return m;
}

Vector torque(const Tree& t, const State& at, const Vector3& gravity, bool pushed, const Wrong& wrong,
              const State* before) {
  const Motions held = before ? motions(t, *before, gravity, right) : Motions();
  const Motions m = motions(t, at, gravity, wrong, before, &held);
  std::vector<Vector6> own, passed(t.links.size(), Vector6::Zero());
  Vector tau = t.zero();
  for (std::size_t i = 0; i < t.links.size(); ++i) {
    const Link& l = t.links[i];
    const Step step = wrong.of(l);
    const Vector6 V = step == gyroscopic_of_own ? Vector6(l.S * at.v.segment(l.v, l.size)) : m.V[i];
    own.push_back(l.I * m.A[i] + gyroscopic(l, V, step, before ? &held.V[i] : nullptr));
    if (pushed && step != own_wrench) own.back() -= l.wrench;
  }
  for (std::size_t i = t.links.size(); i-- > 0;) {
    const Link& l = t.links[i];
    const Step step = wrong.of(l);
    const Vector6 F = own[i] + passed[i];
    if (step == one_torque) tau.segment(l.v, l.size).setZero();
    if (step == about_world) {
      const Vector3 f = l.R * F.head<3>(), n = l.R * F.tail<3>();
      Vector6 W;
      W << f, n + l.p.cross(f);
      tau.segment(l.v, l.size) += l.S.transpose() * motion_matrix(l.R, Vector3::Zero()).transpose() * W;
    } else {
      tau.segment(l.v, l.size) += l.S.transpose() * F;
    }
    for (int k = 0; k < (step == first_armature ? 1 : l.size); ++k)
      tau[l.v + k] += l.armature * at.a[l.v + k];
    if (pushed && step == own_wrench) tau.segment(l.v, l.size) -= l.S.transpose() * l.wrench;
    if (l.parent < 0 || step == own_forces) continue;
    Vector6& to = passed[static_cast<std::size_t>(l.parent)];
    const Matrix6& X = step == held_forces ? before->X[i] : at.X[i];
    if (step == one_child) to.setZero();
    to += with_arm(X, step == turned_forces ? 0 : step == opposite_arms ? -1 : 1).transpose() * F;
  }
  return tau;
}

Matrix mass_matrix(const Tree& t, const Wrong& wrong) {
  std::vector<Matrix6> passed(t.links.size(), Matrix6::Zero());
  Matrix M = Matrix::Zero(t.nv(), t.nv());
  for (std::size_t i = t.links.size(); i-- > 0;) {
    const Link& l = t.links[i];
    const Step step = wrong.of(l);
    const Matrix6 I = l.I + passed[i];
    if (l.parent >= 0 && step != own_inertias) {
      const Matrix6 X = with_arm(t.at.X[i], step == turned_inertias ? 0 : 1);
      Matrix6& to = passed[static_cast<std::size_t>(l.parent)];
      if (step == inertia_of_one_child) to.setZero();
      to += X.transpose() * I * X;
    }
    Columns F = I * l.S;
    M.block(l.v, l.v, l.size, l.size) += l.S.transpose() * F;
    for (int k = 0; k < (step == first_armature ? 1 : l.size); ++k)
      if (step != armature_of_joint) M(l.v + k, l.v + k) += l.armature;
    if (const auto row = static_cast<int>(i); step == armature_of_joint && row < t.nv())
      M(row, row) += l.armature;
    for (std::size_t j = i; t.links[j].parent >= 0;) {
      const Step passing = wrong.of(t.links[j]);
      const auto parent = static_cast<std::size_t>(t.links[j].parent);
      const Matrix6& X = t.at.X[passing == stale_columns ? i : passing == columns_of_parents ? parent : j];
      F = (with_arm(X, passing == turned_columns ? 0 : 1).transpose() * F).eval();
      j = parent;
      const Link& k = t.links[j];
      if (step == only_blocks && k.v != l.v) continue;  // a mimic and its primary have one v
      M.block(k.v, l.v, k.size, l.size) += k.S.transpose() * F;
      if (step == once_of_mimic && k.v == l.v) continue;
      M.block(l.v, k.v, l.size, k.size) += (k.S.transpose() * F).transpose();
      if (step == only_parents) break;
    }
  }
  return M;
}

Vector acceleration(const Tree& t, const State& at, const Vector& tau, const Vector3& gravity, bool pushed,
                    const Wrong& wrong) {
  const std::size_t n = t.links.size();
  State still = at;
  still.a = t.zero();
  const Motions m = motions(t, still, gravity, right);
  std::vector<Matrix6> I(n, Matrix6::Zero());
  std::vector<Vector6> p(n, Vector6::Zero()), c;
  std::vector<Columns> U(n);
  std::vector<Matrix> D(n);
  std::vector<Vector> u(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Link& l = t.links[i];
    c.push_back(cross_motion(m.V[i]) * (l.S * at.v.segment(l.v, l.size)));
  }
  for (std::size_t i = n; i-- > 0;) {
    const Link& l = t.links[i];
    const Step step = wrong.of(l);
    I[i] += l.I;
    p[i] += gyroscopic(l, m.V[i], right, nullptr);
    if (pushed) p[i] -= l.wrench;
    U[i] = I[i] * l.S;
    D[i] = l.S.transpose() * U[i] + l.armature * Matrix::Identity(l.size, l.size);
    if (step == diagonal_D) D[i] = Matrix(D[i].diagonal().asDiagonal());
    D[i] = inverse_of(D[i]);
    u[i] = tau.segment(l.v, l.size) - l.S.transpose() * p[i];
    if (l.parent < 0) continue;
    Matrix6 Ia = I[i];
    if (step != not_reduced) Ia -= U[i] * D[i] * U[i].transpose();
    Vector6 pa = p[i];
    if (step != no_bias_of_c) pa += Ia * c[i];
    if (step != no_bias_of_u) pa += U[i] * D[i] * u[i];
    const auto parent = static_cast<std::size_t>(l.parent);
    const Matrix6 X = with_arm(at.X[i], step == turned_articulated ? 0 : 1);
    if (step == inertia_of_one_child) I[parent].setZero();
    if (step == one_child) p[parent].setZero();
    I[parent] += X.transpose() * Ia * X;
    p[parent] += with_arm(at.X[i], step == turned_bias ? 0 : 1).transpose() * pa;
  }
  Vector qdd = t.zero();
  std::vector<Vector6> A(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Link& l = t.links[i];
    const Step step = wrong.of(l);
    Vector6 a = Vector6::Zero();
    if (l.parent < 0)
      a.head<3>() = -gravity;
    else
      a = A[static_cast<std::size_t>(l.parent)];
    a = at.X[i] * a;
    if (step != no_last_c) a += c[i];
    const Vector rest = step == no_last_a ? u[i] : Vector(u[i] - U[i].transpose() * a);
    qdd.segment(l.v, l.size) = D[i] * rest;
    A[i] = a + l.S * qdd.segment(l.v, l.size);
  }
  return qdd;
}

std::vector<MovingBody> bodies_of(const Tree& t) {
  const Motions m = motions(t, t.at, Vector3::Zero(), right);
  std::vector<MovingBody> all;
  for (std::size_t i = 0; i < t.links.size(); ++i) {
    const Link& l = t.links[i];
    const Vector3 u = m.V[i].head<3>(), w = m.V[i].tail<3>();
    all.push_back({l, l.p + l.R * l.com, l.R * (u + w.cross(l.com)), l.R * w, l.R * (l.I_C * w), l.R * u});
  }
  return all;
}
Vector3 centre_of(const std::vector<MovingBody>& bodies, bool weighted) {
  Vector3 sum = Vector3::Zero();
  double mass = 0;
  for (const MovingBody& b : bodies) {
    const double m = weighted ? b.link.mass : 1;
    sum += m * b.x, mass += m;
  }
  return sum / mass;
}

}  // namespace liecheck::properties::spatial

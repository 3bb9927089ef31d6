#include <oracles/tree.hpp>

#include <oracles/closed_forms.hpp>

namespace liecheck::oracles {
namespace {

using namespace homogeneous;

/// E(q), where q points to the joint's part of the configuration.
template <class T>
Mat34<T> joint_pose(const JointOf<T>& j, const T* q) {
  const Vec3<T> none = zero_vector<3, T>();
  const auto circle = [&](const Vec3<T>& n, const T& c, const T& s) {
    const T r = norm(Vec<2, T>{{c, s}});
    return rotation_about<T>(n, c / r, s / r);
  };
  const auto angle = [&](const T& theta) {
    T s, c;
    sin_cos(theta, s, c);
    return rotation_about<T>(unit(j.axis), c, s);
  };
  switch (j.kind) {
    case JointKind::revolute:
      return matrix(angle(q[0]), none);
    case JointKind::helical:
      return matrix(angle(q[0]), T(j.pitch * q[0]) * unit(j.axis));
    case JointKind::prismatic:
      return matrix(identity<3, T>(), q[0] * unit(j.axis));
    case JointKind::continuous:
      return matrix(circle(unit(j.axis), q[0], q[1]), none);
    case JointKind::spherical:
      return matrix(unit_rotation(Quaternion<T>{{q[0], q[1], q[2], q[3]}}), none);
    case JointKind::planar:
      return matrix(circle(Vec3<T>{{T(0), T(0), T(1)}}, q[2], q[3]), Vec3<T>{{q[0], q[1], T(0)}});
    case JointKind::translation:
      return matrix(identity<3, T>(), Vec3<T>{{q[0], q[1], q[2]}});
    default:
      return matrix(unit_rotation(Quaternion<T>{{q[3], q[4], q[5], q[6]}}), Vec3<T>{{q[0], q[1], q[2]}});
  }
}
/// The columns s_k of the joint's motion subspace.
template <class T>
std::vector<Vec6<T>> joint_columns(const JointOf<T>& j) {
  const Vec3<T> none = zero_vector<3, T>();
  const auto unit_columns = [&](std::initializer_list<int> which) {
    std::vector<Vec6<T>> all;
    for (int k : which) {
      all.push_back(zero_vector<6, T>());
      all.back()[k] = T(1);
    }
    return all;
  };
  switch (j.kind) {
    case JointKind::revolute:
    case JointKind::continuous:
      return {stack(none, unit(j.axis))};
    case JointKind::helical:
      return {stack(j.pitch * unit(j.axis), unit(j.axis))};
    case JointKind::prismatic:
      return {stack(unit(j.axis), none)};
    case JointKind::spherical:
      return unit_columns({3, 4, 5});
    case JointKind::planar:
      return unit_columns({0, 1, 5});
    case JointKind::translation:
      return unit_columns({0, 1, 2});
    default:
      return unit_columns({0, 1, 2, 3, 4, 5});
  }
}
/// The coordinate that a mimic follows.
template <class T>
T primary_coordinate(const TreeOf<T>& tree, int primary, const std::vector<T>& q) {
  const auto i = static_cast<std::size_t>(primary);
  const T* y = &q[static_cast<std::size_t>(tree.idx_q[i])];
  if (tree.joints[i].kind != JointKind::continuous) return y[0];
  if constexpr (BallNumber<T>)
    return atan2(y[1], y[0]);
  else
    return T(atan2(y[1], y[0]));
}

/// sum_k s_k v_k of joint i.
template <class T>
Vec6<T> joint_twist(const TreeOf<T>& tree, std::size_t i, const std::vector<T>& v) {
  const JointOf<T>& j = tree.joints[i];
  Vec6<T> sum = zero_vector<6, T>();
  int k = tree.idx_v[i];
  for (const Vec6<T>& s : joint_columns(j)) {
    const T& x = v[static_cast<std::size_t>(k++)];
    sum = sum + (j.primary < 0 ? x : T(j.multiplier * x)) * s;
  }
  return sum;
}

/// sum m (x; 1)(x; 1)^T: its blocks are the second moments tr(I_C) / 2 - I_C + m c c^T, then m c and m.
template <class T>
Mat<4, 4, T> second_moments(const BodyOf<T>& b) {
  Mat<4, 4, T> J;
  const T half = (b.I_C(0, 0) + b.I_C(1, 1) + b.I_C(2, 2)) / T(2);
  for (int i = 0; i < 3; ++i) {
    const T mc = b.mass * b.c[i];
    for (int j = 0; j < 3; ++j) J(i, j) = mc * b.c[j] - b.I_C(i, j) + (i == j ? half : T(0));
    J(i, 3) = J(3, i) = mc;
  }
  J(3, 3) = b.mass;
  return J;
}
}  // namespace

template <class T>
TreeDynamics<T>::TreeDynamics(const TreeOf<T>& tree, const Numbers& q, const Numbers& v, const Numbers& a,
                              const Numbers& dq, const Numbers& dv, const Numbers& da,
                              const Numbers& displaced)
    : tree_(tree), v_(v), a_(a), da_(da), differentiated_(!dq.empty()) {
  const std::size_t n = tree.joints.size();
  const auto reserve = [&](MotionOf<T>& m) { m.X.resize(n), m.X1.resize(n), m.X2.resize(n); };
  reserve(at_);
  if (differentiated_) reserve(change_);
  for (std::size_t i = 0; i < n; ++i) {
    const JointOf<T>& j = tree.joints[i];
    Mat34<T> E;
    if (j.primary < 0) {
      E = joint_pose(j, &q[static_cast<std::size_t>(tree.idx_q[i])]);
    } else {
      const T x = j.multiplier * primary_coordinate(tree, j.primary, q) + j.offset;
      E = joint_pose(j, &x);
    }
    Mat34<T> L = product(matrix(unit_rotation(j.Q), j.p), E, 1);
    if (!displaced.empty()) {
      if constexpr (!BallNumber<T>) {
        const UnitPose<T> d = closed_exp(joint_twist(tree, i, displaced));
        L = product(L, matrix(rotation_matrix(d.Q), d.p), 1);
      }
    }
    const Mat34<T> V = generator(joint_twist(tree, i, v)),
                   A = product(V, V, 0) + generator(joint_twist(tree, i, a));
    const bool root = j.parent < 0;
    const auto p = static_cast<std::size_t>(root ? 0 : j.parent);
    at_.X[i] = root ? L : product(at_.X[p], L, 1);
    at_.X1[i] = product(at_.X[i], V, 0);
    at_.X2[i] = product(at_.X[i], A, 0);
    Mat34<T> X1_L;
    if (!root) {
      X1_L = product(at_.X1[p], L, 1);
      at_.X1[i] = at_.X1[i] + X1_L;
      at_.X2[i] = at_.X2[i] + product(at_.X2[p], L, 1) + T(2) * product(X1_L, V, 0);
    }
    J_.push_back(second_moments(j.body));
    int k = tree.idx_v[i];
    const Mat3<T> R = rotation_of(at_.X[i]);
    const Vec3<T> o = origin_of(at_.X[i]);
    Mat3<T> dR;
    Vec3<T> d_o;
    if (differentiated_) {
      const Mat34<T> D = generator(joint_twist(tree, i, dq)), dV = generator(joint_twist(tree, i, dv));
      Mat34<T>&dX = change_.X[i], &dX1 = change_.X1[i], &dX2 = change_.X2[i];
      dX = product(at_.X[i], D, 0);
      if (!root) dX = dX + product(change_.X[p], L, 1);
      dX1 = product(dX, V, 0) + product(at_.X[i], dV, 0);
      dX2 = product(dX, A, 0) +
            product(at_.X[i], product(dV, V, 0) + product(V, dV, 0) + generator(joint_twist(tree, i, da)), 0);
      if (!root) {
        const Mat34<T> d = product(change_.X1[p], L, 1) + product(X1_L, D, 0);
        dX1 = dX1 + d;
        dX2 = dX2 + product(change_.X2[p], L, 1) + product(product(at_.X2[p], L, 1), D, 0) +
              T(2) * (product(d, V, 0) + product(X1_L, dV, 0));
      }
      dR = rotation_of(dX), d_o = origin_of(dX);
    }
    for (Vec6<T> s : joint_columns(j)) {
      if (j.primary >= 0) s = j.multiplier * s;
      const Vec3<T> w = R * tail3(s);
      columns_.push_back({static_cast<int>(i), k, R * head3(s) + cross(o, w), w});
      if (differentiated_) {
        const Vec3<T> dw = dR * tail3(s);
        columns_change_.push_back({static_cast<int>(i), k, dR * head3(s) + cross(d_o, w) + cross(o, dw), dw});
      }
      ++k;
    }
  }
}

/// R' = [w] R and R'' = ([w'] + [w]^2) R.
template <class T>
FrameMotion<T>::FrameMotion(const MotionOf<T>& m, std::size_t joint, const Quaternion<T>& Q,
                            const Vec3<T>& position) {
  const Mat34<T> F = matrix(unit_rotation(Q), position);
  const Mat34<T> X = product(m.X[joint], F, 1), X1 = product(m.X1[joint], F, 1),
                 X2 = product(m.X2[joint], F, 1);
  R = rotation_of(X), p = origin_of(X), p1 = origin_of(X1), p2 = origin_of(X2);
  const Mat3<T> Rt = transpose(R);
  w = vee(rotation_of(X1) * Rt), w1 = vee(rotation_of(X2) * Rt);
}

template <class T>
std::vector<T> positive_factor(std::vector<T> A, std::size_t n) {
  for (std::size_t k = 0; k < n; ++k) {
    if (!(A[k * n + k] > T(0))) return {};
    const T inverse = T(1) / A[k * n + k];
    for (std::size_t i = k + 1; i < n; ++i) {
      const T l = A[i * n + k] * inverse;
      for (std::size_t j = k + 1; j <= i; ++j) A[i * n + j] -= l * A[j * n + k];
    }
    for (std::size_t i = k + 1; i < n; ++i) A[i * n + k] *= inverse;
    A[k * n + k] = inverse;
  }
  return A;
}
template <class T>
std::vector<T> solve(const std::vector<T>& L, std::vector<T> b) {
  const std::size_t n = b.size();
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = k + 1; i < n; ++i) b[i] -= L[i * n + k] * b[k];
  for (std::size_t k = n; k-- > 0;) {
    b[k] *= L[k * n + k];
    for (std::size_t i = k + 1; i < n; ++i) b[k] -= L[i * n + k] * b[i];
  }
  return b;
}

#define LIECHECK_TREE(T)                                                                                   \
  template TreeDynamics<T>::TreeDynamics(const TreeOf<T>&, const Numbers&, const Numbers&, const Numbers&, \
                                         const Numbers&, const Numbers&, const Numbers&, const Numbers&);  \
  template struct FrameMotion<T>;                                                                          \
  template std::vector<T> positive_factor(std::vector<T>, std::size_t);                                    \
  template std::vector<T> solve(const std::vector<T>&, std::vector<T>);
LIECHECK_TREE(Real)
LIECHECK_TREE(Real100)
LIECHECK_TREE(DoubleBall)
LIECHECK_TREE(DoubleDoubleBall)
LIECHECK_TREE(RealBall)

}  // namespace liecheck::oracles

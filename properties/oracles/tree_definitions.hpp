#pragma once
// The definitions of tree.hpp. tree_balls.cpp instantiates them for balls of double, whose small functions are all inlined, and
// tree_reals.cpp for numbers of MPFR, where inlining takes the compiler twice as long and gains nothing.

#include <oracles/tree.hpp>

#include <algorithm>
#include <cmath>
#include <oracles/closed_forms.hpp>
#include <oracles/pause.hpp>

namespace liecheck::oracles {
namespace tree_detail {

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
/// Appends the columns s_k of the joint's motion subspace.
template <class T>
void add_columns(const JointOf<T>& j, std::vector<Vec6<T>>& S) {
  const Vec3<T> none = zero_vector<3, T>();
  const auto unit_columns = [&](std::initializer_list<int> which) {
    for (int k : which) {
      S.push_back(zero_vector<6, T>());
      S.back()[k] = T(1);
    }
  };
  const auto along_axis = [&](const T& u, const T& w) {
    const Vec3<T> n = unit(j.axis);
    S.push_back(stack(is_zero(u) ? none : u * n, is_zero(w) ? none : w * n));
  };
  const T factor = j.primary >= 0 ? j.multiplier : T(1);
  switch (j.kind) {
    case JointKind::revolute:
    case JointKind::continuous:
      return along_axis(T(0), factor);
    case JointKind::helical:
      return along_axis(j.pitch * factor, factor);
    case JointKind::prismatic:
      return along_axis(factor, T(0));
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

template <class T>
bool all_zero(const std::vector<T>& x) {
  return std::all_of(x.begin(), x.end(), [](const T& y) { return is_zero(y); });
}

/// sum m (x; 1)(x; 1)^T: its blocks are the second moments tr(I_C) / 2 - I_C + m c c^T, then m c and m.
template <class T>
Mat44<T> second_moments(const BodyOf<T>& b) {
  Mat44<T> J;
  const T half = (b.I_C(0, 0) + b.I_C(1, 1) + b.I_C(2, 2)) / T(2);
  for (int i = 0; i < 3; ++i) {
    const T mc = b.mass * b.c[i];
    for (int j = 0; j < 3; ++j) J(i, j) = mc * b.c[j] - b.I_C(i, j) + (i == j ? half : T(0));
    J(i, 3) = J(3, i) = mc;
  }
  J(3, 3) = b.mass;
  return J;
}
}  // namespace tree_detail
using namespace tree_detail;

template <class T>
Vec6<T> TreePoses<T>::twist(std::size_t i, int idx_v, const Numbers& x) const {
  Vec6<T> sum = zero_vector<6, T>();
  T t;
  for (std::size_t k = first[i]; k < first[i + 1]; ++k)
    for (int r = 0; r < 6; ++r)
      if (!is_zero(S[k][r])) {
        set_product(t, S[k][r], x[static_cast<std::size_t>(idx_v) + k - first[i]]);
        sum[r] += t;
      }
  return sum;
}

template <class T>
TreePoses<T>::TreePoses(const TreeOf<T>& tree, const Numbers& q, const Numbers& displaced)
    : origin(zero_vector<3, T>()) {
  const std::size_t n = tree.joints.size();
  L.reserve(n), X.reserve(n), J.reserve(n), XJ.reserve(n), first.reserve(n + 1);
  S.reserve(static_cast<std::size_t>(tree.nv)), columns.reserve(static_cast<std::size_t>(tree.nv));
  for (std::size_t i = 0; i < tree.joints.size(); ++i) {
    Pauses::look();
    const JointOf<T>& j = tree.joints[i];
    Mat34<T> E;
    if (j.primary < 0) {
      E = joint_pose(j, &q[static_cast<std::size_t>(tree.idx_q[i])]);
    } else {
      const T x = j.multiplier * primary_coordinate(tree, j.primary, q) + j.offset;
      E = joint_pose(j, &x);
    }
    L.push_back(product(matrix(unit_rotation(j.Q), j.p), E, 1));
    add_columns(j, S);
    first.push_back(S.size());
    if constexpr (BallNumber<T>) {
      if (i == 0) origin = origin_of(L[0]);
      if (j.parent < 0)  // the origin is the exact position, whatever it is
        for (int k = 0; k < 3; ++k) L[i](k, 3) = i == 0 ? T(0) : L[i](k, 3) - origin[k];
    } else if (!displaced.empty()) {
      const UnitPose<T> d = closed_exp(twist(i, tree.idx_v[i], displaced));
      L[i] = product(L[i], matrix(rotation_matrix(d.Q), d.p), 1);
    }
    X.push_back(j.parent < 0 ? L[i] : product(X[static_cast<std::size_t>(j.parent)], L[i], 1));
    J.push_back(second_moments(j.body));
    XJ.push_back(times(X[i], J[i], 1));
    const Mat3<T> R = rotation_of(X[i]);
    const Vec3<T> o = origin_of(X[i]);
    for (std::size_t k = first[i]; k < first[i + 1]; ++k) {
      const Vec3<T> w = R * tail3(S[k]);
      columns.push_back({static_cast<int>(i), tree.idx_v[i] + static_cast<int>(k - first[i]),
                         R * head3(S[k]) + cross(o, w), w});
    }
  }
}

// With Y = X [v]: X' = X_p' L + Y and X'' = X_p'' L + (X' + X_p' L) [v] + X [a].
template <class T>
TreeDynamics<T>::TreeDynamics(const TreeOf<T>& tree, std::shared_ptr<const TreePoses<T>> poses,
                              const Numbers& v, const Numbers& a, const Numbers& dq, const Numbers& dv,
                              const Numbers& da)
    : tree_(tree), poses_(std::move(poses)), v_(v), a_(a), da_(da) {
  const std::size_t n = tree.joints.size();
  const TreePoses<T>& at = *poses_;
  at_.origin = at.origin, at_.X = at.X;
  at_.X1.assign(n, zeros<3, 4, T>()), at_.X2 = at_.X1;
  const bool moves = !all_zero(v), pushed = !all_zero(a);
  for (std::size_t i = 0; i < n; ++i) {
    const int parent = tree.joints[i].parent;
    const auto p = static_cast<std::size_t>(parent);
    Mat34<T>&X1 = at_.X1[i], &X2 = at_.X2[i];
    if (pushed) X2 = times_generator(at.X[i], at.twist(i, tree.idx_v[i], a));
    if (moves) {
      const Vec6<T> V = at.twist(i, tree.idx_v[i], v);
      X1 = times_generator(at.X[i], V);
      Mat34<T> twice = X1;
      if (parent >= 0) {
        const Mat34<T> carried = product(at_.X1[p], at.L[i], 1);
        X1 = X1 + carried;
        twice = X1 + carried;
      }
      X2 = X2 + times_generator(twice, V);
    }
    if (parent >= 0 && (moves || pushed)) X2 = X2 + product(at_.X2[p], at.L[i], 1);
  }
  if (!dq.empty()) differentiate(dq, dv, da);
}

template <class T>
void TreeDynamics<T>::differentiate(const Numbers& dq, const Numbers& dv, const Numbers& da) {
  const std::size_t n = tree_.joints.size();
  const TreePoses<T>& at = *poses_;
  const bool by_q = !all_zero(dq), by_v = !all_zero(dv), by_a = !all_zero(da);
  change_.X1.resize(n), change_.X2.resize(n);
  if (by_q) change_.X.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const int parent = tree_.joints[i].parent, k = tree_.idx_v[i];
    const auto p = static_cast<std::size_t>(parent);
    const Mat34<T>&X = at.X[i], &L = at.L[i];
    const Vec6<T> V = at.twist(i, k, v_), D = at.twist(i, k, dq), dV = at.twist(i, k, dv);
    Mat34<T>&dX1 = change_.X1[i], &dX2 = change_.X2[i];
    Mat34<T> carried = zeros<3, 4, T>(), d_carried = carried;  // X_p' L and its change
    if (parent >= 0) {
      carried = product(at_.X1[p], L, 1);
      d_carried = product(change_.X1[p], L, 1);
      dX2 = product(change_.X2[p], L, 1);
    } else {
      dX2 = carried;
    }
    dX1 = d_carried;
    if (by_q) {
      Mat34<T>& dX = change_.X[i];
      dX = times_generator(X, D);
      if (parent >= 0) {
        dX = dX + product(change_.X[p], L, 1);
        d_carried = d_carried + times_generator(carried, D);
        dX2 = dX2 + times_generator(product(at_.X2[p], L, 1), D);
      }
      dX1 = d_carried + times_generator(dX, V);
      dX2 = dX2 + times_generator(dX, at.twist(i, k, a_));
      const Mat3<T> R = rotation_of(X), dR = rotation_of(dX);
      const Vec3<T> o = origin_of(X), d_o = origin_of(dX);
      for (std::size_t s = at.first[i]; s < at.first[i + 1]; ++s) {
        const Vec3<T> w = R * tail3(at.S[s]), dw = dR * tail3(at.S[s]);
        columns_change_.push_back({static_cast<int>(i), k + static_cast<int>(s - at.first[i]),
                                   dR * head3(at.S[s]) + cross(d_o, w) + cross(o, dw), dw});
      }
    }
    if (by_v) {
      dX1 = dX1 + times_generator(X, dV);
      dX2 = dX2 + times_generator(at_.X1[i] + carried, dV);
    }
    dX2 = dX2 + times_generator(dX1 + d_carried, V);
    if (by_a) dX2 = dX2 + times_generator(X, at.twist(i, k, da));
  }
}

/// R' = [w] R and R'' = ([w'] + [w]^2) R.
template <class T>
FrameMotion<T>::FrameMotion(const MotionOf<T>& m, std::size_t joint, const Quaternion<T>& Q,
                            const Vec3<T>& position) {
  const Mat34<T> F = matrix(unit_rotation(Q), position);
  const Mat34<T> X = product(m.X[joint], F, 1), X1 = product(m.X1[joint], F, 1),
                 X2 = product(m.X2[joint], F, 1);
  R = rotation_of(X), p = origin_of(X) + m.origin, p1 = origin_of(X1), p2 = origin_of(X2);
  const Mat3<T> Rt = transpose(R);
  w = vee(rotation_of(X1) * Rt), w1 = vee(rotation_of(X2) * Rt);
}

template <class T>
FrameMotion<T> TreeDynamics<T>::frame_change(std::size_t joint, const Quaternion<T>& Q,
                                             const Vec3<T>& position) const {
  const Mat34<T> F = matrix(unit_rotation(Q), position), none = zeros<3, 4, T>();
  const Mat34<T> X = product(at_.X[joint], F, 1), X1 = product(at_.X1[joint], F, 1),
                 X2 = product(at_.X2[joint], F, 1),
                 dX = change_.X.empty() ? none : product(change_.X[joint], F, 1),
                 dX1 = product(change_.X1[joint], F, 1), dX2 = product(change_.X2[joint], F, 1);
  FrameMotion<T> d(at_, joint, Q, position);
  d.R = rotation_of(dX), d.p = origin_of(dX), d.p1 = origin_of(dX1), d.p2 = origin_of(dX2);
  const Mat3<T> Rt = transpose(rotation_of(X)), dRt = transpose(d.R);
  d.w = vee(rotation_of(dX1) * Rt + rotation_of(X1) * dRt);
  d.w1 = vee(rotation_of(dX2) * Rt + rotation_of(X2) * dRt);
  return d;
}

template <class T>
std::vector<T> positive_factor(std::vector<T> A, std::size_t n) {
  for (std::size_t k = 0; k < n; ++k) {
    if (!(A[k * n + k] > T(0))) return {};
    const T inverse = T(1) / A[k * n + k];
    for (std::size_t i = k + 1; i < n; ++i) {
      Pauses::look();
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
  Pauses::look();
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = k + 1; i < n && !is_zero(b[k]); ++i) b[i] -= L[i * n + k] * b[k];
  for (std::size_t k = n; k-- > 0;) {
    b[k] *= L[k * n + k];
    for (std::size_t i = k + 1; i < n; ++i) b[k] -= L[i * n + k] * b[i];
  }
  return b;
}

template <class T>
Solver<T>::Solver(std::vector<T> A, std::size_t n) : A_(std::move(A)), factor_(positive_factor(A_, n)) {
  if constexpr (BallNumber<T>) {
    if (factor_.empty()) return;
    std::vector<double> rough;
    for (const T& x : factor_) rough.push_back(x.head());
    std::vector<double> B(n * n), X(n * n);  // X by columns
    double size_X = 0, size_B = 0, radii = 0, off = 0;
    for (std::size_t k = 0; k < n; ++k) scale_.push_back(1 / std::sqrt(A_[k * n + k].head()));
    for (std::size_t i = 0; i < n * n; ++i) {
      const double s = scale_[i / n] * scale_[i % n], r = A_[i].r * s;
      B[i] = A_[i].head() * s;
      size_B += B[i] * B[i], radii += r * r;
    }
    for (std::size_t k = 0; k < n; ++k) {
      std::vector<double> x(n, 0);
      x[k] = 1 / scale_[k];
      x = solve(rough, std::move(x));
      for (std::size_t i = 0; i < n; ++i) {
        X[k * n + i] = x[i] / scale_[i];
        size_X += X[k * n + i] * X[k * n + i];
      }
    }
    for (std::size_t i = 0; i < n; ++i) {
      Pauses::look();
      for (std::size_t k = 0; k < n; ++k) {
        double sum = i == k ? -1 : 0;
        for (std::size_t l = 0; l < n; ++l) sum += B[i * n + l] * X[k * n + l];
        off += sum * sum;
      }
    }
    size_X = std::sqrt(size_X);
    const double rounding = static_cast<double>(n + 8) * 0x1p-52 * (std::sqrt(size_B) * size_X + 1);
    const double distance = (std::sqrt(off) + rounding + std::sqrt(radii) * size_X) * (1 + 1e-9);
    if (distance < 0.5) inverse_ = size_X / (1 - distance) * (1 + 1e-9);
  }
}

template <class T>
std::vector<T> Solver<T>::operator()(const std::vector<T>& b) const {
  std::vector<T> x = solve(factor_, b);
  if constexpr (BallNumber<T>) {
    const std::size_t n = b.size();
    double square = 0;
    for (std::size_t i = 0; i < n; ++i) {
      T residual = b[i];
      for (std::size_t k = 0; k < n; ++k) residual -= A_[i * n + k] * T(x[k].m, 0);
      const double y = scale_[i] * (residual.size() + residual.r);
      square += y * y;
    }
    const double error = inverse_ * std::sqrt(square) * (1 + 1e-9);
    for (std::size_t k = 0; k < n; ++k)
      if (const double r = scale_[k] * error * (1 + 1e-9) + 0x1p-1060; r < x[k].r) x[k].r = r;
  }
  return x;
}

#define LIECHECK_TREE(T)                                                                                   \
  template struct TreePoses<T>;                                                                            \
  template TreeDynamics<T>::TreeDynamics(const TreeOf<T>&, std::shared_ptr<const TreePoses<T>>,            \
                                         const Numbers&, const Numbers&, const Numbers&, const Numbers&,   \
                                         const Numbers&);                                                  \
  template void TreeDynamics<T>::differentiate(const Numbers&, const Numbers&, const Numbers&);            \
  template struct FrameMotion<T>;                                                                          \
  template FrameMotion<T> TreeDynamics<T>::frame_change(std::size_t, const Quaternion<T>&, const Vec3<T>&) \
      const;                                                                                               \
  template std::vector<T> positive_factor(std::vector<T>, std::size_t);                                    \
  template class Solver<T>;                                                                                \
  template std::vector<T> solve(const std::vector<T>&, std::vector<T>);

}  // namespace liecheck::oracles

// Forces, inertias, energies and momenta: sums over the mass elements of the bodies.

#include <oracles/pause.hpp>
#include <oracles/tree.hpp>

namespace liecheck::oracles {
namespace {

using namespace homogeneous;

/// N A^T [4 x 3].
template <class T>
Mat<4, 3, T> times_transposed(const Mat44<T>& N, const Mat34<T>& A) {
  Mat<4, 3, T> r;
  T t;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 3; ++j) {
      set_product(r(i, j), N(i, 0), A(j, 0));
      for (int k = 1; k < 4; ++k) {
        set_product(t, N(i, k), A(j, k));
        r(i, j) += t;
      }
    }
  return r;
}
/// tr(N A^T) = sum m x . y of the upper rows of N.
template <class T>
T trace_of_product(const Mat44<T>& N, const Mat34<T>& A) {
  T sum(0);
  for (int i = 0; i < 12; ++i) sum += N[i] * A[i];
  return sum;
}
/// tr([s] Y) = u . sum m y + w . sum m (x cross y) for Y = sum m (x; 1) y^T.
template <class T>
T work(const Vec3<T>& u, const Vec3<T>& w, const Mat<4, 3, T>& Y) {
  T sum(0);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    sum += u[i] * Y(3, i) + w[i] * (Y(j, k) - Y(k, j));
  }
  return sum;
}
template <class T>
Mat34<T> minus_gravity(Mat34<T> A, const Vec3<T>& g) {
  for (int i = 0; i < 3; ++i) A(i, 3) -= g[i];
  return A;
}
/// Replaces the value of each joint by the sum over its subtree.
template <class T, class Value>
void sum_subtrees(const TreeOf<T>& tree, std::vector<Value>& all) {
  for (std::size_t i = all.size(); i-- > 0;)
    if (const int p = tree.joints[i].parent; p >= 0) {
      auto& sum = all[static_cast<std::size_t>(p)];
      sum = sum + all[i];
    }
}
}  // namespace

template <class T>
bool TreeDynamics<T>::carries(int ancestor, std::size_t joint) const {
  int i = static_cast<int>(joint);
  while (i > ancestor) i = tree_.joints[static_cast<std::size_t>(i)].parent;
  return i == ancestor;
}

template <class T>
std::vector<T> TreeDynamics<T>::torque(const std::vector<WrenchOf<T>>& fext) const {
  const std::size_t n = poses_->XJ.size();
  std::vector<Mat<4, 3, T>> Y(n);
  for (std::size_t i = 0; i < n; ++i)
    Y[i] = times_transposed(poses_->XJ[i], minus_gravity(at_.X2[i], tree_.gravity));
  sum_subtrees(tree_, Y);
  Numbers tau(static_cast<std::size_t>(tree_.nv), T(0));
  for (const ColumnOf<T>& c : poses_->columns)
    tau[static_cast<std::size_t>(c.v)] += work(c.u, c.w, Y[static_cast<std::size_t>(c.joint)]);
  for (const WrenchOf<T>& F : fext) {
    const Mat34<T>& X = at_.X[static_cast<std::size_t>(F.joint)];
    const Vec3<T> f = rotation_of(X) * head3(F.F), m = rotation_of(X) * tail3(F.F) + cross(origin_of(X), f);
    for (const ColumnOf<T>& c : poses_->columns)
      if (carries(c.joint, static_cast<std::size_t>(F.joint)))
        tau[static_cast<std::size_t>(c.v)] -= dot(c.u, f) + dot(c.w, m);
  }
  for_each_armature(tree_, [&](std::size_t k, const T& armature) { tau[k] += armature * a_[k]; });
  return tau;
}

template <class T>
std::vector<T> TreeDynamics<T>::torque_derivative(const std::vector<WrenchOf<T>>& fext) const {
  const TreePoses<T>& at = *poses_;
  const std::size_t n = at.XJ.size();
  const bool by_q = !change_.X.empty();
  std::vector<Mat<4, 3, T>> Y(by_q ? n : 0), dY(n);
  for (std::size_t i = 0; i < n; ++i) {
    dY[i] = times_transposed(at.XJ[i], change_.X2[i]);
    if (!by_q) continue;
    const Mat34<T> A = minus_gravity(at_.X2[i], tree_.gravity);
    Y[i] = times_transposed(at.XJ[i], A);
    dY[i] = dY[i] + times_transposed(times(change_.X[i], at.J[i], 0), A);
  }
  sum_subtrees(tree_, Y);
  sum_subtrees(tree_, dY);
  Numbers tau(static_cast<std::size_t>(tree_.nv), T(0));
  for (std::size_t k = 0; k < at.columns.size(); ++k) {
    const ColumnOf<T>& c = at.columns[k];
    const auto i = static_cast<std::size_t>(c.joint), v = static_cast<std::size_t>(c.v);
    tau[v] += work(c.u, c.w, dY[i]);
    if (by_q) tau[v] += work(columns_change_[k].u, columns_change_[k].w, Y[i]);
  }
  for (const WrenchOf<T>& F : fext) {
    if (!by_q) break;
    const auto i = static_cast<std::size_t>(F.joint);
    const Mat34<T>&X = at.X[i], &dX = change_.X[i];
    const Vec3<T> f = rotation_of(X) * head3(F.F), df = rotation_of(dX) * head3(F.F);
    const Vec3<T> m = rotation_of(X) * tail3(F.F) + cross(origin_of(X), f);
    const Vec3<T> dm = rotation_of(dX) * tail3(F.F) + cross(origin_of(dX), f) + cross(origin_of(X), df);
    for (std::size_t k = 0; k < at.columns.size(); ++k) {
      const ColumnOf<T>&c = at.columns[k], &dc = columns_change_[k];
      if (carries(c.joint, i))
        tau[static_cast<std::size_t>(c.v)] -= dot(dc.u, f) + dot(c.u, df) + dot(dc.w, m) + dot(c.w, dm);
    }
  }
  for_each_armature(tree_, [&](std::size_t k, const T& armature) { tau[k] += armature * da_[k]; });
  return tau;
}

template <class T>
std::vector<T> TreeDynamics<T>::mass() const {
  const std::size_t n = poses_->XJ.size(), nv = static_cast<std::size_t>(tree_.nv);
  std::vector<Mat44<T>> moments(n);  // of the subtree of each joint, in the world's axes
  for (std::size_t i = 0; i < n; ++i) {
    const Mat<4, 3, T> Y = times_transposed(poses_->XJ[i], at_.X[i]);
    for (int r = 0; r < 4; ++r) {
      for (int c = 0; c < 3; ++c) moments[i](r, c) = Y(r, c);
      moments[i](r, 3) = r < 3 ? Y(3, r) : poses_->J[i](3, 3);
    }
  }
  sum_subtrees(tree_, moments);
  Numbers M(nv * nv, T(0));
  for (std::size_t l = 0; l < poses_->columns.size(); ++l) {
    Pauses::look();
    const ColumnOf<T>& c = poses_->columns[l];
    const Mat<4, 3, T> Y =
        times_transposed(moments[static_cast<std::size_t>(c.joint)], generator(stack(c.u, c.w)));
    for (std::size_t k = 0; k <= l; ++k) {
      if (!carries(poses_->columns[k].joint, static_cast<std::size_t>(c.joint))) continue;
      const T m = work(poses_->columns[k].u, poses_->columns[k].w, Y);
      const auto vk = static_cast<std::size_t>(poses_->columns[k].v), vl = static_cast<std::size_t>(c.v);
      M[vk * nv + vl] += m;
      if (k != l) M[vl * nv + vk] += m;
    }
  }
  for_each_armature(tree_, [&](std::size_t k, const T& armature) { M[k * nv + k] += armature; });
  return M;
}

template <class T>
T TreeDynamics<T>::kinetic_energy() const {
  T sum(0);
  for (std::size_t i = 0; i < at_.X1.size(); ++i)
    sum += trace_of_product(times(at_.X1[i], poses_->J[i], 0), at_.X1[i]);
  for_each_armature(tree_, [&](std::size_t k, const T& armature) { sum += armature * v_[k] * v_[k]; });
  return sum / T(2);
}
template <class T>
T TreeDynamics<T>::potential_energy() const {
  T sum(0);
  for (const Mat44<T>& N : poses_->XJ)
    for (int k = 0; k < 3; ++k) sum -= tree_.gravity[k] * (N(k, 3) + N(3, 3) * at_.origin[k]);
  return sum;
}
template <class T>
T TreeDynamics<T>::energy_rate() const {
  T sum(0);
  for (std::size_t i = 0; i < at_.X1.size(); ++i)
    sum += trace_of_product(times(at_.X1[i], poses_->J[i], 0), minus_gravity(at_.X2[i], tree_.gravity));
  for_each_armature(tree_, [&](std::size_t k, const T& armature) { sum += armature * v_[k] * a_[k]; });
  return sum;
}
/// sum m y and sum m (x - c) cross y, for the derivative y of x.
template <class T>
Vec6<T> TreeDynamics<T>::moment_about_centre(const std::vector<Mat34<T>>& y) const {
  Mat<4, 3, T> Y = zeros<4, 3, T>();
  Vec3<T> centre = zero_vector<3, T>();
  T mass(0);
  for (std::size_t i = 0; i < y.size(); ++i) {
    const Mat44<T>& N = poses_->XJ[i];
    Y = Y + times_transposed(N, y[i]);
    for (int k = 0; k < 3; ++k) centre[k] += N(k, 3);
    mass += N(3, 3);
  }
  for (int k = 0; k < 3; ++k) centre[k] /= mass;
  const Vec3<T> linear{{Y(3, 0), Y(3, 1), Y(3, 2)}};
  const Vec3<T> angular{{Y(1, 2) - Y(2, 1), Y(2, 0) - Y(0, 2), Y(0, 1) - Y(1, 0)}};
  return stack(linear, angular - cross(centre, linear));
}

template <class T>
T TreeDynamics<T>::total_mass() const {
  T mass(0);
  for (const Mat44<T>& J : poses_->J) mass += J(3, 3);
  return mass;
}
template <class T>
Vec3<T> TreeDynamics<T>::centre() const {
  Vec3<T> sum = zero_vector<3, T>();
  for (const Mat44<T>& N : poses_->XJ)
    for (int k = 0; k < 3; ++k) sum[k] += N(k, 3);
  const T mass = total_mass();
  for (int k = 0; k < 3; ++k) sum[k] = sum[k] / mass + at_.origin[k];
  return sum;
}
/// The derivatives of both sums of moment_about_centre.
template <class T>
Vec6<T> TreeDynamics<T>::momentum_change(bool of_rate) const {
  const std::vector<Mat34<T>>&y = of_rate ? at_.X2 : at_.X1, &dy = of_rate ? change_.X2 : change_.X1;
  const bool by_q = !change_.X.empty();
  Mat<4, 3, T> Y = zeros<4, 3, T>(), dY = Y;
  Vec3<T> centre = zero_vector<3, T>(), d_centre = centre;
  for (std::size_t i = 0; i < y.size(); ++i) {
    const Mat44<T>& N = poses_->XJ[i];
    Y = Y + times_transposed(N, y[i]);
    dY = dY + times_transposed(N, dy[i]);
    for (int k = 0; k < 3; ++k) centre[k] += N(k, 3);
    if (!by_q) continue;
    const Mat44<T> dN = times(change_.X[i], poses_->J[i], 0);
    dY = dY + times_transposed(dN, y[i]);
    for (int k = 0; k < 3; ++k) d_centre[k] += dN(k, 3);
  }
  const T mass = total_mass();
  for (int k = 0; k < 3; ++k) centre[k] /= mass, d_centre[k] /= mass;
  const auto linear = [](const Mat<4, 3, T>& m) { return Vec3<T>{{m(3, 0), m(3, 1), m(3, 2)}}; };
  const Vec3<T> angular{{dY(1, 2) - dY(2, 1), dY(2, 0) - dY(0, 2), dY(0, 1) - dY(1, 0)}};
  return stack(linear(dY), angular - cross(centre, linear(dY)) - cross(d_centre, linear(Y)));
}

#define LIECHECK_TREE(T)                                                                             \
  template std::vector<T> TreeDynamics<T>::torque(const std::vector<WrenchOf<T>>&) const;            \
  template std::vector<T> TreeDynamics<T>::torque_derivative(const std::vector<WrenchOf<T>>&) const; \
  template std::vector<T> TreeDynamics<T>::mass() const;                                             \
  template T TreeDynamics<T>::kinetic_energy() const;                                                \
  template T TreeDynamics<T>::potential_energy() const;                                              \
  template T TreeDynamics<T>::energy_rate() const;                                                   \
  template T TreeDynamics<T>::total_mass() const;                                                    \
  template Vec3<T> TreeDynamics<T>::centre() const;                                                  \
  template Vec6<T> TreeDynamics<T>::momentum_change(bool) const;                                     \
  template Vec6<T> TreeDynamics<T>::moment_about_centre(const std::vector<Mat34<T>>&) const;
LIECHECK_TREE(Real)
LIECHECK_TREE(Real100)
LIECHECK_TREE(DoubleBall)
LIECHECK_TREE(DoubleDoubleBall)
LIECHECK_TREE(RealBall)

}  // namespace liecheck::oracles

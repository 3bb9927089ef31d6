// Forces, inertias, energies and momenta: sums over the mass elements of the bodies.

#include <oracles/tree.hpp>

namespace liecheck::oracles {
namespace {

using namespace homogeneous;

template <class T>
using Mat44 = Mat<4, 4, T>;

/// A J, where the last row of A is (0, 0, 0, last).
template <class T>
Mat44<T> times(const Mat34<T>& A, const Mat44<T>& J, int last) {
  Mat44<T> r = zeros<4, 4, T>();
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 3; ++i) {
      r(i, j) = A(i, 3) * J(3, j);
      for (int k = 0; k < 3; ++k) r(i, j) += A(i, k) * J(k, j);
    }
    if (last) r(3, j) = J(3, j);
  }
  return r;
}
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
  const std::size_t n = J_.size();
  std::vector<Mat<4, 3, T>> Y(n);
  for (std::size_t i = 0; i < n; ++i)
    Y[i] = times_transposed(times(at_.X[i], J_[i], 1), minus_gravity(at_.X2[i], tree_.gravity));
  sum_subtrees(tree_, Y);
  Numbers tau(static_cast<std::size_t>(tree_.nv), T(0));
  for (const ColumnOf<T>& c : columns_)
    tau[static_cast<std::size_t>(c.v)] += work(c.u, c.w, Y[static_cast<std::size_t>(c.joint)]);
  for (const WrenchOf<T>& F : fext) {
    const Mat34<T>& X = at_.X[static_cast<std::size_t>(F.joint)];
    const Vec3<T> f = rotation_of(X) * head3(F.F), m = rotation_of(X) * tail3(F.F) + cross(origin_of(X), f);
    for (const ColumnOf<T>& c : columns_)
      if (carries(c.joint, static_cast<std::size_t>(F.joint)))
        tau[static_cast<std::size_t>(c.v)] -= dot(c.u, f) + dot(c.w, m);
  }
  for_each_armature(tree_, [&](std::size_t k, const T& armature) { tau[k] += armature * a_[k]; });
  return tau;
}

template <class T>
std::vector<T> TreeDynamics<T>::torque_derivative(const std::vector<WrenchOf<T>>& fext) const {
  const std::size_t n = J_.size();
  std::vector<Mat<4, 3, T>> Y(n), dY(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Mat34<T> A = minus_gravity(at_.X2[i], tree_.gravity);
    const Mat<4, 4, T> XJ = times(at_.X[i], J_[i], 1);
    Y[i] = times_transposed(XJ, A);
    dY[i] = times_transposed(times(change_.X[i], J_[i], 0), A) + times_transposed(XJ, change_.X2[i]);
  }
  sum_subtrees(tree_, Y);
  sum_subtrees(tree_, dY);
  Numbers tau(static_cast<std::size_t>(tree_.nv), T(0));
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    const ColumnOf<T>&c = columns_[k], &dc = columns_change_[k];
    const auto i = static_cast<std::size_t>(c.joint);
    tau[static_cast<std::size_t>(c.v)] += work(dc.u, dc.w, Y[i]) + work(c.u, c.w, dY[i]);
  }
  for (const WrenchOf<T>& F : fext) {
    const auto i = static_cast<std::size_t>(F.joint);
    const Mat34<T>&X = at_.X[i], &dX = change_.X[i];
    const Vec3<T> f = rotation_of(X) * head3(F.F), df = rotation_of(dX) * head3(F.F);
    const Vec3<T> m = rotation_of(X) * tail3(F.F) + cross(origin_of(X), f);
    const Vec3<T> dm = rotation_of(dX) * tail3(F.F) + cross(origin_of(dX), f) + cross(origin_of(X), df);
    for (std::size_t k = 0; k < columns_.size(); ++k)
      if (carries(columns_[k].joint, i))
        tau[static_cast<std::size_t>(columns_[k].v)] -= dot(columns_change_[k].u, f) +
                                                        dot(columns_[k].u, df) +
                                                        dot(columns_change_[k].w, m) + dot(columns_[k].w, dm);
  }
  for_each_armature(tree_, [&](std::size_t k, const T& armature) { tau[k] += armature * da_[k]; });
  return tau;
}

template <class T>
std::vector<T> TreeDynamics<T>::mass() const {
  const std::size_t n = J_.size(), nv = static_cast<std::size_t>(tree_.nv);
  std::vector<Mat44<T>> moments(n);  // of the subtree of each joint, in the world's axes
  for (std::size_t i = 0; i < n; ++i) {
    const Mat<4, 3, T> Y = times_transposed(times(at_.X[i], J_[i], 1), at_.X[i]);
    for (int r = 0; r < 4; ++r) {
      for (int c = 0; c < 3; ++c) moments[i](r, c) = Y(r, c);
      moments[i](r, 3) = r < 3 ? Y(3, r) : J_[i](3, 3);
    }
  }
  sum_subtrees(tree_, moments);
  Numbers M(nv * nv, T(0));
  for (std::size_t l = 0; l < columns_.size(); ++l) {
    const ColumnOf<T>& c = columns_[l];
    const Mat<4, 3, T> Y =
        times_transposed(moments[static_cast<std::size_t>(c.joint)], generator(stack(c.u, c.w)));
    for (std::size_t k = 0; k <= l; ++k) {
      if (!carries(columns_[k].joint, static_cast<std::size_t>(c.joint))) continue;
      const T m = work(columns_[k].u, columns_[k].w, Y);
      const auto vk = static_cast<std::size_t>(columns_[k].v), vl = static_cast<std::size_t>(c.v);
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
  for (std::size_t i = 0; i < J_.size(); ++i) {
    const auto Y = times_transposed(times(at_.X1[i], J_[i], 0), at_.X1[i]);
    sum += Y(0, 0) + Y(1, 1) + Y(2, 2);
  }
  for_each_armature(tree_, [&](std::size_t k, const T& armature) { sum += armature * v_[k] * v_[k]; });
  return sum / T(2);
}
template <class T>
T TreeDynamics<T>::potential_energy() const {
  T sum(0);
  for (std::size_t i = 0; i < J_.size(); ++i) {
    const Mat44<T> N = times(at_.X[i], J_[i], 1);
    for (int k = 0; k < 3; ++k) sum -= tree_.gravity[k] * N(k, 3);
  }
  return sum;
}
template <class T>
T TreeDynamics<T>::energy_rate() const {
  T sum(0);
  for (std::size_t i = 0; i < J_.size(); ++i) {
    const auto Y = times_transposed(times(at_.X1[i], J_[i], 0), minus_gravity(at_.X2[i], tree_.gravity));
    sum += Y(0, 0) + Y(1, 1) + Y(2, 2);
  }
  for_each_armature(tree_, [&](std::size_t k, const T& armature) { sum += armature * v_[k] * a_[k]; });
  return sum;
}
template <class T>
Vec3<T> TreeDynamics<T>::centre() const {
  Vec3<T> sum = zero_vector<3, T>();
  T mass(0);
  for (std::size_t i = 0; i < J_.size(); ++i) {
    const Mat44<T> N = times(at_.X[i], J_[i], 1);
    for (int k = 0; k < 3; ++k) sum[k] += N(k, 3);
    mass += J_[i](3, 3);
  }
  return {{sum[0] / mass, sum[1] / mass, sum[2] / mass}};
}
/// sum m y and sum m (x - c) cross y, for the derivative y of x.
template <class T>
Vec6<T> TreeDynamics<T>::moment_about_centre(const std::vector<Mat34<T>>& y) const {
  Mat<4, 3, T> Y = zeros<4, 3, T>();
  for (std::size_t i = 0; i < J_.size(); ++i) Y = Y + times_transposed(times(at_.X[i], J_[i], 1), y[i]);
  const Vec3<T> linear{{Y(3, 0), Y(3, 1), Y(3, 2)}};
  const Vec3<T> angular{{Y(1, 2) - Y(2, 1), Y(2, 0) - Y(0, 2), Y(0, 1) - Y(1, 0)}};
  return stack(linear, angular - cross(centre(), linear));
}

#define LIECHECK_TREE(T)                                                                             \
  template std::vector<T> TreeDynamics<T>::torque(const std::vector<WrenchOf<T>>&) const;            \
  template std::vector<T> TreeDynamics<T>::torque_derivative(const std::vector<WrenchOf<T>>&) const; \
  template std::vector<T> TreeDynamics<T>::mass() const;                                             \
  template T TreeDynamics<T>::kinetic_energy() const;                                                \
  template T TreeDynamics<T>::potential_energy() const;                                              \
  template T TreeDynamics<T>::energy_rate() const;                                                   \
  template Vec3<T> TreeDynamics<T>::centre() const;                                                  \
  template Vec6<T> TreeDynamics<T>::moment_about_centre(const std::vector<Mat34<T>>&) const;
LIECHECK_TREE(Real)
LIECHECK_TREE(Real100)
LIECHECK_TREE(DoubleBall)
LIECHECK_TREE(DoubleDoubleBall)
LIECHECK_TREE(RealBall)

}  // namespace liecheck::oracles

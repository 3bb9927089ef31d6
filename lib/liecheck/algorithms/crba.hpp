#pragma once
// The joint-space inertia matrix M(q), its factors and its inverse.
//
//   M_ij = S_i^T Ic_j S_j,  i an ancestor of j or j itself;  Ic_j the inertia of all that joint j carries.
//   Composite rigid bodies, Featherstone (2008), table 6.2; L^T L factors and their sparsity, table 6.3.

#include <liecheck/algorithms/kinematics.hpp>

namespace liecheck {

/// A call that needs M^-1 met a joint that moves no inertia; what() names it.
class SingularInertia : public std::domain_error {
 public:
  SingularInertia(const std::string& joint_name, int joint_index, bool finite = true)
      : std::domain_error(
            "joint '" + joint_name + "' (joint " + std::to_string(joint_index) + ") " +
            (finite ? "moves no inertia, so no force sets its acceleration: are the links behind it massless?"
                    : "moves an inertia that is no finite number: q is too large")),
        joint_index(joint_index) {}
  int joint_index;
};

namespace algorithms_detail {

/// data.work.inertia[i]: of all that joint i carries, in world axes at its origin; [0] without what is welded to the
/// world. Updates liMi, oMi.
template <Scalar S>
void compositeInertias(const Model<S>& model, Data<S>& data, In<S> q) {
  auto& I = data.work.inertia;
  I[0] = {};
  columnsInWorldAxes(model, data, q, [&](const auto& joint) {
    const std::size_t i = std::size_t(joint.index);
    multibody_detail::build(
        I[i], [&]() __attribute__((always_inline)) {
          return CompositeInertia<S>::turned(data.oMi[i].rotation(), model.inertias[i]);
        });
  });
  for (std::size_t i = model.joints.size() - 1; i > 0; --i)
    I[std::size_t(model.parents[i])].join(I[i], data.work.r[i], data.work.joined[i]);
}

/// Momentum I s of a column s [6] about its joint's origin, f = m (u + omega x c), n = I_C omega + c x f, then moved down
/// the tree: force x y z and moment u v w, as numbers that stay in registers, where a Force is stored and read again.
template <Scalar S>
struct ColumnMomentum {
  S x, y, z, u, v, w;
  /// turn: the column is a turn alone, s = (0, omega).
  [[gnu::always_inline]] ColumnMomentum(const CompositeInertia<S>& I, const S* s, bool turn = false) {
    const S a = s[3], b = s[4], c = s[5];
    x = mul_add(b, I.c[2], S(-(c * I.c[1])));
    y = mul_add(c, I.c[0], S(-(a * I.c[2])));
    z = mul_add(a, I.c[1], S(-(b * I.c[0])));
    if (!turn) x += s[0], y += s[1], z += s[2];
    x *= I.mass, y *= I.mass, z *= I.mass;
    u = mul_add(I.xx, a, mul_add(I.xy, b, S(I.xz * c)));
    v = mul_add(I.xy, a, mul_add(I.yy, b, S(I.yz * c)));
    w = mul_add(I.xz, a, mul_add(I.yz, b, S(I.zz * c)));
    shift(I.c);
  }
  /// To a point from which this one is d [m] away: n + d x f.
  [[gnu::always_inline]] void shift(const Vector3<S>& d) {
    u += mul_add(d[1], z, S(-(d[2] * y)));
    v += mul_add(d[2], x, S(-(d[0] * z)));
    w += mul_add(d[0], y, S(-(d[1] * x)));
  }
  /// What a motion s [6], a displacement s [3] and a turn s [3] feel of it: s^T F.
  [[gnu::always_inline]] S on(const S* s) const { return onDisplacement(s) + onTurn(s + 3); }
  [[gnu::always_inline]] S onDisplacement(const S* s) const {
    return mul_add(x, s[0], mul_add(y, s[1], S(z * s[2])));
  }
  [[gnu::always_inline]] S onTurn(const S* s) const {
    return mul_add(u, s[0], mul_add(v, s[1], S(w * s[2])));
  }
  Force<S> force() const { return {Vector3<S>(x, y, z), Vector3<S>(u, v, w)}; }
};

/// M of composite inertias and columns. With mimics several columns act on one number of v, and their terms are added up;
/// else column m acts on v[m] alone, and what stands between branches is not touched: M is zero there when it comes.
template <bool mimics, Scalar S>
void massMatrix(const Model<S>& model, const Data<S>& data, MatrixX<S>& M) {
  if constexpr (mimics) M = model.armature.asDiagonal();
  const S* const columns = data.work.S_columns.data();
  const int *const firsts = model.idx_columns.data(), *const counts = model.column_counts.data();
  for (std::size_t j = model.joints.size() - 1; j > 0; --j) {
    const auto fill = [&](int k, auto turns) __attribute__((always_inline)) {
      // M(m, k) and M(k, m) are 5 to 10 % slower. Which of the two is the row is the same: M is symmetric.
      S* const column_k = M.data() + (mimics ? 0 : k * M.rows());
      S* const row_k = M.data() + (mimics ? 0 : k);
      const auto set = [&](int m, const S& h) __attribute__((always_inline)) {
        if constexpr (mimics) {
          const int vk = model.column_to_v[std::size_t(k)], vm = model.column_to_v[std::size_t(m)];
          M(vk, vm) += h;
          if (m != k) M(vm, vk) += h;
        } else {
          column_k[m] = row_k[m * M.rows()] = h;
        }
      };
      ColumnMomentum<S> F(data.work.inertia[j], columns + 6 * k, turns);
      if constexpr (!turns)
        for (int m = firsts[j]; m < k; ++m) set(m, F.on(columns + 6 * m));
      const S own = turns ? F.onTurn(columns + 6 * k + 3) : F.on(columns + 6 * k);
      set(k, mimics ? own : S(own + model.armature[k]));
      for (std::size_t i = j, p; (p = std::size_t(model.parents[i])) > 0; i = p) {
        F.shift(data.work.r[i]);
        const int first = firsts[p], count = counts[p];
        const S* s = columns + 6 * first;
        if (turnsAboutAxis<S>(model.joints[p])) {
          set(first, F.onTurn(s + 3));
        } else if (count == 6) {  // a free-flyer's: [R, 0; 0, R]
          for (int m = first; m < first + 3; ++m, s += 6)
            set(m, F.onDisplacement(s)), set(m + 3, F.onTurn(s));
        } else {
          for (int m = first; m < first + count; ++m, s += 6) set(m, F.on(s));
        }
      }
    };
    if (turnsAboutAxis<S>(model.joints[j]))
      fill(firsts[j], std::true_type());
    else
      for (int k = firsts[j]; k < firsts[j] + counts[j]; ++k) fill(k, std::false_type());
  }
}

/// The joint's own inertia is lost in the rounding of what was taken from it: no pivot.
template <Scalar S>
void checkPivot(const Model<S>& model, int v_index, const S& pivot, const S& before) {
  if (pivot > S(64) * eps<S>() * before) return;
  for (int k = 0; k < model.ncolumns; ++k)
    if (model.column_to_v[std::size_t(k)] == v_index) {
      const int joint = model.column_to_joint[std::size_t(k)];
      throw SingularInertia(model.names[std::size_t(joint)], joint, finite<S>(pivot));
    }
}

/// The number of v in front of number k on its way to the universe, -1 at the base. Mimics couple branches, so
/// with them each follows the one before: no sparsity is assumed.
template <Scalar S>
int previousVelocity(const Model<S>& model, int k) {
  if (model.has_mimics) return k - 1;
  const std::size_t i = std::size_t(model.column_to_joint[std::size_t(k)]);
  if (k > model.idx_vs[i]) return k - 1;
  for (std::size_t p = std::size_t(model.parents[i]); p > 0; p = std::size_t(model.parents[p]))
    if (model.nvs[p] > 0) return model.idx_vs[p] + model.nvs[p] - 1;
  return -1;
}

/// data.work.factor = L with M = L^T L, lower, as sparse as the tree. Throws SingularInertia. Needs M.
template <Scalar S>
void factorize(const Model<S>& model, Data<S>& data) {
  const auto before = [&](int k) { return previousVelocity(model, k); };
  auto& L = data.work.factor;
  L = data.M();
  for (int k = model.nv - 1; k >= 0; --k) {
    checkPivot<S>(model, k, L(k, k), data.M()(k, k));
    using std::sqrt;
    L(k, k) = sqrt(L(k, k));
    for (int i = before(k); i >= 0; i = before(i)) L(k, i) /= L(k, k);
    for (int i = before(k); i >= 0; i = before(i))
      for (int j = i; j >= 0; j = before(j)) L(i, j) -= L(k, i) * L(k, j);
  }
}
/// x := M^-1 x, by the factor.
template <Scalar S, class Column>
void solve(const Model<S>& model, const MatrixX<S>& L, Column&& x) {
  for (int k = model.nv - 1; k >= 0; --k) {
    x[k] /= L(k, k);
    for (int i = previousVelocity(model, k); i >= 0; i = previousVelocity(model, i)) x[i] -= L(k, i) * x[k];
  }
  for (int k = 0; k < model.nv; ++k) {
    for (int i = previousVelocity(model, k); i >= 0; i = previousVelocity(model, i)) x[k] -= L(k, i) * x[i];
    x[k] /= L(k, k);
  }
}

}  // namespace algorithms_detail

/// M(q) [nv x nv], whole, symmetric to the last bit, armature on its diagonal. Updates liMi, oMi, M. q [nq].
template <Scalar S>
const MatrixX<S>& crba(const Model<S>& model, Data<S>& data, In<S> q) {
  data.require(Dense::Mass, "crba");
  algorithms_detail::compositeInertias(model, data, q);
  auto& M = data.M.write(Level::Position);  // zero between branches since data was made
  if (model.has_mimics)
    algorithms_detail::massMatrix<true>(model, data, M);
  else
    algorithms_detail::massMatrix<false>(model, data, M);
  return M;
}

/// M(q)^-1 [nv x nv], whole and symmetric. Throws SingularInertia. Updates liMi, oMi, M, Minv. q [nq].
template <Scalar S>
const MatrixX<S>& computeMinverse(const Model<S>& model, Data<S>& data, In<S> q) {
  crba(model, data, q);
  algorithms_detail::factorize(model, data);
  auto& Minv = data.Minv.write(Level::Position);
  Minv.setIdentity();
  for (int k = 0; k < model.nv; ++k) algorithms_detail::solve(model, data.work.factor, Minv.col(k));
  for (int k = 0; k < model.nv; ++k)
    for (int i = 0; i < k; ++i) Minv(i, k) = Minv(k, i);
  return Minv;
}

// float and double are compiled once, in instantiations_*.cpp; other scalars where they are used.
extern template const MatrixX<float>& crba<float>(const Model<float>&, Data<float>&, In<float>);
extern template const MatrixX<float>& computeMinverse<float>(const Model<float>&, Data<float>&, In<float>);
extern template const MatrixX<double>& crba<double>(const Model<double>&, Data<double>&, In<double>);
extern template const MatrixX<double>& computeMinverse<double>(const Model<double>&, Data<double>&,
                                                               In<double>);

}  // namespace liecheck

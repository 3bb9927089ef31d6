#pragma once
// The joint-space inertia matrix M(q), its factors and its inverse.
//
//   M_ij = S_i^T Ic_j S_j,  i = j or an ancestor of j.  Ic_j: inertia of all bodies that joint j carries.
//   Featherstone (2008): composite-rigid-body algorithm, table 6.2; sparse L^T L factors, table 6.3.
//   M^-1 = W W^T, W = L^-1, which has the zeros of L.

#include <liecheck/algorithms/kinematics.hpp>

namespace liecheck {

/// Thrown if M^-1 is needed but a joint moves no inertia, or one that is not finite. what() names the joint.
class SingularInertia : public std::domain_error {
 public:
  SingularInertia(const std::string& joint_name, int joint, bool finite = true)
      : std::domain_error(
            "joint '" + joint_name + "' (joint " + std::to_string(joint) + ") " +
            (finite ? "moves no inertia, so no force sets its acceleration: are the links behind it massless?"
                    : "moves an inertia that is not finite: q is too large")),
        joint_index(joint) {}
  int joint_index;
};

namespace algorithms_detail {

/// Sets data.work.inertia[i] = Ic_i, in world axes at joint i's origin; Ic_0 excludes bodies fixed to the
/// world. Updates liMi, oMi, work.r and work.S_columns.
template <Scalar S>
void compositeInertias(const Model<S>& model, Data<S>& data, In<S> q) {
  auto& Ic = data.work.inertia;
  Ic[0] = {};
  columnsInWorldAxes(model, data, q, [&](const auto& joint, const Matrix3<S>& R) {
    const std::size_t i = std::size_t(joint.index);
    multibody_detail::build(
        Ic[i], [&]() __attribute__((always_inline)) {
          return CompositeInertia<S>::rotated(R, model.inertias[i]);
        });
  });
  for (std::size_t i = model.joints.size() - 1; i > 0; --i)
    Ic[std::size_t(model.parents[i])].join(Ic[i], data.work.r[i], data.work.joined[i]);
}

/// The momentum F = I s of a column s = (t, omega) [6] of a motion subspace. Its force is
/// (x, y, z) = m (t + omega x c), its moment (u, v, w) = I_C omega + c x force, initially about the origin of
/// the column's joint. Scalar members stay in registers; a Force would be stored and loaded again.
template <Scalar S>
struct ColumnMomentum {
  S x, y, z, u, v, w;
  /// If rotation is true, s = (0, omega).
  [[gnu::always_inline]] ColumnMomentum(const CompositeInertia<S>& I, const S* s, bool rotation = false) {
    const S a = s[3], b = s[4], c = s[5];
    x = mul_add(b, I.c[2], S(-(c * I.c[1])));
    y = mul_add(c, I.c[0], S(-(a * I.c[2])));
    z = mul_add(a, I.c[1], S(-(b * I.c[0])));
    if (!rotation) x += s[0], y += s[1], z += s[2];
    x *= I.mass, y *= I.mass, z *= I.mass;
    u = mul_add(I.xx, a, mul_add(I.xy, b, S(I.xz * c)));
    v = mul_add(I.xy, a, mul_add(I.yy, b, S(I.yz * c)));
    w = mul_add(I.xz, a, mul_add(I.yz, b, S(I.zz * c)));
    shift(I.c);
  }
  /// Moves the reference point by -d [m]: moment + d x force.
  [[gnu::always_inline]] void shift(const Vector3<S>& d) {
    u += mul_add(d[1], z, S(-(d[2] * y)));
    v += mul_add(d[2], x, S(-(d[0] * z)));
    w += mul_add(d[0], y, S(-(d[1] * x)));
  }
  /// s^T F, given s = (t, omega) [6]; only t [3] for s = (t, 0); only omega [3] for s = (0, omega).
  [[gnu::always_inline]] S project(const S* s) const {
    return projectOnTranslation(s) + projectOnRotation(s + 3);
  }
  [[gnu::always_inline]] S projectOnTranslation(const S* s) const {
    return mul_add(x, s[0], mul_add(y, s[1], S(z * s[2])));
  }
  [[gnu::always_inline]] S projectOnRotation(const S* s) const {
    return mul_add(u, s[0], mul_add(v, s[1], S(w * s[2])));
  }
  Force<S> force() const { return {Vector3<S>(x, y, z), Vector3<S>(u, v, w)}; }
};

/// Row and column k of M. With mimic joints, several columns of motion subspaces belong to one number of v,
/// and their terms are summed. Without them, column m belongs to v[m] alone, and every entry is written once.
/// Entries are written through pointers; M(m, k) and M(k, m) would cost 5 to 10 % of crba's time.
template <bool mimics, Scalar S>
struct RowAndColumn {
  const Model<S>& model;
  MatrixX<S>& M;
  int k;
  S* const column = M.data() + (mimics ? 0 : k * M.rows());
  S* const row = M.data() + (mimics ? 0 : k);

  /// M_mk = M_km = h.
  [[gnu::always_inline]] void set(int m, const S& h) const {
    if constexpr (mimics) {
      const int vk = model.column_to_v[std::size_t(k)], vm = model.column_to_v[std::size_t(m)];
      M(vk, vm) += h;
      if (m != k) M(vm, vk) += h;
    } else {
      column[m] = row[m * M.rows()] = h;
    }
  }
  /// M_kk = h + armature.
  [[gnu::always_inline]] void setDiagonal(const S& h) const {
    set(k, mimics ? h : S(h + model.armature[k]));  // with mimics M already contains the armature
  }
};

/// Sets M_mk = M_km = s_m^T F, F = Ic_j s_k, for the columns m <= k of joint j and all columns m of its
/// ancestors. This is the inner loop of crba. In world axes, F is moved to the parent without a rotation.
/// Products with the zeros in s = (0, omega) of a rotation and in S = [R, 0; 0, R] of a free-flyer are
/// skipped. With compositeInertias it takes 0.4 times as long as the same formulas written with Motion, Force
/// and Inertia in joint frames (gcc 12 -O2, double, free-flyers with 4 and 10 legs of 3 revolute joints).
template <bool rotation, bool mimics, Scalar S>
[[gnu::always_inline]] inline void projectOnSupport(const Model<S>& model, const Data<S>& data, std::size_t j,
                                                    ColumnMomentum<S> F, const RowAndColumn<mimics, S>& M_k) {
  const S* const columns = data.work.S_columns.data();
  const int *const firsts = model.idx_columns.data(), *const counts = model.column_counts.data();
  const int k = M_k.k;
  if constexpr (!rotation)
    for (int m = firsts[j]; m < k; ++m) M_k.set(m, F.project(columns + 6 * m));
  M_k.setDiagonal(rotation ? F.projectOnRotation(columns + 6 * k + 3) : F.project(columns + 6 * k));
  for (std::size_t i = j, p; (p = std::size_t(model.parents[i])) > 0; i = p) {
    F.shift(data.work.r[i]);
    const int first = firsts[p], count = counts[p];
    const S* s = columns + 6 * first;
    if (rotatesAboutAxis<S>(model.joints[p])) {
      M_k.set(first, F.projectOnRotation(s + 3));
    } else if (count == 6) {
      for (int m = first; m < first + 3; ++m, s += 6)
        M_k.set(m, F.projectOnTranslation(s)), M_k.set(m + 3, F.projectOnRotation(s));
    } else {
      for (int m = first; m < first + count; ++m, s += 6) M_k.set(m, F.project(s));
    }
  }
}

/// Calls f(j, k, rotation) for every column k of every joint j's motion subspace, children first; rotation is
/// std::true_type if joint j rotates about an axis.
template <Scalar S, class F>
[[gnu::always_inline]] inline void forEachColumn(const Model<S>& model, F f) {
  for (std::size_t j = model.joints.size() - 1; j > 0; --j) {
    const int first = model.idx_columns[j];
    if (rotatesAboutAxis<S>(model.joints[j]))
      f(j, first, std::true_type());
    else
      for (int k = first; k < first + model.column_counts[j]; ++k) f(j, k, std::false_type());
  }
}

/// Throws SingularInertia if a pivot of the factorization is not above the rounding error of M_kk (`before`).
template <Scalar S>
void checkPivot(const Model<S>& model, int v_index, const S& pivot, const S& before) {
  if (pivot > S(64) * eps<S>() * before) return;
  for (int k = 0; k < model.ncolumns; ++k)
    if (model.column_to_v[std::size_t(k)] == v_index) {
      const int joint = model.column_to_joint[std::size_t(k)];
      throw SingularInertia(model.names[std::size_t(joint)], joint, finite<S>(pivot));
    }
}

/// x -= factor y for the first n numbers, and for those after them up to a multiple of four.
template <Scalar S>
[[gnu::always_inline]] inline void subtractRow(S* x, const S& factor, const S* y, int n) {
  for (int i = 0; i < n; i += 4) Vector4<S>::Map(x + i) -= factor * Vector4<S>::Map(y + i);
}

/// Divides x by d: the first n numbers, and those after them up to a multiple of four.
template <Scalar S>
[[gnu::always_inline]] inline void divideRow(S* x, const S& d, int n) {
  for (int i = 0; i < n; i += 4) Vector4<S>::Map(x + i) /= d;
}

/// Sets data.work.factor = L, lower triangular with M = L^T L. Row k of L is zero off the path of k. The
/// paths of k and of a coordinate i on it begin alike, so that rows are subtracted number by number:
///   L_kk = sqrt(M_kk),  L_k = M_k / L_kk,  M_i -= L_ki L_k for each i on the path of k.
/// Throws SingularInertia. Needs M.
template <Scalar S>
void factorize(const Model<S>& model, Data<S>& data) {
  using std::sqrt;
  const MatrixX<S>& M = data.M();
  const int *const path = data.work.path.data(), *const row = data.work.row.data();
  const int* const depth = data.work.depth.data();
  S* const L = data.work.factor.data();
  for (int k = 0; k < model.nv; ++k)
    for (int t = row[k]; t <= row[k] + depth[k]; ++t) L[t] = M(path[t], k);
  for (int k = model.nv - 1; k >= 0; --k) {
    const int n = depth[k], *const path_k = path + row[k];
    S* const L_k = L + row[k];
    checkPivot<S>(model, k, L_k[n], M(k, k));
    const S root = sqrt(L_k[n]);
    divideRow(L_k, root, n);
    L_k[n] = root;
    for (int t = 0; t < n; ++t) subtractRow(L + row[path_k[t]], L_k[t], L_k, t + 1);
  }
}
/// Replaces x [nv] by M^-1 x, computed with the factor L.
template <Scalar S>
void solve(const Model<S>& model, const Data<S>& data, VectorX<S>& x) {
  const int *const path = data.work.path.data(), *const row = data.work.row.data();
  const S* const L = data.work.factor.data();
  for (int k = model.nv - 1; k >= 0; --k) {
    const int end = row[k] + data.work.depth[std::size_t(k)];
    x[k] /= L[end];
    for (int t = row[k]; t < end; ++t) x[path[t]] -= L[t] * x[k];
  }
  for (int k = 0; k < model.nv; ++k) {
    const int end = row[k] + data.work.depth[std::size_t(k)];
    for (int t = row[k]; t < end; ++t) x[k] -= L[t] * x[path[t]];
    x[k] /= L[end];
  }
}

/// Sets data.work.square = W = L^-1, which has the zeros of L: W_k = (e_k - sum of L_ki W_i) / L_kk over
/// the coordinates i before k on its path. Needs data.work.factor.
template <Scalar S>
void invertFactor(const Model<S>& model, Data<S>& data) {
  const int *const path = data.work.path.data(), *const row = data.work.row.data();
  const S* const L = data.work.factor.data();
  S* const W = data.work.factor_inverse.data();
  for (int k = 0; k < model.nv; ++k) {
    const int n = data.work.depth[std::size_t(k)], *const path_k = path + row[k];
    const S* const L_k = L + row[k];
    S* const W_k = W + row[k];
    for (int t = 0; t < n; ++t) W_k[t] = S(0);
    W_k[n] = S(1);
    for (int t = 0; t < n; ++t) subtractRow(W_k, L_k[t], W + row[path_k[t]], t + 1);
    divideRow(W_k, L_k[n], n + 1);
    for (int t = 0; t <= n; ++t) data.work.square(k, path_k[t]) = W_k[t];
  }
}

/// Four columns of four numbers. They stay in registers: a matrix of 4 x 4 would be stored at every change.
template <Scalar S>
struct Block {
  Vector4<S> a = Vector4<S>::Zero(), b = a, c = a, d = a;

  /// Adds column times row. The row is given as four numbers.
  [[gnu::always_inline]] void add(const S* column, const S& r0, const S& r1, const S& r2, const S& r3) {
    const Vector4<S> x = Vector4<S>::Map(column);
    a += x * r0, b += x * r1, c += x * r2, d += x * r3;
  }
  [[gnu::always_inline]] Eigen::Matrix<S, 4, 4> matrix() const {
    Eigen::Matrix<S, 4, 4> m;
    m.col(0) = a, m.col(1) = b, m.col(2) = c, m.col(3) = d;
    return m;
  }
};

/// Minv = W W^T, W = data.work.square, in blocks of 4 x 4. Column i of W is zero before coordinate i and
/// after last[i], so that a block needs the columns of the common ancestors of its coordinates only: nv^2 d / 2
/// products, d the mean number of common ancestors of two coordinates.
template <Scalar S>
void multiplyFactors(const Model<S>& model, Data<S>& data, MatrixX<S>& Minv) {
  const MatrixX<S>& W = data.work.square;
  const int *const last = data.work.last.data(), nv = model.nv;
  int* const terms = data.work.terms.data();
  for (int c = 0; c < nv; c += 4) {
    int n = 0;
    for (int i = 0; i < std::min(c + 4, nv); ++i)
      if (last[i] >= c) terms[n++] = i;
    for (int r = c; r < nv; r += 4) {
      while (n > 0 && last[terms[n - 1]] < r) --n;
      Block<S> sum;
      for (int t = 0; t < n; ++t) {
        const S* const W_i = W.data() + terms[t] * W.rows();
        sum.add(W_i + r, W_i[c], W_i[c + 1], W_i[c + 2], W_i[c + 3]);
      }
      const Eigen::Matrix<S, 4, 4> block = sum.matrix();
      if (r + 4 <= nv) {
        Minv.template block<4, 4>(c, r) = block.transpose();
        Minv.template block<4, 4>(r, c) = block;
      } else {
        const int rows = nv - r, columns = std::min(4, nv - c);
        Minv.block(c, r, columns, rows) = block.topLeftCorner(rows, columns).transpose();
        Minv.block(r, c, rows, columns) = block.topLeftCorner(rows, columns);
      }
    }
  }
}

}  // namespace algorithms_detail

/// M(q) [nv x nv; kg, kg m, kg m^2], both triangles, symmetric to the last bit, armature on its diagonal.
/// Ic_j = I_j + sum of Ic_c over the children c of j; F = Ic_j s_k; M_mk = s_m^T F for every column m of j
/// and of its ancestors. Throws std::logic_error if Data has no M. Updates liMi, oMi, M. q [nq].
template <Scalar S>
const MatrixX<S>& crba(const Model<S>& model, Data<S>& data, In<S> q) {
  using namespace algorithms_detail;
  data.require(Dense::Mass, "crba");
  compositeInertias(model, data, q);
  MatrixX<S>& M = data.M.write(Level::Position);
  const auto fill = [&](auto mimics) {
    if constexpr (mimics) M = model.armature.asDiagonal();
    forEachColumn(
        model, [&](std::size_t j, int k, auto rotation) __attribute__((always_inline)) {
          const ColumnMomentum<S> F(data.work.inertia[j], data.work.S_columns.data() + 6 * k, rotation);
          // M_mk = M_km = s_m^T F; entries between branches keep their initial value 0.
          projectOnSupport<rotation>(model, data, j, F, RowAndColumn<mimics, S>{model, M, k});
        });
  };
  if (model.has_mimics)
    fill(std::true_type());
  else
    fill(std::false_type());
  return M;
}

/// M(q)^-1 [nv x nv], both triangles, symmetric to the last bit. Throws SingularInertia. Updates liMi, oMi,
/// M, Minv. q [nq].
template <Scalar S>
const MatrixX<S>& computeMinverse(const Model<S>& model, Data<S>& data, In<S> q) {
  using namespace algorithms_detail;
  crba(model, data, q);
  factorize(model, data);
  invertFactor(model, data);
  auto& Minv = data.Minv.write(Level::Position);
  multiplyFactors(model, data, Minv);
  return Minv;
}

// instantiations_*.cpp instantiates these for float and double.
extern template decltype(crba<float>) crba<float>;
extern template decltype(computeMinverse<float>) computeMinverse<float>;
extern template decltype(crba<double>) crba<double>;
extern template decltype(computeMinverse<double>) computeMinverse<double>;

}  // namespace liecheck

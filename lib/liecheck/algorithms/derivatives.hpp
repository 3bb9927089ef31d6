#pragma once
// First derivatives of inverse and forward dynamics with respect to tangent increments of q and to v.
//
// All quantities are in world axes at one point O. An increment of joint j along column s_k of its motion
// subspace moves the subtree of j (its body and all descendants) as one rigid body. With p = parent(j), the
// velocity and acceleration of every body i of the subtree change, in addition to that rigid motion, by
//
//   for q_k:  dv_i = w,  da_i = z + w x v_i,  w = v_p x s,  z = a_p x s + v_p x w
//   for v_k:  dv_i = s,  da_i = y + s x v_i,  y = (v_j + v_p) x s
//   df_i = I_i (z or y) + B_i (w or s),      B x = -I (v x x) + x x* (I v) + v x* (I x)
//
// For q_k the force F_j through joint j also moves with the subtree, which adds the change s x* F_j. B needs
// only the rate of I and the momentum, as class MovingInertia states; both are summed along the tree. Work:
// a constant for each column, for each column and each of its ancestors, and for each body.
// Carpentier & Mansard (2018); Singh, Russell & Wensing (2022).

#include <liecheck/algorithms/aba.hpp>

namespace liecheck {

namespace algorithms_detail {

/// A column k of motion subspaces with its rates, 24 numbers: (z_i, y_i) for i < 6, then (w_i, s_i). Numbers
/// that are multiplied by the same factor are neighbours, so that two products take one instruction.
template <Scalar S>
struct RateColumn {
  S* numbers;

  [[gnu::always_inline]] Motion<S> get(int first) const {
    const S* const x = numbers + first;
    return {Vector3<S>(x[0], x[2], x[4]), Vector3<S>(x[6], x[8], x[10])};
  }
  [[gnu::always_inline]] void set(int first, const Motion<S>& V) const {
    for (int i = 0; i < 3; ++i)
      numbers[first + 2 * i] = V.linear()[i], numbers[first + 6 + 2 * i] = V.angular()[i];
  }
  static constexpr int z = 0, y = 1, w = 12, s = 13;
};

/// The forces of a column k, as two products with every column m of the supporting joints.
template <Scalar S>
struct ColumnForces {
  Eigen::Matrix<S, 4, 6> up;  ///< row 0: force by q_k; row 1: force by v_k; row 2: I s; row 3: 0
  S Is[6], Bs[3];             ///< I s, and the moment of B^T s

  /// The rows times s_m.
  [[gnu::always_inline]] Vector4<S> project(const RateColumn<S>& m) const {
    const S* const s = m.numbers + RateColumn<S>::s;
    Vector4<S> sum = up.col(0) * s[0];
    for (int i = 1; i < 6; ++i) sum += up.col(i) * s[2 * i];
    return sum;
  }
  /// (z . I s + w . B^T s, y . I s + s . B^T s), with z, w, y, s of column m.
  [[gnu::always_inline]] Eigen::Matrix<S, 2, 1> transposed(const RateColumn<S>& m) const {
    using Pair = Eigen::Matrix<S, 2, 1>;
    Pair sum = Pair::Map(m.numbers) * Is[0];
    for (int i = 1; i < 6; ++i) sum += Pair::Map(m.numbers + 2 * i) * Is[i];
    for (int i = 0; i < 3; ++i) sum += Pair::Map(m.numbers + RateColumn<S>::w + 6 + 2 * i) * Bs[i];
    return sum;
  }
  void setFirst(const Force<S>& F) {
    for (int i = 0; i < 3; ++i) up(0, i) = F.linear()[i], up(0, 3 + i) = F.angular()[i];
  }
};

/// Computes s, w, y, z of every column, and MovingInertia and force of every body, about the origin O of the
/// joint at the root of its branch. work.r[i], so far the vector from joint p, becomes the vector from O. It is summed along
/// the tree, so that no digits are lost far from the world's origin or from another root.
/// With dynamics = false, MovingInertia and force are left as they are.
template <bool dynamics = true, Scalar S>
void ratesOfColumns(const Model<S>& model, Data<S>& data, const VectorX<S>& v, const VectorX<S>& a,
                    const External<S>& fext, const Vector3<S>& gravity) {
  auto& work = data.work;
  const auto& oMi = data.oMi();
  auto &V = work.bias, &A = work.gravitated;
  V[0] = Motion<S>::Zero();
  A[0] = Motion<S>(Vector3<S>(-gravity), Vector3<S>::Zero());
  for (std::size_t i = 1; i < model.joints.size(); ++i) {
    const std::size_t p = std::size_t(model.parents[i]);
    work.r[i] = p == 0 ? Vector3<S>(Vector3<S>::Zero()) : added(work.r[p], work.r[i]);
    const Vector3<S>& r = work.r[i];
    Motion<S> relative = Motion<S>::Zero(), driven = Motion<S>::Zero();
    const int begin = model.idx_columns[i], end = begin + model.column_counts[i];
    for (int k = begin; k < end; ++k) {
      const RateColumn<S> column_k{work.rates.data() + 24 * k};
      const Motion<S> s = shifted(column(work.S_columns, k), Vector3<S>(-r[0], -r[1], -r[2]));
      const Motion<S> w = crossed(V[p], s);
      column_k.set(RateColumn<S>::s, s), column_k.set(RateColumn<S>::w, w);
      column_k.set(RateColumn<S>::z, crossed(A[p], s) + crossed(V[p], w));
      const int vk = model.column_to_v[std::size_t(k)];
      relative = relative + s * v[vk], driven = driven + s * a[vk];
    }
    V[i] = V[p] + relative;
    A[i] = A[p] + driven + crossed(V[i], relative);
    for (int k = begin; k < end; ++k) {
      const RateColumn<S> column_k{work.rates.data() + 24 * k};
      column_k.set(RateColumn<S>::y, crossed(Motion<S>(V[i] + V[p]), column_k.get(RateColumn<S>::s)));
    }
    if constexpr (!dynamics) continue;
    const Matrix3<S>& R = oMi[i].rotation();
    auto body = CompositeInertia<S>::rotated(R, model.inertias[i]);
    body.c = added(body.c, r);
    MovingInertia<S>& moving = work.moving[i];
    moving = MovingInertia<S>(body, V[i]);
    const Vector6<S> A_i = A[i].to_vector();
    work.force[i] = ColumnMomentum<S>(body, A_i.data()).force() + crossed(V[i], Force<S>(moving.f, moving.n));
    if (!fext.empty()) work.force[i] = work.force[i] - SE3<S>(R, r).act(fext[i]);
  }
}

/// Sets dtau_dq, dtau_dv and, unless it is null, M, after columnsInWorldAxes.
template <Scalar S>
void inverseDynamicsDerivatives(const Model<S>& model, Data<S>& data, const VectorX<S>& v,
                                const VectorX<S>& a, const External<S>& fext, MatrixX<S>* M) {
  ratesOfColumns(model, data, v, a, fext, model.gravity);
  auto& work = data.work;
  MatrixX<S>& dq = data.dtau_dq.write(Level::Acceleration);
  MatrixX<S>& dv = data.dtau_dv.write(Level::Velocity);
  const bool mimics = model.has_mimics;  // then several columns contribute to one entry
  if (mimics) dq.setZero(), dv.setZero();
  if (mimics && M) M->setZero();
  const auto put = [mimics](S & entry, const S& x) __attribute__((always_inline)) {
    entry = mimics ? S(entry + x) : x;
  };
  for (std::size_t j = model.joints.size() - 1; j > 0; --j) {
    const MovingInertia<S>& moving = work.moving[j];
    const int begin = model.idx_columns[j], end = begin + model.column_counts[j];
    for (int k = begin; k < end; ++k) {
      const RateColumn<S> column_k{work.rates.data() + 24 * k};
      const int vk = model.column_to_v[std::size_t(k)];
      const Motion<S> s = column_k.get(RateColumn<S>::s);
      const Force<S> by_q = moving.force(column_k.get(RateColumn<S>::z), column_k.get(RateColumn<S>::w));
      const Force<S> by_v = moving.force(column_k.get(RateColumn<S>::y), s), I_s = moving.momentum(s);
      const Vector3<S> B_s = moving.transposed(s);
      ColumnForces<S> forces;
      forces.setFirst(by_q);
      for (int i = 0; i < 3; ++i) {
        forces.up(1, i) = by_v.linear()[i], forces.up(1, 3 + i) = by_v.angular()[i];
        forces.up(2, i) = forces.Is[i] = I_s.linear()[i];
        forces.up(2, 3 + i) = forces.Is[3 + i] = I_s.angular()[i];
        forces.up(3, i) = forces.up(3, 3 + i) = S(0), forces.Bs[i] = B_s[i];
      }
      for (int m = begin; m < end; ++m) {
        const int vm = model.column_to_v[std::size_t(m)];
        const Vector4<S> up = forces.project({work.rates.data() + 24 * m});
        put(dq(vm, vk), up[0]), put(dv(vm, vk), up[1]);
        if (M) put((*M)(vm, vk), up[2]);
      }
      forces.setFirst(by_q + crossed(s, work.force[j]));
      for (std::size_t i = std::size_t(model.parents[j]); i > 0; i = std::size_t(model.parents[i])) {
        const int first = model.idx_columns[i], last = first + model.column_counts[i];
        for (int m = first; m < last; ++m) {
          const int vm = model.column_to_v[std::size_t(m)];
          const RateColumn<S> column_m{work.rates.data() + 24 * m};
          const Vector4<S> up = forces.project(column_m);
          const Eigen::Matrix<S, 2, 1> transposed = forces.transposed(column_m);
          put(dq(vm, vk), up[0]), put(dv(vm, vk), up[1]);
          put(dq(vk, vm), transposed[0]), put(dv(vk, vm), transposed[1]);
          if (M) put((*M)(vm, vk), up[2]), put((*M)(vk, vm), up[2]);
        }
      }
    }
    const std::size_t p = std::size_t(model.parents[j]);
    if (p == 0) continue;
    work.moving[p] += moving;
    work.force[p] = work.force[p] + work.force[j];
  }
  if (M) M->diagonal() += model.armature;
}

/// x = -Minv T and y = -Minv U for T = dtau_dq and U = dtau_dv, in blocks of 4 x 4: two columns of each. Row i
/// of T and U contributes to column j only if one of the coordinates i and j is on the path of the other.
template <Scalar S>
void multiplyByInverse(const Model<S>& model, Data<S>& data, MatrixX<S>& x, MatrixX<S>& y) {
  auto& work = data.work;
  const int nv = model.nv, *const last = work.last.data();
  int* const terms = work.terms.data();
  work.inverse.topLeftCorner(nv, nv) = data.Minv();
  const auto put = [nv](MatrixX<S> & to, int r, int j, const Vector4<S>& sum) __attribute__((always_inline)) {
    S* const entries = to.data() + j * to.rows() + r;
    if (r + 4 <= nv)
      Vector4<S>::Map(entries) = -sum;
    else
      for (int i = 0; i < nv - r; ++i) entries[i] = -sum[i];
  };
  for (int j = 0; j < nv; j += 2) {
    const int j1 = std::min(j + 1, nv - 1);
    const S *const T = data.dtau_dq().data() + j * nv, *const T1 = data.dtau_dq().data() + j1 * nv;
    const S *const U = data.dtau_dv().data() + j * nv, *const U1 = data.dtau_dv().data() + j1 * nv;
    int n = 0;
    for (int i = 0; i <= std::max(last[j], last[j1]); ++i)
      if (i >= j || last[i] >= j) terms[n++] = i;
    for (int r = 0; r < nv; r += 4) {
      Block<S> sum;
      for (int t = 0; t < n; ++t) {
        const int i = terms[t];
        sum.add(work.inverse.data() + i * work.inverse.rows() + r, T[i], T1[i], U[i], U1[i]);
      }
      put(x, r, j, sum.a), put(x, r, j1, sum.b), put(y, r, j, sum.c), put(y, r, j1, sum.d);
    }
  }
}

}  // namespace algorithms_detail

/// dtau/dq, dtau/dv and dtau/da = M [nv x nv] of rnea(q, v, a, fext). Every fext moves with its body.
/// Updates liMi, oMi, M, dtau_dq, dtau_dv.
template <Scalar S>
void computeRNEADerivatives(const Model<S>& model, Data<S>& data, In<S> q, In<S> v, In<S> a,
                            External<S> fext = {}) {
  using namespace algorithms_detail;
  data.require(Dense::Derivatives, "computeRNEADerivatives");
  checkForces<S>(model, fext);
  columnsInWorldAxes(model, data, q);
  data.begin(model, q, v, a);
  inverseDynamicsDerivatives<S>(model, data, v, a, fext, &data.M.write(Level::Position));
}

/// dtau/dq [nv x nv] of computeStaticTorque. Every fext moves with its body. Updates liMi, oMi, dtau_dq.
/// At rest y = w = 0 and z = (omega_s x g, 0), so that of the inertia of a subtree only the mass and the first moment appear.
template <Scalar S>
const MatrixX<S>& computeStaticTorqueDerivatives(const Model<S>& model, Data<S>& data, In<S> q,
                                                 External<S> fext = {}) {
  using namespace algorithms_detail;
  data.require(Dense::Derivatives, "computeStaticTorqueDerivatives");
  checkForces<S>(model, fext);
  columnsInWorldAxes(model, data, q);
  const VectorX<S> still = VectorX<S>::Zero(model.nv);
  data.begin(model, q, still, still);
  auto& work = data.work;
  const auto& oMi = data.oMi();
  const Vector3<S> up = -model.gravity;
  S *const columns = work.S_columns.data(), *const rates = work.U.data();  // s about the root's origin, and z
  for (std::size_t i = 1; i < model.joints.size(); ++i) {
    const std::size_t p = std::size_t(model.parents[i]);
    work.r[i] = p == 0 ? Vector3<S>(Vector3<S>::Zero()) : added(work.r[p], work.r[i]);
    const Vector3<S>& r = work.r[i];
    const Matrix3<S>& R = oMi[i].rotation();
    const S& mass = work.moving[i].mass = model.inertias[i].mass();
    const Vector3<S> c = added(product<S>(R, model.inertias[i].lever()), r);
    const Vector3<S>& h = work.moving[i].h = each<S>([&](int k) { return S(mass * c[k]); });
    work.force[i] = Force<S>(each<S>([&](int k) { return S(mass * up[k]); }), cross<S>(h, up));
    if (!fext.empty()) work.force[i] = work.force[i] - act(SE3<S>(R, r), fext[i]);
    for (int k = model.idx_columns[i]; k < model.idx_columns[i] + model.column_counts[i]; ++k) {
      S *const s = columns + 6 * k, *const z = rates + 6 * k;
      const Vector3<S> w(s[3], s[4], s[5]), u = cross<S>(r, w), z_k = cross<S>(up, w);
      for (int n = 0; n < 3; ++n) s[n] += u[n], z[n] = z_k[n];
    }
  }
  MatrixX<S>& dq = data.dtau_dq.write(Level::Acceleration);
  const bool mimics = model.has_mimics;
  if (mimics) dq.setZero();
  const auto put = [mimics](S & entry, const S& x) __attribute__((always_inline)) {
    entry = mimics ? S(entry + x) : x;
  };
  const auto vector = [](const S* x) __attribute__((always_inline)) {
    return Vector3<S>(x[0], x[1], x[2]);
  };
  for (std::size_t j = model.joints.size() - 1; j > 0; --j) {
    const S& mass = work.moving[j].mass;
    const Vector3<S>& h = work.moving[j].h;
    const Force<S>& F = work.force[j];
    const int begin = model.idx_columns[j], end = begin + model.column_counts[j];
    for (int k = begin; k < end; ++k) {
      const int vk = model.column_to_v[std::size_t(k)];
      const Vector3<S> u = vector(columns + 6 * k), w = vector(columns + 6 * k + 3),
                       z = vector(rates + 6 * k);
      Vector3<S> l = each<S>([&](int n) { return S(mass * z[n]); }), moment = cross<S>(h, z);
      const Vector3<S> w_h = cross<S>(w, h),
                       I_s = each<S>([&](int n) { return mul_add(mass, u[n], w_h[n]); });
      const auto project = [&](const S* s) __attribute__((always_inline)) {
        return S(dot<S>(l, vector(s)) + dot<S>(moment, vector(s + 3)));
      };
      for (int m = begin; m < end; ++m)
        put(dq(model.column_to_v[std::size_t(m)], vk), project(columns + 6 * m));
      l = added(l, cross<S>(w, F.linear()));
      moment = added(moment, added(cross<S>(w, F.angular()), cross<S>(u, F.linear())));
      for (std::size_t i = std::size_t(model.parents[j]); i > 0; i = std::size_t(model.parents[i]))
        for (int m = model.idx_columns[i]; m < model.idx_columns[i] + model.column_counts[i]; ++m) {
          const int vm = model.column_to_v[std::size_t(m)];
          put(dq(vm, vk), project(columns + 6 * m)), put(dq(vk, vm), dot<S>(I_s, vector(rates + 6 * m)));
        }
    }
    const std::size_t p = std::size_t(model.parents[j]);
    if (p == 0) continue;
    work.moving[p].mass += mass, work.moving[p].h = added(work.moving[p].h, h);
    work.force[p] = work.force[p] + F;
  }
  return dq;
}

/// dqdd/dq, dqdd/dv and dqdd/dtau = M^-1 [nv x nv] of aba(q, v, tau, fext). The first two are -M^-1 times
/// dtau/dq and dtau/dv of rnea at a = qdd. Throws SingularInertia. Updates liMi, oMi, ddq, M, Minv, dtau_dq,
/// dtau_dv, ddq_dq, ddq_dv.
template <Scalar S>
void computeABADerivatives(const Model<S>& model, Data<S>& data, In<S> q, In<S> v, In<S> tau,
                           External<S> fext = {}) {
  using namespace algorithms_detail;
  data.require(Dense::Derivatives, "computeABADerivatives");
  multibody_detail::checkSize(tau.size(), model.nv, "tau", "nv");
  checkForces<S>(model, fext);
  computeMinverse(model, data, q);  // with the poses and the columns that the other steps need
  if (model.has_mimics)
    denseForwardDynamics(model, data, q, v, tau, fext);
  else
    velocitiesInWorldAxes(model, data, v), articulatedBodies(model, data, tau, fext, false);
  data.begin(model, q, v, data.ddq.scratch());
  const VectorX<S>& ddq = data.ddq.write(Level::Velocity);
  inverseDynamicsDerivatives<S>(model, data, v, ddq, fext, nullptr);
  multiplyByInverse(model, data, data.ddq_dq.write(Level::Acceleration), data.ddq_dv.write(Level::Velocity));
}

// instantiations_*.cpp instantiates these for float and double.
extern template decltype(computeRNEADerivatives<float>) computeRNEADerivatives<float>;
extern template decltype(computeABADerivatives<float>) computeABADerivatives<float>;
extern template decltype(computeRNEADerivatives<double>) computeRNEADerivatives<double>;
extern template decltype(computeABADerivatives<double>) computeABADerivatives<double>;

}  // namespace liecheck

#pragma once
// The Coriolis matrix C(q, v): C v = h(q, v) - g(q), with the Christoffel symbols' property M' = C + C^T, so that
// M' - 2 C is skew. In the notation of derivatives.hpp, with s' = v_i x s of the joint's own velocity, column k of joint j
// and a column m of a supporting joint
//
//   C_mk = s_m . (I s_k' + B s_k / 2),   C_km = s_m' . I s_k + s_m . B^T s_k / 2
//
// I and B those of the subtree of j. Source: Echeandia & Wensing 2021, algorithm 1.

#include <liecheck/algorithms/derivatives.hpp>

namespace liecheck {

/// C [nv x nv]. Updates liMi, oMi, C. q [nq], v [nv]. Armatures are constant and add nothing.
template <Scalar S>
const MatrixX<S>& computeCoriolisMatrix(const Model<S>& model, Data<S>& data, In<S> q, In<S> v) {
  using namespace algorithms_detail;
  data.require(Dense::Derivatives, "computeCoriolisMatrix");
  columnsInWorldAxes(model, data, q);
  data.begin(model, q, v);
  const VectorX<S> at_rest = VectorX<S>::Zero(model.nv), speed = v;
  ratesOfColumns(model, data, speed, at_rest, External<S>(), Vector3<S>(Vector3<S>::Zero()));
  auto& work = data.work;
  MatrixX<S>& C = data.C.write(Level::Velocity);
  C.setZero();
  const S half = S(1) / S(2);
  for (std::size_t j = model.joints.size() - 1; j > 0; --j) {
    const MovingInertia<S>& moving = work.moving[j];
    const int begin = model.idx_columns[j], end = begin + model.column_counts[j];
    for (int k = begin; k < end; ++k) {
      const RateColumn<S> column_k{work.rates.data() + 24 * k};
      const int vk = model.column_to_v[std::size_t(k)];
      const Motion<S> s = column_k.get(RateColumn<S>::s),
                      s_rate = column_k.get(RateColumn<S>::y) - column_k.get(RateColumn<S>::w);
      const Force<S> up = moving.force(s_rate, s * half), I_s = moving.momentum(s);
      const Vector3<S> B_s = half * moving.transposed(s);
      const auto column_of = [&](int m) { return RateColumn<S>{work.rates.data() + 24 * m}; };
      for (int m = begin; m < end; ++m)
        C(model.column_to_v[std::size_t(m)], vk) += column_of(m).get(RateColumn<S>::s).dot(up);
      for (std::size_t i = std::size_t(model.parents[j]); i > 0; i = std::size_t(model.parents[i])) {
        const int first = model.idx_columns[i], last = first + model.column_counts[i];
        for (int m = first; m < last; ++m) {
          const RateColumn<S> column_m = column_of(m);
          const int vm = model.column_to_v[std::size_t(m)];
          const Motion<S> s_m = column_m.get(RateColumn<S>::s),
                          rate_m = column_m.get(RateColumn<S>::y) - column_m.get(RateColumn<S>::w);
          C(vm, vk) += s_m.dot(up);
          C(vk, vm) += rate_m.dot(I_s) + s_m.angular().dot(B_s);
        }
      }
    }
    if (const std::size_t p = std::size_t(model.parents[j]); p > 0) work.moving[p] += moving;
  }
  return C;
}

}  // namespace liecheck

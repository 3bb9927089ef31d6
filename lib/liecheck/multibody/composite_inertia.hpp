#pragma once
// The inertia of rigidly joined bodies, summed along a tree: mass [kg], centre of mass c [m] and the six
// numbers of I_C [kg m^2], all in one frame's axes. The formulas are those of spatial/inertia.hpp. This class
// is faster, since it holds scalars and caches mass ratios.

#include <liecheck/spatial/se3.hpp>

namespace liecheck {

/// m1 + m2, m1/(m1 + m2), m2/(m1 + m2) and m1 m2/(m1 + m2) of two masses [kg]; all 0 if both are 0. They are
/// recomputed only if a mass has changed, since two divisions per joint would delay the whole recursion.
template <Scalar S>
struct JoinedMass {
  S first = S(0), second = S(0);
  S total = S(0), first_share = S(0), second_share = S(0), reduced = S(0);

  [[gnu::always_inline]] void join(const S& m1, const S& m2) {
    if (m1 == first && m2 == second) [[likely]]
      return;
    first = m1, second = m2, total = m1 + m2;
    first_share = total > S(0) ? S(m1 / total) : S(0), second_share = total > S(0) ? S(m2 / total) : S(0);
    reduced = m1 * second_share;
  }
};

template <Scalar S>
struct CompositeInertia {
  S mass = S(0);
  Vector3<S> c = Vector3<S>::Zero();
  S xx = S(0), xy = S(0), xz = S(0), yy = S(0), yz = S(0), zz = S(0);

  /// The inertia of a body in axes rotated by R: c = R c_B, I_C = R I_C,B R^T.
  [[gnu::always_inline]] static CompositeInertia rotated(const Matrix3<S>& R, const Inertia<S>& I) {
    const Matrix3<S> RI = product<S>(R, I.inertia());
    const auto entry = [&](int i, int j) __attribute__((always_inline)) {
      return mul_add(RI(i, 0), R(j, 0), mul_add(RI(i, 1), R(j, 1), S(RI(i, 2) * R(j, 2))));
    };
    return {
        I.mass(),   product<S>(R, I.lever()), entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2),
        entry(2, 2)};
  }

  /// Adds another inertia whose origin is at r [m], in the same axes; `joined` caches the pair's mass ratios.
  ///   t = m_2/(m + m_2),  d = c_2 + r - c,  c = (1 - t) c + t (c_2 + r),  I_C += I_2 + m t (|d|^2 1 - d d^T)
  /// c += t d would be less accurate: the rounding error of d is large if a light body is far away.
  [[gnu::always_inline]] void join(const CompositeInertia& other, const Vector3<S>& r,
                                   JoinedMass<S>& joined) {
    joined.join(mass, other.mass);
    const S &m = joined.reduced, &share = joined.first_share, &other_share = joined.second_share;
    const S other_c[3] = {other.c[0] + r[0], other.c[1] + r[1], other.c[2] + r[2]};
    const S x = other_c[0] - c[0], y = other_c[1] - c[1], z = other_c[2] - c[2];
    const S mx = m * x, my = m * y, mz = m * z;
    mass = joined.total;
    for (int i = 0; i < 3; ++i) c[i] = mul_add(share, c[i], S(other_share * other_c[i]));
    xx += mul_add(my, y, mul_add(mz, z, other.xx));
    yy += mul_add(mx, x, mul_add(mz, z, other.yy));
    zz += mul_add(mx, x, mul_add(my, y, other.zz));
    xy += mul_add(S(-mx), y, other.xy), xz += mul_add(S(-mx), z, other.xz);
    yz += mul_add(S(-my), z, other.yz);
  }
};

}  // namespace liecheck

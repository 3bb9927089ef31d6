#pragma once
// The inertia of several bodies rigidly joined, to be summed along a tree: mass [kg], centre of mass c [m] and the
// six numbers of I_C [kg m^2], all in one frame's axes. What spatial/inertia.hpp says once a body, this does once a
// joint and state, in scalars.

#include <liecheck/spatial/se3.hpp>

namespace liecheck {

/// Two masses m1, m2 [kg] as one: m1 + m2, each one's share of it, and m1 m2/(m1 + m2); all 0 where there is no mass.
/// Kept from state to state, and divided anew only where a mass is another than before: two divisions a joint hold up the
/// whole chain.
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

  /// A body's, in axes turned by R: c = R c_B, I_C = R I_C,B R^T.
  [[gnu::always_inline]] static CompositeInertia turned(const Matrix3<S>& R, const Inertia<S>& I) {
    const Matrix3<S> RI = product<S>(R, I.inertia());
    const auto entry = [&](int i, int j) __attribute__((always_inline)) {
      return mul_add(RI(i, 0), R(j, 0), mul_add(RI(i, 1), R(j, 1), S(RI(i, 2) * R(j, 2))));
    };
    return {
        I.mass(),   product<S>(R, I.lever()), entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2),
        entry(2, 2)};
  }

  /// Adds another whose frame stands r [m] away, in the same axes; `joined` keeps what the masses make. With
  /// t = m_2/(m + m_2), d = c_2 + r - c,  c = (1 - t) c + t (c_2 + r),  I_C += I_2 + m t (|d|^2 1 - d d^T)  (parallel
  /// axes, once). Not c += t d: that leaves a heavy second body with the rounding errors of a light first one's distance.
  [[gnu::always_inline]] void join(const CompositeInertia& other, const Vector3<S>& r,
                                   JoinedMass<S>& joined) {
    joined.join(mass, other.mass);
    const S &m = joined.reduced, &rest = joined.first_share, &share = joined.second_share;
    const S there[3] = {other.c[0] + r[0], other.c[1] + r[1], other.c[2] + r[2]};
    const S x = there[0] - c[0], y = there[1] - c[1], z = there[2] - c[2];
    const S mx = m * x, my = m * y, mz = m * z;
    mass = joined.total;
    for (int i = 0; i < 3; ++i) c[i] = mul_add(rest, c[i], S(share * there[i]));
    xx += mul_add(my, y, mul_add(mz, z, other.xx));
    yy += mul_add(mx, x, mul_add(mz, z, other.yy));
    zz += mul_add(mx, x, mul_add(my, y, other.zz));
    xy += mul_add(S(-mx), y, other.xy), xz += mul_add(S(-mx), z, other.xz);
    yz += mul_add(S(-my), z, other.yz);
  }
};

}  // namespace liecheck

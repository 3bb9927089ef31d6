#pragma once
// CompositeInertia: the inertia of rigidly joined bodies, summed along a tree: mass [kg], centre of mass c [m]
// and the six numbers of I_C [kg m^2], all in one frame's axes. The formulas are those of spatial/inertia.hpp.
// This class is faster, since it holds scalars and caches mass ratios.
//
// MovingInertia: the inertia and the momentum of moving bodies about one fixed point.

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
    // Number by number: pairs as in Symmetric3::rotated would stall where aba copies them (gcc -O2).
    const Matrix3<S> RI = product<S>(R, I.inertia());
    const auto entry = [&](int i, int j) __attribute__((always_inline)) {
      return mul_add(RI(i, 0), R(j, 0), mul_add(RI(i, 1), R(j, 1), S(RI(i, 2) * R(j, 2))));
    };
    return {
        I.mass(),   product<S>(R, I.lever()), entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2),
        entry(2, 2)};
  }

  /// Adds the mass and the centre of another inertia, as join, and leaves I_C.
  [[gnu::always_inline]] void joinCentre(const CompositeInertia& other, const Vector3<S>& r,
                                         JoinedMass<S>& joined) {
    joined.join(mass, other.mass);
    mass = joined.total;
    for (int i = 0; i < 3; ++i)
      c[i] = mul_add(joined.first_share, c[i], S(joined.second_share * S(other.c[i] + r[i])));
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

/// The sum over bodies that move with their own velocities, about a fixed point O in fixed axes: mass m [kg],
/// first moment h = m c [kg m], inertia I [kg m^2] and its rate [kg m^2/s], momentum f [N s] and n [N m s].
/// B x is the rate of the force of the bodies if their velocities change by x, as derivatives.hpp explains:
///   I x = (m x_u + x_w x h, I x_w + h x x_u)        B x = (-2 f x x_w, I' x_w - n x x_w)
template <Scalar S>
struct MovingInertia {
  S mass = S(0);
  Vector3<S> h = Vector3<S>::Zero(), f = h, n = h;
  Symmetric3<S> inertia, rate;

  /// One body with velocity V at O; the vector c to its centre of mass begins at O.
  ///   f = m (u + w x c),  n = I_C w + c x f,  I = I_C + m (|c|^2 1 - c c^T),
  ///   I' = [w] I_C - I_C [w] + 2 (c . f) 1 - c f^T - f c^T
  [[gnu::always_inline]] MovingInertia(const CompositeInertia<S>& body, const Motion<S>& V)
      : mass(body.mass),
        h(each<S>([&](int i) { return S(body.mass * body.c[i]); })),
        inertia{body.xx, body.xy, body.xz, body.yy, body.yz, body.zz},
        rate(Symmetric3<S>::turning(inertia, V.angular())) {
    const Vector3<S>& c = body.c;
    const Vector3<S> moved = cross<S>(V.angular(), c), turned = inertia * V.angular();
    f = each<S>([&](int i) { return S(mass * (V.linear()[i] + moved[i])); });
    const Vector3<S> c_f = cross<S>(c, f);
    n = each<S>([&](int i) { return S(turned[i] + c_f[i]); });
    rate.addPair(c, f, S(1));
    inertia.addPair(c, h, S(1) / S(2));
  }
  MovingInertia() = default;

  /// I [6 x 6].
  [[gnu::always_inline]] Matrix6<S> matrix() const {
    Matrix6<S> m;
    m(0, 0) = m(1, 1) = m(2, 2) = mass;
    m(0, 1) = m(0, 2) = m(1, 0) = m(1, 2) = m(2, 0) = m(2, 1) = S(0);
    m(0, 3) = m(1, 4) = m(2, 5) = m(3, 0) = m(4, 1) = m(5, 2) = S(0);
    m(0, 4) = m(4, 0) = h[2], m(0, 5) = m(5, 0) = -h[1], m(1, 5) = m(5, 1) = h[0];
    m(1, 3) = m(3, 1) = -h[2], m(2, 3) = m(3, 2) = h[1], m(2, 4) = m(4, 2) = -h[0];
    m(3, 3) = inertia.xx, m(4, 4) = inertia.yy, m(5, 5) = inertia.zz;
    m(3, 4) = m(4, 3) = inertia.xy, m(3, 5) = m(5, 3) = inertia.xz, m(4, 5) = m(5, 4) = inertia.yz;
    return m;
  }
  /// I x.
  [[gnu::always_inline]] Force<S> momentum(const Motion<S>& x) const {
    const Vector3<S> w_h = cross<S>(x.angular(), h), h_u = cross<S>(h, x.linear()),
                     turned = inertia * x.angular();
    return {each<S>([&](int i) { return mul_add(mass, x.linear()[i], w_h[i]); }),
            each<S>([&](int i) { return S(turned[i] + h_u[i]); })};
  }
  /// I x + B y.
  [[gnu::always_inline]] Force<S> force(const Motion<S>& x, const Motion<S>& y) const {
    const Force<S> I_x = momentum(x);
    const Vector3<S> f_w = cross<S>(f, y.angular()), n_w = cross<S>(n, y.angular()),
                     turned = rate * y.angular();
    return {each<S>([&](int i) { return mul_add(S(-2), f_w[i], I_x.linear()[i]); }),
            each<S>([&](int i) { return S(I_x.angular()[i] + S(turned[i] - n_w[i])); })};
  }
  /// The moment of B^T x; its force is 0.
  [[gnu::always_inline]] Vector3<S> transposed(const Motion<S>& x) const {
    const Vector3<S> f_u = cross<S>(f, x.linear()), n_w = cross<S>(n, x.angular()),
                     turned = rate * x.angular();
    return each<S>([&](int i) { return mul_add(S(2), f_u[i], S(turned[i] + n_w[i])); });
  }

  [[gnu::always_inline]] void operator+=(const MovingInertia& o) {
    mass += o.mass, inertia += o.inertia, rate += o.rate;
    for (int i = 0; i < 3; ++i) h[i] += o.h[i], f[i] += o.f[i], n[i] += o.n[i];
  }
};

/// Bounds the inertia of all bodies of a subtree about its origin, however they are turned: trace + sum m l^2, with l the length
/// of the way to a body's centre of mass, |x| + |y| + |z| of each part.
template <Scalar S>
struct InertiaBound {
  S mass = S(0), trace = S(0);     ///< sums of the masses [kg] and of the traces of I_C [kg m^2]
  S moment = S(0), square = S(0);  ///< sums of m l [kg m] and of m l^2 [kg m^2]

  explicit InertiaBound(const CompositeInertia<S>& body)
      : mass(body.mass), trace(S(body.xx + body.yy) + body.zz) {
    const S l = length(body.c);
    moment = mass * l, square = moment * l;
  }
  InertiaBound() = default;

  /// Adds a subtree whose origin is at r [m].
  [[gnu::always_inline]] void join(const InertiaBound& other, const Vector3<S>& r) {
    const S l = length(r), more = other.mass * l;
    square += S(other.square + S(l * S(S(S(2) * other.moment) + more)));
    moment += S(other.moment + more);
    mass += other.mass, trace += other.trace;
  }

 private:
  static S length(const Vector3<S>& r) {
    using std::abs;
    return S(S(abs(r[0])) + S(abs(r[1]))) + S(abs(r[2]));
  }
};

}  // namespace liecheck

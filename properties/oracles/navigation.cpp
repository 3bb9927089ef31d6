#include <oracles/navigation.hpp>

#include <oracles/closed_forms.hpp>

namespace liecheck::oracles {
namespace {

using Wide = Real100;
using V = Vec3<Wide>;
using M = Mat3<Wide>;

/// G_m = m! sum_k [phi]^k / (k + m)! = I + a [phi] + b [phi]^2, since [phi]^3 = -x [phi] with x = |phi|^2; da and db are the
/// derivatives of a and b by x.
struct Turning {
  V phi;
  M K, K2;
  Wide x, a, b, da, db;

  M value() const { return identity<3, Wide>() + a * K + b * K2; }
  /// The derivative of value() y by phi: column j is its change along axis j.
  M slope(const V& y) const {
    const V Ky = cross(phi, y), K2y = cross(phi, Ky), along = Wide(2) * (da * Ky + db * K2y);
    M m = -a * hat(y) - b * (hat(Ky) + K * hat(y));
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) m(i, j) += along[i] * phi[j];
    return m;
  }
  /// That of m - 1: G_(m - 1) = I + [phi] G_m / m.
  Turning before(int m) const {
    const auto over = [&](const Wide& y) { return Wide(y / m); };
    return {phi, K, K2, x, over(1 - b * x), over(a), over(-b - db * x), over(da)};
  }
};
/// That of m = 2 by its series: a = sum_j 2 (-x)^j / (2j + 3)!, b = sum_j 2 (-x)^j / (2j + 4)!.
Turning second_turning(const V& phi, bool values) {
  constexpr std::size_t all = 64;
  struct Coefficients {
    std::array<Wide, all> a, b;
  };
  static const Coefficients c = [] {
    Coefficients r;
    Wide factorial(6);
    for (std::size_t j = 0; j < all; ++j) {
      const unsigned n = 2 * static_cast<unsigned>(j);
      r.a[j] = 2 / factorial, r.b[j] = r.a[j] / (n + 4);
      factorial *= (n + 4) * (n + 5);
    }
    return r;
  }();
  const M K = hat(phi);
  Turning t{phi, K, K * K, squared_norm(phi), Wide(0), Wide(0), Wide(0), Wide(0)};
  const double size = static_cast<double>(t.x);
  std::size_t terms = 2;
  for (double left = size; left > 1e-66 && terms < all; ++terms)
    left *= size / static_cast<double>((2 * terms + 2) * (2 * terms + 3));
  const Wide y = -t.x;
  for (std::size_t j = terms; j-- > 0;) {
    if (!values) t.da = t.da * y + t.a, t.db = t.db * y + t.b;
    t.a = t.a * y + c.a[j], t.b = t.b * y + c.b[j];
  }
  t.da = -t.da, t.db = -t.db;
  return t;
}

struct State {
  M R = identity<3, Wide>(), R_g = zeros<3, 3, Wide>(), p_g = R_g, p_a = R_g, v_g = R_g, v_a = R_g;
  V p = zero_vector<3, Wide>(), v = p;
};

/// Without its derivatives if `values` is true.
State integrated(const Samples& gyro, const Samples& accelerometer, const Wide& dt, bool exact, const V& b_g,
                 const V& b_a, bool values = false) {
  State s;
  for (std::size_t n = 0; n < 3; ++n) {
    const V phi = dt * (cast<Wide>(gyro[n]) - b_g), a = cast<Wide>(accelerometer[n]) - b_a;
    const Wide half = dt * dt / 2;
    const Turning second = second_turning(phi, values), first = second.before(2);
    const M G = first.value(), step = first.before(1).value(), I = identity<3, Wide>(), G1 = exact ? G : I,
            G2 = exact ? second.value() : I;
    const V once = G1 * a, twice = G2 * a;
    if (!values) {
      // phi = dt (omega - b_g), so that its derivative by b_g is -dt.
      const auto slope = [&](const Turning& t) {
        return exact ? Wide(-dt) * t.slope(a) : zeros<3, 3, Wide>();
      };
      s.p_g = s.p_g + dt * s.v_g + half * (s.R * (slope(second) - hat(twice) * s.R_g));
      s.p_a = s.p_a + dt * s.v_a - half * (s.R * G2);
      s.v_g = s.v_g + dt * (s.R * (slope(first) - hat(once) * s.R_g));
      s.v_a = s.v_a - dt * (s.R * G1);
      s.R_g = transpose(step) * s.R_g - dt * transpose(G);
    }
    s.p = s.p + dt * s.v + half * (s.R * twice);
    s.v = s.v + dt * (s.R * once);
    s.R = s.R * step;
  }
  return s;
}

}  // namespace

Preintegrated preintegrated(const Samples& gyro, const Samples& accelerometer, const Real& dt, bool exact) {
  const V none = zero_vector<3, Wide>();
  const Wide t(dt);
  const State s = integrated(gyro, accelerometer, t, exact, none, none);
  Preintegrated r{cast<Real>(s.R),   cast<Real>(s.p),   cast<Real>(s.v),   cast<Real>(s.R_g),
                  cast<Real>(s.p_g), cast<Real>(s.p_a), cast<Real>(s.v_g), cast<Real>(s.v_a)};
  // The rotation by half angles.
  M R = identity<3, Wide>();
  Real size(1), longest(0);
  for (std::size_t n = 0; n < 3; ++n) {
    R = R * rotation_matrix(closed_exp(stack(none, V(t * cast<Wide>(gyro[n])))).Q);
    size = larger(size, Real(norm(accelerometer[n])));
    longest = larger(longest, Real(norm(gyro[n])));
  }
  bool good = agree(cast<Real>(R), r.R);
  // A central difference along (h e_g, h e_a), in units in which the biases matter.
  const V e_g{{Wide(0.6), Wide(-0.5), Wide(0.7)}}, e_a{{Wide(-0.4), Wide(0.8), Wide(0.3)}};
  const Wide unit = longest > 0 ? Wide(longest) : Wide(1), h_g = Wide(1e-25) * unit,
             h_a = Wide(1e-25) * Wide(size);
  const auto at = [&](int sign) {
    return integrated(gyro, accelerometer, t, exact, Wide(sign * h_g) * e_g, Wide(sign * h_a) * e_a, true);
  };
  const State plus = at(1), minus = at(-1);
  const V d_p = s.p_g * (h_g * e_g) + s.p_a * (h_a * e_a), d_v = s.v_g * (h_g * e_g) + s.v_a * (h_a * e_a),
          d_R = s.R_g * (h_g * e_g);
  const auto half = [](const V& x) { return Wide(0.5) * x; };
  const V turned = vee(M(Wide(0.5) * (transpose(s.R) * (plus.R - minus.R))));
  const Wide of_v = t * Wide(1e-25) * Wide(size) * (1 + t * unit), of_p = t * of_v;
  good = good && agree(half(plus.p - minus.p), d_p, 1e-30, of_p) &&
         agree(half(plus.v - minus.v), d_v, 1e-30, of_v) && agree(turned, d_R, 1e-30, Wide(t * h_g));
  r.resolved = good;
  return r;
}

}  // namespace liecheck::oracles

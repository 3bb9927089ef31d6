#include <oracles/navigation.hpp>

#include <oracles/exp.hpp>

namespace liecheck::oracles {
namespace {

using Wide = Real100;
using V = Vec3<Wide>;
using M = Mat3<Wide>;

/// G_m = m! sum_k [phi]^k / (k + m)! = I + a [phi] + b [phi]^2, since [phi]^3 = -x [phi] with x = |phi|^2. The power series
/// of a and b in x alternate, and da, db are their derivatives by x.
struct Turning {
  V phi;
  M K, K2;
  Wide a, b, da, db;
  Turning(int m, const V& by)
      : phi(by), K(hat(by)), K2(K * K), a(Wide(1) / (m + 1)), b(a / (m + 2)), da(0), db(0) {
    const Wide x = squared_norm(phi);
    Wide u = -a / ((m + 2) * (m + 3)), w = -b / ((m + 3) * (m + 4));  // x^(j - 1) of the terms
    double left = 1;
    const double size = static_cast<double>(x);
    for (int j = 1; left > 1e-65 && j < 200; ++j) {
      a += x * u, da += j * u, b += x * w, db += j * w;
      u *= -x / ((2 * j + m + 2) * (2 * j + m + 3)), w *= -x / ((2 * j + m + 3) * (2 * j + m + 4));
      left *= size / ((2 * j + m) * (2 * j + m + 1));
    }
  }
  M value() const { return identity<3, Wide>() + a * K + b * K2; }
  /// Along d.
  M change(const V& d) const {
    const M D = hat(d);
    const Wide s = 2 * dot(phi, d);
    return s * da * K + a * D + s * db * K2 + b * (D * K + K * D);
  }
};
template <class F>
M by_columns(F column) {
  M m;
  for (int j = 0; j < 3; ++j) {
    V e = zero_vector<3, Wide>();
    e[j] = 1;
    const V c = column(e);
    for (int i = 0; i < 3; ++i) m(i, j) = c[i];
  }
  return m;
}

struct State {
  M R = identity<3, Wide>(), R_g = zeros<3, 3, Wide>(), p_g = R_g, p_a = R_g, v_g = R_g, v_a = R_g;
  V p = zero_vector<3, Wide>(), v = p;
};

/// Without its derivatives if `values` is true.
State integrated(const Samples& gyro, const Samples& accelerometer, const Wide& dt, bool exact, const V& b_g,
                 const V& b_a, bool values = false) {
  State s;
  const V none = zero_vector<3, Wide>();
  for (std::size_t n = 0; n < 3; ++n) {
    const V phi = dt * (cast<Wide>(gyro[n]) - b_g), a = cast<Wide>(accelerometer[n]) - b_a;
    const V turning = exact ? phi : none;
    const Wide half = dt * dt / 2;
    const Turning first(1, turning), second(2, turning);
    const M G1 = first.value(), G2 = second.value(), step = Turning(0, phi).value();
    const V once = G1 * a, twice = G2 * a;
    if (!values) {
      // phi = dt (omega - b_g), so that its derivative along e is -dt e.
      const auto slope = [&](const Turning& G) {
        return by_columns([&](const V& e) { return exact ? G.change(Wide(-dt) * e) * a : none; });
      };
      s.p_g = s.p_g + dt * s.v_g + half * (s.R * (slope(second) - hat(twice) * s.R_g));
      s.p_a = s.p_a + dt * s.v_a - half * (s.R * G2);
      s.v_g = s.v_g + dt * (s.R * (slope(first) - hat(once) * s.R_g));
      s.v_a = s.v_a - dt * (s.R * G1);
      s.R_g = transpose(step) * s.R_g - dt * Turning(1, V(-phi)).value();
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
  // The rotation by exp.hpp, and the series of the first measurement.
  Mat3<> R = identity<3, Real>();
  Real size(1), longest(0);
  for (std::size_t n = 0; n < 3; ++n) {
    const ExpResult e = exp_so3(dt * gyro[n]);
    R = R * e.R;
    size = larger(size, Real(norm(accelerometer[n])));
    longest = larger(longest, Real(norm(gyro[n])));
  }
  const V phi = t * cast<Wide>(gyro[0]), a = cast<Wide>(accelerometer[0]);
  const V closed = Turning(1, phi).value() * a - a,
          by_second = Wide(0.5) * cross(phi, Turning(2, phi).value() * a);
  bool good = agree(R, r.R) && agree(by_second, closed, agreement, Wide(norm(a)));
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

#pragma once
// A box of inputs: the angle and the axis of a rotation vector, and the direction of a second vector.

#include <fmt/format.h>
#include <array>
#include <bounds/bounded_library.hpp>
#include <string>

namespace liecheck::properties {

using Vector = Vector3<Bounded>;

/// c_k(x) for a number 0 <= x <= 10, by 24 terms of its alternating series, whose remainder is below the last.
inline Interval stumpff_function(int k, double x) {
  Interval term = 1, sum = 0;
  for (int i = 2; i <= k; ++i) term = term / Interval(i);
  for (int j = 1; j <= 24; ++j) {
    sum = sum + term;
    term = term * Interval(-x) / Interval((2 * j + k - 1) * (2 * j + k));
  }
  return sum + Interval::around_zero(term.largest());
}
/// The same for an interval up to pi^2, where c_1, c_2, ... decrease, as does c_0 up to (pi/2)^2.
inline Interval stumpff_function(int k, const Interval& x) {
  return {stumpff_function(k, x.high).low, stumpff_function(k, std::max(0., x.low)).high};
}

/// A cell of directions on the unit sphere: number `face` is sign / w, the next two s / w and t / w, with w^2 = 1 + s^2 +
/// t^2 and |s|, |t| <= 1.
struct Directions {
  int face = 0, sign = 1;

  std::array<Interval, 3> numbers(const Interval& s, const Interval& t) const {
    const Interval s2 = square(s), t2 = square(t);
    std::array<Interval, 3> n;
    n[face] = Interval(sign) / sqrt(Interval(1) + s2 + t2);
    n[(face + 1) % 3] = Interval(sign) * ratio(s, t2);
    n[(face + 2) % 3] = Interval(sign) * ratio(t, s2);
    return n;
  }

 private:
  /// x / sqrt(1 + x^2 + other), which increases with x.
  static Interval ratio(const Interval& x, const Interval& other) {
    const auto at = [&](double v) { return Interval(v) / sqrt(Interval(1) + square(Interval(v)) + other); };
    return {at(x.low).low, at(x.high).high};
  }
};

enum Parameter { angle, s_phi, t_phi, s_rho, t_rho, parameters };

/// theta n, with n in a cell of directions, and r m for the second vector of the input.
struct Box {
  Directions phi, rho;
  std::array<Interval, parameters> p;

  std::string text() const {
    std::string out = fmt::format("theta {:.4g}..{:.4g}, axis {}{} ({:.3g}..{:.3g}, {:.3g}..{:.3g})",
                                  p[angle].low, p[angle].high, phi.sign < 0 ? "-" : "", "xyz"[phi.face],
                                  p[s_phi].low, p[s_phi].high, p[t_phi].low, p[t_phi].high);
    if (!p[s_rho].is_point())
      out += fmt::format(", rho along {} ({:.3g}..{:.3g}, {:.3g}..{:.3g})", "xyz"[rho.face], p[s_rho].low,
                         p[s_rho].high, p[t_rho].low, p[t_rho].high);
    return out;
  }
};

/// What every operation needs of a box.
struct BoxGeometry {
  Interval theta, x, half;  ///< theta, theta^2, theta^2 / 4
  std::array<Interval, 3> n, m;
  Interval parallel;  ///< (n . m)^2 in [0, 1]
  Vector phi, rho;

  explicit BoxGeometry(const Box& b)
      : theta(b.p[angle]),
        x(square(theta)),
        half(x / Interval(4)),
        n(b.phi.numbers(b.p[s_phi], b.p[t_phi])),
        m(b.rho.numbers(b.p[s_rho], b.p[t_rho])) {
    BoxFacts& facts = BoxFacts::current();
    facts = {};
    facts.x = x;
    facts.squares = {{7u, x}};
    const Interval dot = n[0] * m[0] + n[1] * m[1] + n[2] * m[2];
    parallel = intersection(square(dot), {0, 1});
    for (int i = 0; i < 3; ++i) {
      phi[i] = Bounded::input(theta * n[i], i);
      rho[i] = Bounded::scaling_input(m[i]);
    }
  }
  /// The smallest a p + b (1 - p) for p in `parallel`.
  double mixed(const Interval& a, const Interval& b) const {
    const auto at = [&](double p) { return (a * Interval(p) + b * (Interval(1) - Interval(p))).low; };
    return std::min(at(parallel.low), at(parallel.high));
  }
};

}  // namespace liecheck::properties

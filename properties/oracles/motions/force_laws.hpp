#pragma once
// The laws of forces of scenes but contact (contact_laws.hpp), as forces and moments on bodies in the world's
// axes, written from their equations in fixtures/scenes/README.md. Forces of joints are drives of coordinates
// k: a force or moment on the child, and the opposite on the parent. Names and units of the numbers are those
// of the equations.

#include <algorithm>
#include <oracles/motions/maximal_tree.hpp>

namespace liecheck::oracles::laws {

/// Numbers over time through rows of a table: lines between them, or Hermite's cubics with the slopes of the
/// parabola through the three nearest rows (of the line through two). Constant before and after.
template <class T>
struct Curve {
  std::vector<T> times;
  std::vector<std::vector<T>> rows;
  bool cubic = false;
  struct Point {
    T x, rate;
  };
  std::size_t width() const { return rows.empty() ? 0 : rows[0].size(); }
  /// Column k; of a table with one column, that one.
  Point at(const Snapshot<T>& s, std::size_t k) const {
    if (width() == 1) k = 0;
    for (std::size_t i = 1; i < times.size(); ++i) {
      if (!s.within(times[i - 1], times[i])) continue;
      const T h = times[i] - times[i - 1], a = (s.t - times[i - 1]) / h, b = T(1) - a, x0 = rows[i - 1][k],
              x1 = rows[i][k];
      if (!cubic) return {b * x0 + a * x1, (x1 - x0) / h};
      const T d0 = h * slope(i - 1, k), d1 = h * slope(i, k);
      return {b * b * (T(1) + T(2) * a) * x0 + a * a * (T(1) + T(2) * b) * x1 + a * b * (b * d0 - a * d1),
              (T(6) * a * b * (x1 - x0) + b * (b - T(2) * a) * d0 + a * (a - T(2) * b) * d1) / h};
    }
    return {(times.empty() || s.inside < times[0] ? rows.front() : rows.back())[k], T(0)};
  }

 private:
  /// The derivative at row i of Lagrange's polynomial through the nearest rows.
  T slope(std::size_t i, std::size_t k) const {
    const std::size_t n = std::min<std::size_t>(times.size(), 3),
                      first = std::min(i > 0 ? i - 1 : 0, times.size() - n);
    T sum(0);
    for (std::size_t j = first; j < first + n; ++j)
      for (std::size_t l = first; l < first + n; ++l) {
        T term = j == l ? T(0) : T(rows[j][k] / (times[j] - times[l]));
        for (std::size_t m = first; m < first + n; ++m)
          if (m != j && m != l) term *= (times[i] - times[m]) / (times[j] - times[m]);
        sum += term;
      }
    return sum;
  }
};

/// x within [low, high]; both ends bend.
template <class T>
T bounded(Snapshot<T>& s, const T& x, const T& low, const T& high) {
  const bool above = s.on(T(x - high)), below = s.on(T(low - x));
  return above ? high : below ? low : x;
}

/// p_ddot += g.
template <class T>
struct Gravity {
  Column3<T> g;
  std::vector<T> masses;  ///< of links
  void operator()(Snapshot<T>& s) const {
    for (std::size_t i = 1; i < masses.size(); ++i) s.push(int(i), Column3<T>(masses[i] * g), s.bodies[i].c);
  }
};

/// A force f and a moment n at the frame's origin, from <= t < until. A table adds to f, or to (f, n).
template <class T>
struct Wrench {
  Place<T> at;
  Column3<T> f, n;
  bool world;  ///< the axes of f and n
  T from, until;
  Curve<T> table = {};
  void operator()(Snapshot<T>& s) const {
    if (!s.within(from, until)) return;
    Column3<T> force = f, moment = n;
    for (int k = 0; k < int(table.width()); ++k)
      (k < 3 ? force : moment)[k % 3] += table.at(s, std::size_t(k)).x;
    s.push(at.link, world ? force : Column3<T>(s.axes(at) * force), s.point(at));
    s.turn(at.link, world ? moment : Column3<T>(s.axes(at) * moment));
  }
};

/// tau -= d v.
template <class T>
struct JointDamping {
  std::vector<std::size_t> k;
  std::vector<T> d;
  void operator()(Snapshot<T>& s) const {
    for (std::size_t i = 0; i < k.size(); ++i) s.drives[k[i]] -= d[i] * s.rates[k[i]];
  }
};

/// tau -= f v / sqrt(v^2 + v_s^2).
template <class T>
struct JointFriction {
  std::vector<std::size_t> k;
  std::vector<T> f;
  T slip;
  void operator()(Snapshot<T>& s) const {
    using std::sqrt;
    for (std::size_t i = 0; i < k.size(); ++i) {
      const T& v = s.rates[k[i]];
      s.drives[k[i]] -= f[i] * v / T(sqrt(T(v * v + slip * slip)));
    }
  }
};

/// tau -= stiffness (q - rest).
template <class T>
struct JointSpring {
  std::vector<std::size_t> k;
  T stiffness, rest;
  void operator()(Snapshot<T>& s) const {
    for (const std::size_t i : k) s.drives[i] -= stiffness * (s.positions[i] - rest);
  }
};

/// tau += stiffness x (1 + c x_dot)_+ inwards, x = depth beyond a limit. Limits may be infinite.
template <class T>
struct JointLimits {
  std::vector<std::size_t> k;
  std::vector<T> low, high;
  T stiffness, c;
  void operator()(Snapshot<T>& s) const {
    for (std::size_t i = 0; i < k.size(); ++i)
      for (const int inwards : {1, -1}) {
        const T& limit = inwards > 0 ? low[i] : high[i];
        if (limit == -std::numeric_limits<T>::infinity() || limit == std::numeric_limits<T>::infinity())
          continue;
        const T x = T(inwards) * (limit - s.positions[k[i]]), factor = T(1) - c * T(inwards) * s.rates[k[i]];
        const bool deep = s.on(x), pushes = s.on(factor);
        if (deep && pushes) s.drives[k[i]] += T(inwards) * stiffness * x * factor;
      }
  }
};

/// f = -(c1 + c2 |u|) u, n = -(k1 + k2 |omega|) omega, with the velocity u of the frame's origin relative to the
/// current.
template <class T>
struct Drag {
  Place<T> at;
  T c1, c2, k1, k2;
  Column3<T> current;
  void operator()(Snapshot<T>& s) const {
    const Column3<T> p = s.point(at), u = s.velocity(at.link, p) - current, omega = s.omega(at.link);
    s.push(at.link, Column3<T>(-(c1 + c2 * u.norm()) * u), p);
    s.turn(at.link, Column3<T>(-(k1 + k2 * omega.norm()) * omega));
  }
};

/// f = -rho V g at the frame's origin.
template <class T>
struct Buoyancy {
  Place<T> at;
  T volume, density;
  Column3<T> g;
  void operator()(Snapshot<T>& s) const { s.push(at.link, Column3<T>(-(density * volume) * g), s.point(at)); }
};

/// f = thrust e, n = k thrust e along the direction e in the frame, from <= t < until.
template <class T>
struct Thruster {
  Place<T> at;
  T thrust, k;
  Column3<T> direction;
  T from, until;
  void operator()(Snapshot<T>& s) const {
    if (!s.within(from, until)) return;
    const Column3<T> e = s.axes(at) * direction.normalized();
    s.push(at.link, Column3<T>(thrust * e), s.point(at));
    s.turn(at.link, Column3<T>(k * thrust * e));
  }
};

/// The inertia of the fluid that a body moves, without the terms M_a V', which are armatures:
/// f = -omega x P, n = -omega x L - u x P at the joint's origin, P = m u, L = j omega in the body's axes.
template <class T>
struct AddedMass {
  int link;
  Column3<T> m, j;
  void operator()(Snapshot<T>& s) const {
    const auto& b = s.bodies[std::size_t(link)];
    const Column3<T> u = s.velocity(link, b.o), P = b.R * m.cwiseProduct(Column3<T>(b.R.transpose() * u)),
                     L = b.R * j.cwiseProduct(Column3<T>(b.R.transpose() * b.omega));
    s.push(link, Column3<T>(P.cross(b.omega)), b.o);
    s.turn(link, Column3<T>(L.cross(b.omega) + P.cross(u)));
  }
};

/// tau += force.
template <class T>
struct ConstantForce {
  std::vector<std::size_t> k;
  T force;
  void operator()(Snapshot<T>& s) const {
    for (const std::size_t i : k) s.drives[i] += force;
  }
};

/// stiffness (target - q) + d (v_target - v) of coordinate k; v_target is the rate of a cubic table, and else 0.
template <class T>
struct Pursuit {
  T stiffness, d;
  Curve<T> targets;
  T operator()(const Snapshot<T>& s, std::size_t i, std::size_t k) const {
    const auto [x, rate] = targets.at(s, i);
    const T pull = stiffness == 0 ? T(0) : T(stiffness * (x - s.positions[k]));
    return pull + d * ((targets.cubic ? rate : T(0)) - s.rates[k]);
  }
};

/// tau += clamp(pursuit, +- limit). Limits may be infinite.
template <class T>
struct PdControl {
  std::vector<std::size_t> k;
  Pursuit<T> pursuit;
  std::vector<T> limits;
  void operator()(Snapshot<T>& s) const {
    for (std::size_t i = 0; i < k.size(); ++i) {
      const T tau = pursuit(s, i, k[i]);
      const bool limited = limits[i] < std::numeric_limits<T>::infinity();
      s.drives[k[i]] += limited ? bounded<T>(s, tau, T(-limits[i]), limits[i]) : tau;
    }
  }
};

/// tau += tau_m - (1 - efficiency) |tau_m| v / sqrt(v^2 + v_s^2). tau_m = force + pursuit, at most
/// stall (1 - v/no_load) in [0, stall], at least -stall (1 + v/no_load) in [-stall, 0]. Both are numbers at the
/// joint, and may be infinite. The rotor is an armature.
template <class T>
struct Motor {
  std::vector<std::size_t> k;
  Pursuit<T> pursuit;
  Curve<T> force;
  T stall, no_load, efficiency, v_s;
  void operator()(Snapshot<T>& s) const {
    using std::sqrt;
    for (std::size_t i = 0; i < k.size(); ++i) {
      const T& v = s.rates[k[i]];
      T tau = force.at(s, i).x + pursuit(s, i, k[i]);
      if (stall < std::numeric_limits<T>::infinity()) {
        const T high = largest(s, v), low = -largest(s, T(-v));
        tau = bounded<T>(s, tau, low, high);
      }
      const T size = efficiency == 1 ? T(0) : s.on(tau) ? tau : T(-tau);
      s.drives[k[i]] += tau - (T(1) - efficiency) * size * v / T(sqrt(T(v * v + v_s * v_s)));
    }
  }

 private:
  T largest(Snapshot<T>& s, const T& v) const {
    if (no_load == std::numeric_limits<T>::infinity()) return stall;
    return bounded<T>(s, T(stall * (T(1) - v / no_load)), T(0), stall);
  }
};

/// tau += a force over time.
template <class T>
struct ForceTable {
  std::vector<std::size_t> k;
  Curve<T> force;
  void operator()(Snapshot<T>& s) const {
    for (std::size_t i = 0; i < k.size(); ++i) s.drives[k[i]] += force.at(s, i).x;
  }
};

}  // namespace liecheck::oracles::laws

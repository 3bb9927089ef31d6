#pragma once
// The laws of forces of scenes, as forces and moments on bodies in the world's axes, written from their
// equations in fixtures/scenes/README.md. Forces of joints are drives of coordinates k: a force or moment on
// the child, and the opposite on the parent. Names and units of the numbers are those of the equations.

#include <algorithm>
#include <oracles/motions/maximal_tree.hpp>

namespace liecheck::oracles::laws {

/// p_ddot += g.
template <class T>
struct Gravity {
  Column3<T> g;
  std::vector<T> masses;  ///< of links
  void operator()(Snapshot<T>& s) const {
    for (std::size_t i = 1; i < masses.size(); ++i) s.push(int(i), Column3<T>(masses[i] * g), s.bodies[i].c);
  }
};

/// A force f and a moment n at the frame's origin, from <= t < until.
template <class T>
struct Wrench {
  Place<T> at;
  Column3<T> f, n;
  bool world;  ///< the axes of f and n
  T from, until;
  void operator()(Snapshot<T>& s) const {
    if (!s.within(from, until)) return;
    s.push(at.link, world ? f : Column3<T>(s.axes(at) * f), s.point(at));
    s.turn(at.link, world ? n : Column3<T>(s.axes(at) * n));
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

/// f = -(c1 + c2 |u|) u, n = -(k1 + k2 |omega|) omega, with the velocity u of the frame's origin.
template <class T>
struct Drag {
  Place<T> at;
  T c1, c2, k1, k2;
  void operator()(Snapshot<T>& s) const {
    const Column3<T> p = s.point(at), u = s.velocity(at.link, p), omega = s.omega(at.link);
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

/// Spheres of radius r, or points, on the plane through (0, 0, height) with the unit normal n, as stored. At
/// the contact,
///   f_n = stiffness x (1 + c x_dot)_+,  f_t = -mu f_n u_t / sqrt(|u_t|^2 + v_s^2),
/// and moments -rho f_n w_t / sqrt(|w_t|^2 + w_s^2) - tau f_n w_n n / sqrt(w_n^2 + w_s^2).
template <class T>
struct Contact {
  std::vector<Place<T>> centres;
  Column3<T> n;
  T height, r, stiffness, c, mu, v_s, rho, tau, w_s;
  void operator()(Snapshot<T>& s) const {
    using std::sqrt;
    const Column3<T> origin(T(0), T(0), height);
    for (const Place<T>& at : centres) {
      const Column3<T> lowest = s.point(at) - r * n, u = s.velocity(at.link, lowest), w = s.omega(at.link);
      const T x = r - n.dot(Column3<T>(s.point(at) - origin)), factor = T(1) - c * n.dot(u);
      const bool deep = s.on(x), pushes = s.on(factor);
      if (!deep || !pushes) continue;
      const T f_n = stiffness * x * factor, w_n = n.dot(w);
      const Column3<T> u_t = u - n.dot(u) * n, w_t = w - w_n * n;
      s.push(at.link, Column3<T>(f_n * n - mu * f_n / T(sqrt(T(u_t.squaredNorm() + v_s * v_s))) * u_t),
             lowest);
      s.turn(at.link, Column3<T>(-rho * f_n / T(sqrt(T(w_t.squaredNorm() + w_s * w_s))) * w_t -
                                 tau * f_n * w_n / T(sqrt(T(w_n * w_n + w_s * w_s))) * n));
    }
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

/// tau += clamp(stiffness (target - q) - d v, +- limit). Limits may be infinite.
template <class T>
struct PdControl {
  std::vector<std::size_t> k;
  T stiffness, d;
  std::vector<T> targets, limits;
  void operator()(Snapshot<T>& s) const {
    for (std::size_t i = 0; i < k.size(); ++i) {
      T tau = stiffness * (targets[i] - s.positions[k[i]]) - d * s.rates[k[i]];
      if (limits[i] < std::numeric_limits<T>::infinity()) {
        const bool above = s.on(T(tau - limits[i])), below = s.on(T(-limits[i] - tau));
        if (above) tau = limits[i];
        if (below) tau = -limits[i];
      }
      s.drives[k[i]] += tau;
    }
  }
};

/// tau += the force interpolated in a table over time; constant before and after.
template <class T>
struct ForceTable {
  std::vector<std::size_t> k;
  std::vector<T> times, forces;
  void operator()(Snapshot<T>& s) const {
    T force = s.inside < times.front() ? forces.front() : forces.back();
    for (std::size_t i = 1; i < times.size(); ++i)
      if (s.within(times[i - 1], times[i]))
        force =
            (forces[i - 1] * (times[i] - s.t) + forces[i] * (s.t - times[i - 1])) / (times[i] - times[i - 1]);
    for (const std::size_t i : k) s.drives[i] += force;
  }
};

}  // namespace liecheck::oracles::laws

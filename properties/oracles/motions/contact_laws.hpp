#pragma once
// The laws of contact of scenes, as force_laws.hpp has the other ones.

#include <oracles/motions/maximal_tree.hpp>
#include <utility>

namespace liecheck::oracles::laws {

/// Body A touches body B at p, to the depth x, with the unit normal n from B to A. On A act
///   f_n n - mu f_n u_t / sqrt(|u_t|^2 + v_s^2),  f_n = stiffness x^exponent (1 + c x_dot)_+,
/// and moments -rho f_n w_t / sqrt(|w_t|^2 + w_s^2) - tau f_n w_n n / sqrt(w_n^2 + w_s^2); u and w are the
/// velocity at p and the angular velocity of A relative to B.
template <class T>
struct Touch {
  T stiffness, exponent, c, mu, v_s, rho, tau, w_s;
  void operator()(Snapshot<T>& s, int A, int B, const T& x, const Column3<T>& n, const Column3<T>& p) const {
    using std::sqrt;
    const Column3<T> u = s.velocity(A, p) - s.velocity(B, p), w = s.omega(A) - s.omega(B);
    const T factor = T(1) - c * n.dot(u);
    const bool deep = s.on(x), pushes = s.on(factor);
    if (!deep || !pushes) return;
    const T f_n = stiffness * power(x) * factor, w_n = n.dot(w);
    const Column3<T> u_t = u - n.dot(u) * n, w_t = w - w_n * n,
                     f = f_n * n - mu * f_n / T(sqrt(T(u_t.squaredNorm() + v_s * v_s))) * u_t,
                     moment = -rho * f_n / T(sqrt(T(w_t.squaredNorm() + w_s * w_s))) * w_t -
                              tau * f_n * w_n / T(sqrt(T(w_n * w_n + w_s * w_s))) * n;
    s.push(A, f, p), s.turn(A, moment);
    s.push(B, Column3<T>(-f), p), s.turn(B, Column3<T>(-moment));
  }
  /// x^exponent. Beyond the end of a contact, whose branch is held until its event, a line goes on; others end.
  T power(const T& x) const {
    using std::pow;
    if (exponent == 1) return x;
    return x > 0 ? T(pow(x, exponent)) : T(0);
  }
};

/// A sphere, or the spheres of radius r about the points of a segment, its ends at +- half along z of the place;
/// or a box with half its sides.
template <class T>
struct Solid {
  Place<T> at;
  T r = T(0), half = T(0);
  Column3<T> sides = Column3<T>::Zero();
  bool box = false;
};

/// Spheres of radius r, or points, on the plane through (0, 0, height) with the unit normal n, as stored.
template <class T>
struct Contact {
  struct Ball {
    Place<T> at;
    T r;
  };
  std::vector<Ball> balls;
  Column3<T> n;
  T height;
  Touch<T> law;
  void operator()(Snapshot<T>& s) const {
    const Column3<T> origin(T(0), T(0), height);
    for (const auto& [at, r] : balls) {
      const Column3<T> p = s.point(at);
      law(s, at.link, 0, T(r - n.dot(Column3<T>(p - origin))), n, Column3<T>(p - r * n));
    }
  }
  /// What of a solid touches a plane first: a sphere, the ends of a capsule, the corners of a box.
  void add(const Solid<T>& solid) {
    const Place<T>& at = solid.at;
    const auto corner = [&](const Column3<T>& p) {
      balls.push_back({{at.link, at.R, at.p + at.R * p}, solid.r});
    };
    std::vector<Column3<T>> all = {Column3<T>::Zero()};
    const Column3<T> extent = solid.box ? solid.sides : Column3<T>(T(0), T(0), solid.half);
    for (int i = 0; i < 3; ++i) {
      if (extent[i] == 0) continue;
      for (std::size_t k = all.size(); k-- > 0;) {
        all.push_back(all[k]);
        all[k][i] = extent[i], all.back()[i] = -extent[i];
      }
    }
    for (const Column3<T>& p : all) corner(p);
  }
};

/// Solids that overlap by x = r_A + r_B - |a - b|, with the closest points a and b of their segments, or of a
/// centre and a box with r_B = 0 (the point of its surface if the centre is inside), n = (a - b)/|a - b|, at
/// a - (r_A - x/2) n.
template <class T>
struct Collisions {
  std::vector<std::pair<Solid<T>, Solid<T>>> pairs;  ///< A is no box
  Touch<T> law;
  void operator()(Snapshot<T>& s) const {
    for (const auto& [A, B] : pairs) {
      Column3<T> a = s.point(A.at), n;
      T distance;
      if (B.box) {
        n = from_box(s, a, B, distance);
      } else {
        const Column3<T> d = A.half * s.axes(A.at).col(2), e = B.half * s.axes(B.at).col(2),
                         r = a - s.point(B.at);
        const auto [x, y] = closest(r, d, e);
        a += x * d, n = r + x * d - y * e;
        distance = n.norm(), n /= distance;
      }
      const T x = A.r + B.r - distance;
      law(s, A.at.link, B.at.link, x, n, Column3<T>(a - (A.r - x / T(2)) * n));
    }
  }

 private:
  /// x and y within [-1, 1] with the least |r + x d - y e|: the stationary point, or one on an edge of the square.
  static std::pair<T, T> closest(const Column3<T>& r, const Column3<T>& d, const Column3<T>& e) {
    const T dd = d.dot(d), ee = e.dot(e), de = d.dot(e), rd = r.dot(d), re = r.dot(e),
            determinant = dd * ee - de * de, x = (de * re - ee * rd) / determinant,
            y = (dd * re - de * rd) / determinant;
    if (determinant > 0 && x * x <= 1 && y * y <= 1) return {x, y};
    const auto part = [](const T& rise, const T& of) {
      return of > 0 ? std::clamp<T>(rise / of, T(-1), T(1)) : T(0);
    };
    std::pair<T, T> best{T(1), part(T(re + de), ee)};
    for (const std::pair<T, T>& other : {std::pair<T, T>{T(-1), part(T(re - de), ee)},
                                         {part(T(de - rd), dd), T(1)},
                                         {part(T(-de - rd), dd), T(-1)}}) {
      const auto square = [&](const std::pair<T, T>& at) {
        return Column3<T>(r + at.first * d - at.second * e).squaredNorm();
      };
      if (square(other) < square(best)) best = other;
    }
    return best;
  }
  /// The direction from the nearest point of a box to p, and the distance, below 0 inside.
  static Column3<T> from_box(const Snapshot<T>& s, const Column3<T>& p, const Solid<T>& box, T& distance) {
    const Square3<T> R = s.axes(box.at);
    const Column3<T> q = R.transpose() * Column3<T>(p - s.point(box.at)),
                     out = q - q.cwiseMin(box.sides).cwiseMax(Column3<T>(-box.sides));
    distance = out.norm();
    if (distance > 0) return R * Column3<T>(out / distance);
    Eigen::Index face = 0;
    distance = Column3<T>(q.cwiseAbs() - box.sides).maxCoeff(&face);
    return q[face] < 0 ? Column3<T>(-R.col(face)) : Column3<T>(R.col(face));
  }
};

}  // namespace liecheck::oracles::laws

#pragma once
// A tree of rigid bodies in maximal coordinates, without joint coordinates, spatial algebra and tangent
// spaces.
//
// Each body has its centre of mass c, attitude Q, and momenta P and L (about c), all in the world's axes:
//
//   c' = v = P/m,   Q' = (omega, 0) Q / 2,   L = J omega,   J = R I R^T,   P' = f,   L' = n
//
// A joint has six directions d, fixed in the child's axes. Row d is the power of a unit force along d between
// child and parent, j . (v, omega of both). nv rows give the joint's rates; the others are constraints, and
// zero. With multipliers lambda, and 1/I_m = 0 for a constraint (I_m is the armature of a rate),
//
//   P', L' = forces + sum_j j lambda_j,   d/dt (j . (v, omega)) = -lambda_j / I_m
//
// A rate without armature has no multiplier. Loops add constraints of two places a and b,
//
//   r = (p_a - p_b, rotation vector of R_a R_b^T for a weld),  r'' = -2 alpha r' - alpha^2 r  (Baumgarte 1972),
//
// in the world's axes, r' and r'' being the relative velocities and accelerations. The other constraints are differentiated once, so that an integration
// error of the positions stays. (Featherstone 2008, section 3.2; Hairer & Wanner 1996, VII.1.)
//
// Domain: bodies of positive mass and moments; no mimics. A stored quaternion, axis or (cos, sin)
// stands for its normalised value, and a stored matrix for the rotation nearest to it.

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/multiprecision/eigen.hpp>
#include <boost/multiprecision/float128.hpp>
#include <functional>
#include <oracles/tree.hpp>

namespace liecheck::oracles {

template <class T>
using Column3 = Eigen::Matrix<T, 3, 1>;
template <class T>
using Square3 = Eigen::Matrix<T, 3, 3>;
template <class T>
using Numbers = Eigen::Matrix<T, Eigen::Dynamic, 1>;

/// The rotation nearest to a matrix, its polar factor, by Newton's iteration (Higham 1986).
template <class T>
Square3<T> nearest_rotation(Square3<T> R) {
  for (int k = 0; k < 4; ++k) R = (R + Square3<T>(R.inverse().transpose())) / T(2);
  return R;
}

/// A body and the joint that carries it. Link 0 is the world, without mass. The joint frame's pose in the
/// parent's frame is (R, p) at q = neutral; axis and pitch [m/rad] are those of the joint's kind.
template <class T>
struct MaximalLink {
  JointKind kind = JointKind::free_flyer;
  int parent = 0;
  Square3<T> R = Square3<T>::Identity();
  Column3<T> p = Column3<T>::Zero(), axis = Column3<T>::UnitZ();
  T pitch = T(0);
  T mass = T(0);                            ///< [kg]
  Column3<T> lever = Column3<T>::Zero();    ///< centre of mass in the joint's frame [m]
  Square3<T> inertia = Square3<T>::Zero();  ///< about it [kg m^2]
};

/// A frame fixed to a link.
template <class T>
struct Place {
  int link = 0;
  Square3<T> R = Square3<T>::Identity();
  Column3<T> p = Column3<T>::Zero();
};

/// Two places whose origins, or axes too, are held together.
template <class T>
struct Loop {
  Place<T> a, b;
  bool weld;
  T alpha;  ///< [1/s]
};

/// The branches of forces that begin or end where the state decides, by the signs of their functions g. While
/// they are held, a function that changes its sign does not change its branch.
template <class T>
struct Branches {
  std::vector<char> on;
  std::vector<T> g;
  bool held = false, crossed = false;

  bool ask(const T& value) {
    const std::size_t k = g.size();
    g.push_back(value);
    if (!held) on.resize(k), on.push_back(value > 0);
    crossed = crossed || (on[k] ? value < 0 : value > 0);
    return on[k];
  }
  /// The smallest of the functions, each with the sign that it has in its branch.
  T margin() const {
    T least = std::numeric_limits<T>::max();
    for (std::size_t k = 0; k < g.size(); ++k) least = std::min<T>(least, on[k] ? g[k] : T(-g[k]));
    return least;
  }
  /// Changes every branch whose function has the other sign.
  void change() {
    for (std::size_t k = 0; k < g.size(); ++k)
      if (on[k] ? g[k] < 0 : g[k] > 0) on[k] = !on[k];
  }
};

/// All bodies at one time, and the sums of the forces on them, for laws of forces.
template <class T>
class Snapshot {
 public:
  struct Body {
    Square3<T> R, inverse;  ///< axes; inverse of J
    Column3<T> o, c, v, omega,
        L;            ///< joint frame's origin; centre of mass, its velocity; those of the turning
    Column3<T> f, n;  ///< sums of forces, and of moments about c
    T inverse_mass;
  };
  T t;       ///< [s]
  T inside;  ///< a time within the piece of the forces that applies
  std::vector<Body> bodies;
  std::vector<T> positions, rates, drives;  ///< of coordinates of joints; NaN for one without a position
  Branches<T>* branches = nullptr;

  Column3<T> point(const Place<T>& at) const { return body(at).o + body(at).R * at.p; }
  Square3<T> axes(const Place<T>& at) const { return body(at).R * at.R; }
  Column3<T> velocity(int link, const Column3<T>& at) const {
    const Body& b = bodies[std::size_t(link)];
    return b.v + b.omega.cross(Column3<T>(at - b.c));
  }
  const Column3<T>& omega(int link) const { return bodies[std::size_t(link)].omega; }
  bool within(const T& from, const T& until) const { return from <= inside && inside < until; }
  bool on(const T& g) { return branches->ask(g); }

  void push(int link, const Column3<T>& f, const Column3<T>& at) {
    Body& b = bodies[std::size_t(link)];
    b.f += f, b.n += Column3<T>(at - b.c).cross(f);
  }
  void turn(int link, const Column3<T>& moment) { bodies[std::size_t(link)].n += moment; }

 private:
  const Body& body(const Place<T>& at) const { return bodies[std::size_t(at.link)]; }
};

/// A force, and the times [s] at which it jumps or bends.
template <class T>
struct Law {
  std::function<void(Snapshot<T>&)> add;
  std::vector<T> times = {};
};

template <class T>
class MaximalTree {
 public:
  /// Throws std::domain_error for a body without inertia.
  explicit MaximalTree(std::vector<MaximalLink<T>> links);

  std::vector<Law<T>> laws;
  std::vector<T> armature;  ///< [nv]
  std::vector<Loop<T>> loops;

  const std::vector<MaximalLink<T>>& links() const { return links_; }
  int nq() const { return nq_; }
  int nv() const { return nv_; }

  /// (c, Q, P, L) of all bodies.
  Numbers<T> state(const std::vector<T>& q, const std::vector<T>& v);
  /// Joint coordinates of a state. Angles are the nearest to those of the last call of state() or
  /// coordinates().
  void coordinates(const Numbers<T>& y, std::vector<T>& q, std::vector<T>& v);
  /// y' at t, in the piece that holds `inside`.
  Numbers<T> rate(const T& t, const T& inside, const Numbers<T>& y, Branches<T>& branches) const;
  std::vector<T> times() const;

 private:
  struct Direction {
    Column3<T> u, omega;  ///< force and moment, in the child's axes at its origin
  };
  struct Row {
    std::size_t child, parent;
    Column3<T> v_c, omega_c, v_p, omega_p;  ///< the factors of the velocities
    T bias;                                 ///< d/dt of the row at constant velocities
    T compliance;
  };
  static std::vector<Direction> directions(const MaximalLink<T>&);
  Snapshot<T> unpack(const Numbers<T>& y) const;
  Row row(const Snapshot<T>&, std::size_t link, const Direction&) const;
  static void close(const Snapshot<T>&, const Loop<T>&, std::vector<Row>&);
  static T speed(const Snapshot<T>&, const Row&);
  void relative(const Snapshot<T>&, std::size_t link, Eigen::Quaternion<T>&, Column3<T>&) const;
  T angle(std::size_t link, const Eigen::Quaternion<T>&) const;
  void fill(Snapshot<T>&) const;
  void constrain(Snapshot<T>&, std::vector<Row>&) const;

  std::vector<MaximalLink<T>> links_;
  std::vector<std::vector<Direction>> directions_;
  std::vector<int> idx_q_, idx_v_;
  int nq_ = 0, nv_ = 0;
  std::vector<T> turns_;  ///< the last angle of each link [rad]
};

extern template class MaximalTree<boost::multiprecision::float128>;
extern template class MaximalTree<long double>;

}  // namespace liecheck::oracles

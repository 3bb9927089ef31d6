#pragma once
// What cancels in the motion of a tree: the recursive Newton-Euler algorithm (Featherstone 2008, table 5.1) with every
// vector replaced by its norm and every sum by that of sizes.
//
//   w_i = w_p + |w_J|,   u_i = u_p + w_p r + |u_J|,   r = |p| + |p_E(q)|
//   al_i = al_p + |w_J'| + w_i |w_J|,   ac_i = ac_p + al_p r + |u_J'| + u_i |w_J| + w_i |u_J|,   ac_0 = |g|
//   f = m (ac + al c) + w m s,   n = |I_C| (al + w^2) + c f + u m s,   s = u + w c;   to the parent: f, n + r f
//
// A result divided by these is what is left of its terms: kappa = terms / ||result|| is how much larger than itself the
// result may move when each vector of the problem moves by a relative eps in any direction. How far from the world's
// origin it all is adds nothing. A mimic's angle m q + o is rounded, which turns all that is behind it by eps of the
// angle: the terms count that many times more. With `about_root`, forces and motions are taken at the origin of the
// first joint, and the distance from there is a lever more.
//
// A displacement d of q turns and moves what is behind a joint: through Tangent, a number with its derivative, the same
// recursions bound those of tau.

#include <oracles/tree.hpp>

namespace liecheck::oracles {

/// x + eps d, both >= 0.
struct Tangent {
  double x = 0, d = 0;
  Tangent(double value = 0, double derivative = 0) : x(value), d(derivative) {}  // NOLINT: a constant
};
inline Tangent operator+(const Tangent& a, const Tangent& b) {
  return {a.x + b.x, a.d + b.d};
}
inline Tangent operator*(const Tangent& a, const Tangent& b) {
  return {a.x * b.x, a.d * b.x + a.x * b.d};
}
inline Tangent& operator+=(Tangent& a, const Tangent& b) {
  return a = a + b;
}

/// N: double or Tangent.
template <class N>
struct TreeSizes {
  using Numbers = std::vector<double>;
  struct Joint {
    N r{}, turn{1};               ///< the lever from the parent; 1 + |w_d| of a displacement
    N w{}, u{}, al{}, ac{};       ///< velocities and spatial accelerations, ac less gravity
    N position{};                 ///< from the world's origin
    N mass{}, first{}, second{};  ///< of all that it carries, at its origin
  };
  std::vector<Joint> joints;
  std::vector<N> tau;              ///< [nv]
  Numbers mass;                    ///< [nv x nv] sizes of M's terms
  double linear = 0, angular = 0;  ///< momentum; angular at the centre of mass
  double kinetic = 0, potential = 0;

  TreeSizes(const TreeOf<double>& tree, const Numbers& q, const Numbers& v, const Numbers& a,
            const std::vector<WrenchOf<double>>& fext = {}, const Numbers& dq = {}, const Numbers& dv = {},
            bool about_root = false);
};

}  // namespace liecheck::oracles

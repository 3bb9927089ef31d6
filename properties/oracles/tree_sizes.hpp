#pragma once
// The sizes of the terms whose sums are the results of a tree. They follow from the recursive Newton-Euler
// algorithm (Featherstone 2008, table 5.1) with norms in place of vectors. p is the parent, J the joint.
//
//   w_i = w_p + |w_J|,   u_i = u_p + w_p r + |u_J|,   r = |p| + |p_E(q)|
//   al_i = al_p + |w_J'| + w_i |w_J|,   ac_i = ac_p + al_p r + |u_J'| + u_i |w_J| + w_i |u_J|,   ac_0 = |g|
//   f = m (ac + al c) + w m s,   n = |I_C| (al + w^2) + c f + u m s,   s = u + w c;   to parent: f, n + r f
//
// kappa = terms / ||result|| bounds the relative change of the result, in eps, when each vector of the
// problem changes by a relative eps in any direction. The distance of the tree from the world's origin adds
// nothing. The rounding of a mimic's angle m q + o rotates all joints behind it by eps |m q + o|. The terms
// are therefore multiplied by 1 + 2 (sum of the mimics' angles). With `about_root`, forces and motions are
// taken at the origin of the first joint, and the distance from that origin is one more lever arm.
//
// A displacement d of q rotates and translates the joints behind it. With N = Tangent, which is a number with
// its derivative, the same recursions bound the terms of dtau.

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

/// 1 + twice the sum of all mimics' angles: the rounding of each angle rotates the motions of the outward
/// pass and the forces of the inward pass. The terms of TreeSizes include this factor.
double mimic_factor(const TreeOf<double>& tree, const std::vector<double>& q);

/// N is double or Tangent.
template <class N>
struct TreeSizes {
  using Numbers = std::vector<double>;
  struct Joint {
    N r{}, rotation{1};                         ///< lever arm from the parent; 1 + angle of a displacement
    N w{}, u{}, al{}, ac{};                     ///< velocities; spatial accelerations minus gravity
    N position{};                               ///< distance from the world's origin
    N mass{}, first_moment{}, second_moment{};  ///< of the subtree, at the joint's origin
  };
  std::vector<Joint> joints;
  std::vector<N> tau;              ///< [nv]
  Numbers mass;                    ///< [nv x nv] terms of the joint space inertia M
  double linear = 0, angular = 0;  ///< momentum; angular at the centre of mass
  double kinetic = 0, potential = 0;

  TreeSizes(const TreeOf<double>& tree, const Numbers& q, const Numbers& v, const Numbers& a,
            const std::vector<WrenchOf<double>>& fext = {}, const Numbers& dq = {}, const Numbers& dv = {},
            bool about_root = false);

 private:
  struct Loads;
  void outward(const TreeOf<double>& tree, const Numbers& q, const Numbers& v, const Numbers& a,
               const std::vector<WrenchOf<double>>& fext, const Numbers& dq, const Numbers& dv,
               bool about_root, Loads& loads);
  void inward(const TreeOf<double>& tree, Loads& loads);
  void add_armatures(const TreeOf<double>& tree, const Numbers& v, const Numbers& a);
  void add_mass_matrix(const TreeOf<double>& tree);
  void multiply(double factor);
};

}  // namespace liecheck::oracles

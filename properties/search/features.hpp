#pragma once
// The features of a call, from its arguments as plain numbers and the record of its operation: what a fault may depend on.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <subjects/number_function.hpp>
#include <subjects/tree.hpp>
#include <vector>

namespace liecheck::properties {

/// Numbers that describe the arguments of one call, or the calls before it.
enum class Feature : std::uint8_t {
  one,                ///< always 1
  theta,              ///< angle [rad] of phi, else between two quaternions, else of the first rotation
  theta_scale,        ///< log2 of theta, over the largest exponent of the scalar
  pi_minus_theta,     ///< [rad]
  turn,               ///< theta of a rotation vector, which may be larger than pi [rad]
  turn_minus_pi,      ///< [rad]
  turn_minus_two_pi,  ///< [rad]
  w,                  ///< scalar part of the first quaternion
  octant,             ///< 0 ... 7: bit i is set if number i of the first rotation or vector is negative
  zeros,              ///< how many of these three numbers are zero
  off_unit,           ///< the largest ||Q|^2 - 1| of the quaternions [eps]
  norm,               ///< the norm of the quaternion that is off unit the most, if by more than 16 eps
  off_orthogonal,     ///< the largest |R^T R - I| of the matrices [eps]
  length,             ///< log2 of the longest vector [m], over the largest exponent of the scalar
  speed,              ///< likewise of velocities [m/s, rad/s]
  force,              ///< likewise of forces and moments [N, N m]
  mass,               ///< log2 of the mass [kg], over the largest exponent of the scalar
  apart,              ///< |p1 - p0| / |p0| of two configurations
  moments_apart,      ///< the smallest difference of principal moments of inertia, over the largest moment
  thin,               ///< the smallest over the largest moment
  flat,               ///< the sum of the two smaller minus the largest, over the largest moment
  point,              ///< 1 if the inertia is zero, else 0
  joints,             ///< number of joints of the tree
  revolute,           ///< number of joints of this kind; the order is that of oracles::JointKind
  continuous,
  prismatic,
  helical,
  spherical,
  planar,
  translation,
  free_flyer,
  mimics,       ///< number of mimic joints
  shape,        ///< 0 a chain, 1 a star, 2 all joints on the world, 3 other trees; fewer than 3 joints: none
  mass_ratio,   ///< the largest over the smallest mass
  armature,     ///< 1 if a joint has an armature, else 0
  position,     ///< the largest |number| of q [m, rad, 1]
  joint_speed,  ///< the largest |number| of v or of an increment [m/s, rad/s, m, rad]
  drive,        ///< the largest |number| of a or tau
  wrench,       ///< 1 if a wrench acts, else 0
  seen,         ///< the reference frame: the number of a Seen
  x_negative,   ///< 1 if the first number of the first rotation or vector is negative, else 0
  y_negative,
  z_negative,
  largest,           ///< which of these three numbers is the largest in size: 0, 1 or 2
  trace,             ///< of the first matrix
  second_w,          ///< scalar part of the second quaternion
  product,           ///< Q0 . Q1 of two quaternions
  fraction,          ///< t
  along,             ///< the cosine of the angle between the axis of the first rotation and the first vector
  order,             ///< of Euler angles
  first_length,      ///< likewise of the first vector alone
  second_length,     ///< and of the second
  depth,             ///< the most joints on a path from the world to a body
  several,           ///< 1 if a joint has several velocities, else 0
  several_armature,  ///< 1 if a joint of several velocities has an armature, else 0
  turned_prismatic,  ///< 1 if a prismatic joint is behind one that rotates, else 0
  inner_free_flyer,  ///< 1 if a free-flyer is behind another joint, else 0
  narrower,          ///< 1 if a joint has fewer velocities than one before it on its path, else 0
  gravity,           ///< 1 if it is not (0, 0, -9.81), else 0
  tilted_gravity,    ///< 1 if it has a part along x or y, else 0
  frame_depth,       ///< joints on the path from the world to the frame
  frame_off,         ///< 1 if the frame's origin is not its joint's, else 0
  wrench_joint,      ///< the number of the joint on which a wrench acts, from 1; 0: none acts
  moves,             ///< 1 if a number of v is not zero, else 0
  accelerates,       ///< likewise of a
  driven,            ///< likewise of tau
  lock,  ///< the angle between the middle Euler angle of a rotation and the nearer end of its range [rad]
  call,  ///< 1 for the first call of the operation, and so on
  call_mod_1000,   ///< the number of the call modulo 1000
  call_mod_2,      ///< and modulo 2
  after_itself,    ///< 1 if the call before was of the same operation, else 0
  same_arguments,  ///< 1 if the call before of this operation had the same arguments, else 0
  second_thread,   ///< 1 if the call is on another thread than the first call, else 0
  count
};

inline constexpr std::size_t feature_count = static_cast<std::size_t>(Feature::count);

/// NaN for what the arguments do not have.
struct Features {
  std::array<double, feature_count> values;
  Features() {
    values.fill(std::numeric_limits<double>::quiet_NaN());
    (*this)[Feature::one] = 1;
  }
  double& operator[](Feature f) { return values[static_cast<std::size_t>(f)]; }
  double operator[](Feature f) const { return values[static_cast<std::size_t>(f)]; }
};

/// What a call of a tree's or a robot's operation depends on besides its arguments.
struct Context {
  Features features;      ///< those of the tree
  bool floating = false;  ///< the first joint is a free-flyer
};

Context context_of(const Tree<double>& tree);

/// The features of the arguments of a call, one after another. Habits are left NaN.
Features features_of(const NumberFunction& function, const std::vector<double>& arguments,
                     const Context& context);

/// The number between two that has the fewest digits; 0 if it is between them.
double shortest_between(double a, double b);

}  // namespace liecheck::properties

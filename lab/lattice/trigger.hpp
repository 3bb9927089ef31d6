#pragma once
// When a fault of the lattice acts: a range of one number that describes the arguments of a call. The
// generators of inputs know nothing of it.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
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
  call,         ///< 1 for the first call of the operation, and so on
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

struct Trigger {
  std::string family;  ///< the group of triggers in the table that `lab lattice` prints
  std::string name;
  Feature feature = Feature::one;
  double low = 0, high = 0;

  bool fires(const Features& f) const { return f[feature] >= low && f[feature] < high; }
  bool applies(const Features& f) const { return f[feature] == f[feature]; }
  /// Whether it depends on earlier calls.
  bool is_habit() const { return feature >= Feature::call; }
};

/// All triggers, in the order of the table.
const std::vector<Trigger>& triggers();

}  // namespace liecheck::properties

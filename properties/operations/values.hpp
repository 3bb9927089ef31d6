#pragma once
// The plain fixed-size values that operations take and return. They follow the conventions of the README's
// notation table: twist and wrench linear part first, quaternion x y z w, a pose acts on points.

#include <Eigen/Core>
#include <boost/multiprecision/float128.hpp>

namespace liecheck::properties {

using float128 = boost::multiprecision::float128;

template <class S, int N>
using Vec = Eigen::Matrix<S, N, 1>;
template <class S, int R, int C = R>
using Mat = Eigen::Matrix<S, R, C>;
template <class S>
using VecX = Eigen::Matrix<S, Eigen::Dynamic, 1>;
template <class S>
using MatX = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

/// The matrix [v] of the cross product: [v] w = v x w.
template <class S>
Mat<S, 3> hat(const Vec<S, 3>& v) {
  Mat<S, 3> m;
  m << S(0), -v.z(), v.y(), v.z(), S(0), -v.x(), -v.y(), v.x(), S(0);
  return m;
}

/// R_AB, p_AB_A: a pose by its rotation matrix.
template <class S>
struct Pose {
  Mat<S, 3> R;
  Vec<S, 3> p;
};

/// A rigid body's mass, centre of mass and inertia about the centre of mass.
template <class S>
struct Body {
  S mass;
  Vec<S, 3> c;
  Mat<S, 3> I_C;
};

/// The reference point and axes of a frame's velocity, acceleration or Jacobian.
enum class Seen { world, local, aligned };

}  // namespace liecheck::properties

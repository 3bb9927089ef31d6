#pragma once
// The generators of rotations.hpp for the laws' scalars. compiled.cpp compiles them once.

#include <boost/multiprecision/float128.hpp>
#include <generators/rotations.hpp>

namespace liecheck::properties {

using float128 = boost::multiprecision::float128;
extern template decltype(angle<float>) angle<float>;
extern template decltype(angle<double>) angle<double>;
extern template decltype(angle<float128>) angle<float128>;
extern template decltype(direction<float>) direction<float>;
extern template decltype(direction<double>) direction<double>;
extern template decltype(direction<float128>) direction<float128>;
extern template decltype(vector3<float>) vector3<float>;
extern template decltype(vector3<double>) vector3<double>;
extern template decltype(vector3<float128>) vector3<float128>;
extern template decltype(unit_quaternion<float>) unit_quaternion<float>;
extern template decltype(unit_quaternion<double>) unit_quaternion<double>;
extern template decltype(unit_quaternion<float128>) unit_quaternion<float128>;
extern template decltype(rotation_matrix<float>) rotation_matrix<float>;
extern template decltype(rotation_matrix<double>) rotation_matrix<double>;
extern template decltype(rotation_matrix<float128>) rotation_matrix<float128>;

}  // namespace liecheck::properties

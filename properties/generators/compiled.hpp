#pragma once
// The generators of rotations.hpp for the laws' scalars. compiled.cpp compiles them once.

#include <generators/rotations.hpp>
#include <subjects/subject.hpp>

namespace liecheck::properties {

extern template decltype(angle<float>) angle<float>;
extern template decltype(angle<double>) angle<double>;
extern template decltype(angle<float128>) angle<float128>;
extern template decltype(magnitude<float>) magnitude<float>;
extern template decltype(magnitude<double>) magnitude<double>;
extern template decltype(magnitude<float128>) magnitude<float128>;
extern template decltype(step_ulps<float>) step_ulps<float>;
extern template decltype(step_ulps<double>) step_ulps<double>;
extern template decltype(step_ulps<float128>) step_ulps<float128>;
extern template decltype(common_cutoffs<float>) common_cutoffs<float>;
extern template decltype(common_cutoffs<double>) common_cutoffs<double>;
extern template decltype(common_cutoffs<float128>) common_cutoffs<float128>;
extern template decltype(direction<float>) direction<float>;
extern template decltype(direction<double>) direction<double>;
extern template decltype(direction<float128>) direction<float128>;
extern template decltype(rotation_vector<float>) rotation_vector<float>;
extern template decltype(rotation_vector<double>) rotation_vector<double>;
extern template decltype(rotation_vector<float128>) rotation_vector<float128>;
extern template decltype(vector3<float>) vector3<float>;
extern template decltype(vector3<double>) vector3<double>;
extern template decltype(vector3<float128>) vector3<float128>;
extern template decltype(unit_quaternion<float>) unit_quaternion<float>;
extern template decltype(unit_quaternion<double>) unit_quaternion<double>;
extern template decltype(unit_quaternion<float128>) unit_quaternion<float128>;
extern template decltype(rotation_matrix<float>) rotation_matrix<float>;
extern template decltype(rotation_matrix<double>) rotation_matrix<double>;
extern template decltype(rotation_matrix<float128>) rotation_matrix<float128>;
extern template decltype(quaternion_near<float>) quaternion_near<float>;
extern template decltype(quaternion_near<double>) quaternion_near<double>;
extern template decltype(quaternion_near<float128>) quaternion_near<float128>;
extern template decltype(point_near<float>) point_near<float>;
extern template decltype(point_near<double>) point_near<double>;
extern template decltype(point_near<float128>) point_near<float128>;

}  // namespace liecheck::properties

#include <generators/compiled.hpp>

namespace liecheck::properties {

template decltype(angle<float>) angle<float>;
template decltype(angle<double>) angle<double>;
template decltype(angle<float128>) angle<float128>;
template decltype(magnitude<float>) magnitude<float>;
template decltype(magnitude<double>) magnitude<double>;
template decltype(magnitude<float128>) magnitude<float128>;
template decltype(step_ulps<float>) step_ulps<float>;
template decltype(step_ulps<double>) step_ulps<double>;
template decltype(step_ulps<float128>) step_ulps<float128>;
template decltype(common_cutoffs<float>) common_cutoffs<float>;
template decltype(common_cutoffs<double>) common_cutoffs<double>;
template decltype(common_cutoffs<float128>) common_cutoffs<float128>;
template decltype(direction<float>) direction<float>;
template decltype(direction<double>) direction<double>;
template decltype(direction<float128>) direction<float128>;
template decltype(rotation_vector<float>) rotation_vector<float>;
template decltype(rotation_vector<double>) rotation_vector<double>;
template decltype(rotation_vector<float128>) rotation_vector<float128>;
template decltype(vector3<float>) vector3<float>;
template decltype(vector3<double>) vector3<double>;
template decltype(vector3<float128>) vector3<float128>;
template decltype(unit_quaternion<float>) unit_quaternion<float>;
template decltype(unit_quaternion<double>) unit_quaternion<double>;
template decltype(unit_quaternion<float128>) unit_quaternion<float128>;
template decltype(rotation_matrix<float>) rotation_matrix<float>;
template decltype(rotation_matrix<double>) rotation_matrix<double>;
template decltype(rotation_matrix<float128>) rotation_matrix<float128>;
template decltype(quaternion_near<float>) quaternion_near<float>;
template decltype(quaternion_near<double>) quaternion_near<double>;
template decltype(quaternion_near<float128>) quaternion_near<float128>;
template decltype(point_near<float>) point_near<float>;
template decltype(point_near<double>) point_near<double>;
template decltype(point_near<float128>) point_near<float128>;

}  // namespace liecheck::properties

#include <generators/compiled.hpp>

namespace liecheck::properties {

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

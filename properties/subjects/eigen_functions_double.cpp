#include <subjects/eigen_matrix_functions.hpp>

namespace liecheck::properties {

template Eigen::Matrix4d matrix_exp(const Eigen::Matrix4d&);
template Eigen::Matrix4d matrix_log(const Eigen::Matrix4d&);

}  // namespace liecheck::properties

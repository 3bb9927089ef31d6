#include <subjects/eigen_matrix_functions.hpp>

namespace liecheck::properties {

template Eigen::Matrix4f matrix_exp(const Eigen::Matrix4f&);
template Eigen::Matrix4f matrix_log(const Eigen::Matrix4f&);

}  // namespace liecheck::properties

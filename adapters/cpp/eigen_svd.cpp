// What eigen.cpp leaves out, so that no compiler needs more than 1 GB.

#include <Eigen/SVD>

template class Eigen::JacobiSVD<Eigen::Matrix<float, 2, 3>>;
template class Eigen::JacobiSVD<Eigen::Matrix<double, 2, 3>>;

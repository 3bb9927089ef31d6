#pragma once
// The algorithms of trees in float128, compiled once, in float128_algorithms.cpp and float128_tree.cpp.

#include <boost/multiprecision/eigen.hpp>
#include <boost/multiprecision/float128.hpp>
#include <liecheck/algorithms/aba.hpp>

namespace liecheck {

using boost::multiprecision::float128;
extern template class Model<float128>;
extern template class Data<float128>;
extern template Model<float128> Model<double>::cast<float128>() const;
extern template decltype(aba<float128>) aba<float128>;
extern template decltype(algorithms_detail::bodiesInWorldAxes<float128>)
    algorithms_detail::bodiesInWorldAxes<float128>;
extern template decltype(algorithms_detail::articulatedBodies<float128>)
    algorithms_detail::articulatedBodies<float128>;
extern template void forwardKinematics(const Model<float128>&, Data<float128>&, In<float128>);
extern template void forwardKinematics(const Model<float128>&, Data<float128>&, In<float128>, In<float128>);
extern template void forwardKinematics(const Model<float128>&, Data<float128>&, In<float128>, In<float128>,
                                       In<float128>);

/// The robot with its rotation matrices and axes orthonormal in float128: a stored matrix stands for the
/// rotation nearest to it, and Model::cast converts the rounding errors of double as they are.
Model<float128> sharpened(const Model<double>& robot);

}  // namespace liecheck

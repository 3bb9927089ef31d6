#include <scenes/liecheck_runner.hpp>

namespace liecheck {

template class Model<float128>;
template class Data<float128>;
template Model<float128> Model<double>::cast<float128>() const;
template void forwardKinematics(const Model<float128>&, Data<float128>&, In<float128>);
template void forwardKinematics(const Model<float128>&, Data<float128>&, In<float128>, In<float128>);
template void forwardKinematics(const Model<float128>&, Data<float128>&, In<float128>, In<float128>,
                                In<float128>);

namespace properties {

template std::unique_ptr<Runner> liecheck_runner<Float128Tree>(const Benchmark&, const std::string&,
                                                               const scene::Effects<float128>&);

}  // namespace properties
}  // namespace liecheck

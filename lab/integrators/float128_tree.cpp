#include <integrators/liecheck_runner.hpp>
#include <oracles/motions/maximal_tree.hpp>

namespace liecheck {

template class Model<float128>;
template class Data<float128>;
template Model<float128> Model<double>::cast<float128>() const;
template void forwardKinematics(const Model<float128>&, Data<float128>&, In<float128>);
template void forwardKinematics(const Model<float128>&, Data<float128>&, In<float128>, In<float128>);
template void forwardKinematics(const Model<float128>&, Data<float128>&, In<float128>, In<float128>,
                                In<float128>);

Model<float128> sharpened(const Model<double>& robot) {
  Model<float128> m = robot.cast<float128>();
  const auto sharpen = [](SE3<float128>& X) {
    X = SE3<float128>(oracles::nearest_rotation<float128>(X.rotation()), X.translation());
  };
  for (auto& X : m.jointPlacements) sharpen(X);
  for (auto& f : m.frames) sharpen(f.placement);
  for (auto& joint : m.joints)
    std::visit(
        [](auto& j) {
          if constexpr (requires { j.axis; }) j.axis = Axis<float128>(j.axis.to_vector());
        },
        joint);
  return m;
}

namespace properties {

template MakeRunner<Float128Tree> liecheck_runner<Float128Tree>;

}  // namespace properties
}  // namespace liecheck

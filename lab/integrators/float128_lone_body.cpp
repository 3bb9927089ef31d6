#include <integrators/liecheck_runner.hpp>

namespace liecheck {

template scene::LoneBody<float128>::LoneBody(const Model<float128>&, scene::Effects<float128>);
template struct scene::CollocationPoints<float128>;

namespace properties {

template std::unique_ptr<scene::Method<Float128LoneBody>> make_float128_method(const std::string&,
                                                                               const scene::MethodOptions&);
template std::unique_ptr<Runner> liecheck_runner<Float128LoneBody>(const Benchmark&, const std::string&,
                                                                   const scene::Effects<float128>&);

}  // namespace properties
}  // namespace liecheck

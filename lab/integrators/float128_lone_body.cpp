#include <integrators/liecheck_runner.hpp>

namespace liecheck {

template scene::LoneBody<float128>::LoneBody(const Model<float128>&, scene::Effects<float128>);
template struct scene::CollocationPoints<float128>;

namespace properties {

template std::unique_ptr<scene::Method<Float128LoneBody>> make_float128_method(const std::string&,
                                                                               const scene::MethodOptions&);
template MakeRunner<Float128LoneBody> liecheck_runner<Float128LoneBody>;

}  // namespace properties
}  // namespace liecheck

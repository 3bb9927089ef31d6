#include <scenes/liecheck_runner.hpp>

namespace liecheck::properties {

template std::unique_ptr<scene::Method<Float128LoneBody>> make_float128_method(const std::string&,
                                                                               const scene::MethodOptions&);
template std::unique_ptr<Runner> liecheck_runner<Float128LoneBody>(const Benchmark&, const std::string&,
                                                                   const scene::Effects<float128>&);

}  // namespace liecheck::properties

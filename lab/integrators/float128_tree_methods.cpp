#include <integrators/liecheck_runner.hpp>

namespace liecheck::properties {

template std::unique_ptr<scene::Method<Float128Tree>> make_float128_method(const std::string&,
                                                                           const scene::MethodOptions&);

}  // namespace liecheck::properties

#include <scenes/liecheck_runner.hpp>

namespace liecheck::properties {

template std::unique_ptr<scene::Method<Float128Tree>> make_float128_collocation(const std::string&);

}  // namespace liecheck::properties

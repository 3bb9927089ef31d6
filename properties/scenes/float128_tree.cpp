#include <scenes/liecheck_runner.hpp>

namespace liecheck::properties {

template std::unique_ptr<Runner> liecheck_runner<Float128Tree>(const Benchmark&, const std::string&,
                                                               const scene::Effects<float128>&);

}  // namespace liecheck::properties

#include <integrators/float128_algorithms.hpp>

namespace liecheck {

template decltype(aba<float128>) aba<float128>;
template decltype(algorithms_detail::bodiesInWorldAxes<float128>)
    algorithms_detail::bodiesInWorldAxes<float128>;
template decltype(algorithms_detail::articulatedBodies<float128>)
    algorithms_detail::articulatedBodies<float128>;

}  // namespace liecheck

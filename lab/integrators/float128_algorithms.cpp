#include <integrators/float128_algorithms.hpp>

namespace liecheck {

template decltype(aba<float128>) aba<float128>;

}  // namespace liecheck

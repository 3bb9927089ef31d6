// Explicit instantiations for float and double, declared extern in derivatives.hpp.

#include <liecheck/algorithms/derivatives.hpp>

namespace liecheck {

template decltype(computeRNEADerivatives<float>) computeRNEADerivatives<float>;
template decltype(computeABADerivatives<float>) computeABADerivatives<float>;
template decltype(computeRNEADerivatives<double>) computeRNEADerivatives<double>;
template decltype(computeABADerivatives<double>) computeABADerivatives<double>;

}  // namespace liecheck

// Explicit instantiations for float, declared extern in the headers.

#include <liecheck/multibody/configuration.hpp>
#include <liecheck/multibody/data.hpp>

namespace liecheck {

template class Model<float>;
template class Data<float>;
template decltype(neutral<float>) neutral<float>;
template decltype(normalized<float>) normalized<float>;
template VectorX<float> integrate<float>(const Model<float>&, In<float>, In<float>);
template VectorX<float> difference<float>(const Model<float>&, In<float>, In<float>);
template decltype(isSameConfiguration<float>) isSameConfiguration<float>;
template decltype(isNormalized<float>) isNormalized<float>;
template decltype(squaredDistance<float>) squaredDistance<float>;
template decltype(dIntegrate<float>) dIntegrate<float>;
template decltype(dDifference<float>) dDifference<float>;
template decltype(integrateCoeffWiseJacobian<float>) integrateCoeffWiseJacobian<float>;

}  // namespace liecheck

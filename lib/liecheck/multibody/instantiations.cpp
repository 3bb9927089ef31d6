// Explicit instantiations for float and double, declared extern in the headers.

#include <liecheck/multibody/configuration.hpp>
#include <liecheck/multibody/data.hpp>

namespace liecheck {

template class Model<float>;
template class Model<double>;
template Model<float> Model<double>::cast<float>() const;
template Model<double> Model<double>::cast<double>() const;
template class Data<float>;
template class Data<double>;

template decltype(neutral<float>) neutral<float>;
template decltype(normalized<float>) normalized<float>;
template decltype(integrate<float>) integrate<float>;
template VectorX<float> difference<float>(const Model<float>&, In<float>, In<float>);
template decltype(isSameConfiguration<float>) isSameConfiguration<float>;
template decltype(isNormalized<float>) isNormalized<float>;
template decltype(squaredDistance<float>) squaredDistance<float>;
template decltype(dIntegrate<float>) dIntegrate<float>;
template decltype(dDifference<float>) dDifference<float>;
template decltype(integrateCoeffWiseJacobian<float>) integrateCoeffWiseJacobian<float>;

template decltype(neutral<double>) neutral<double>;
template decltype(normalized<double>) normalized<double>;
template decltype(integrate<double>) integrate<double>;
template VectorX<double> difference<double>(const Model<double>&, In<double>, In<double>);
template decltype(isSameConfiguration<double>) isSameConfiguration<double>;
template decltype(isNormalized<double>) isNormalized<double>;
template decltype(squaredDistance<double>) squaredDistance<double>;
template decltype(dIntegrate<double>) dIntegrate<double>;
template decltype(dDifference<double>) dDifference<double>;
template decltype(integrateCoeffWiseJacobian<double>) integrateCoeffWiseJacobian<double>;

}  // namespace liecheck

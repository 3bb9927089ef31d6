// Explicit instantiations for double, declared extern in the headers.

#include <liecheck/multibody/configuration.hpp>
#include <liecheck/multibody/data.hpp>

namespace liecheck {

template class Model<double>;
template Model<float> Model<double>::cast<float>() const;
template Model<double> Model<double>::cast<double>() const;
template class Data<double>;
template decltype(neutral<double>) neutral<double>;
template decltype(normalized<double>) normalized<double>;
template VectorX<double> integrate<double>(const Model<double>&, In<double>, In<double>);
template VectorX<double> difference<double>(const Model<double>&, In<double>, In<double>);
template decltype(isSameConfiguration<double>) isSameConfiguration<double>;
template decltype(isNormalized<double>) isNormalized<double>;
template decltype(squaredDistance<double>) squaredDistance<double>;
template decltype(dIntegrate<double>) dIntegrate<double>;
template decltype(dDifference<double>) dDifference<double>;
template decltype(integrateCoeffWiseJacobian<double>) integrateCoeffWiseJacobian<double>;

}  // namespace liecheck

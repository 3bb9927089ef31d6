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

template VectorX<float> neutral<float>(const Model<float>&);
template VectorX<float> normalized<float>(const Model<float>&, const VectorX<float>&);
template void normalize<float>(const Model<float>&, VectorX<float>&);
template bool isNormalized<float>(const Model<float>&, const VectorX<float>&, const float&);
template VectorX<float> integrate<float>(const Model<float>&, const VectorX<float>&, const VectorX<float>&);
template VectorX<float> difference<float>(const Model<float>&, const VectorX<float>&, const VectorX<float>&);
template VectorX<float> interpolate<float>(const Model<float>&, const VectorX<float>&, const VectorX<float>&,
                                           const float&);
template VectorX<float> squaredDistance<float>(const Model<float>&, const VectorX<float>&,
                                               const VectorX<float>&);
template float distance<float>(const Model<float>&, const VectorX<float>&, const VectorX<float>&);
template float distance<float>(const Model<float>&, const VectorX<float>&, const VectorX<float>&,
                               const VectorX<float>&);
template bool isSameConfiguration<float>(const Model<float>&, const VectorX<float>&, const VectorX<float>&,
                                         const float&);
template MatrixX<float> dIntegrate<float>(const Model<float>&, const VectorX<float>&, const VectorX<float>&,
                                          ArgumentPosition);
template MatrixX<float> dDifference<float>(const Model<float>&, const VectorX<float>&, const VectorX<float>&,
                                           ArgumentPosition);
template MatrixX<float> integrateCoeffWiseJacobian<float>(const Model<float>&, const VectorX<float>&);
template VectorX<float> checkedConfiguration<float>(const Model<float>&, const VectorX<float>&);
template VectorX<float> checkedTangent<float>(const Model<float>&, const VectorX<float>&);

template VectorX<double> neutral<double>(const Model<double>&);
template VectorX<double> normalized<double>(const Model<double>&, const VectorX<double>&);
template void normalize<double>(const Model<double>&, VectorX<double>&);
template bool isNormalized<double>(const Model<double>&, const VectorX<double>&, const double&);
template VectorX<double> integrate<double>(const Model<double>&, const VectorX<double>&,
                                           const VectorX<double>&);
template VectorX<double> difference<double>(const Model<double>&, const VectorX<double>&,
                                            const VectorX<double>&);
template VectorX<double> interpolate<double>(const Model<double>&, const VectorX<double>&,
                                             const VectorX<double>&, const double&);
template VectorX<double> squaredDistance<double>(const Model<double>&, const VectorX<double>&,
                                                 const VectorX<double>&);
template double distance<double>(const Model<double>&, const VectorX<double>&, const VectorX<double>&);
template double distance<double>(const Model<double>&, const VectorX<double>&, const VectorX<double>&,
                                 const VectorX<double>&);
template bool isSameConfiguration<double>(const Model<double>&, const VectorX<double>&,
                                          const VectorX<double>&, const double&);
template MatrixX<double> dIntegrate<double>(const Model<double>&, const VectorX<double>&,
                                            const VectorX<double>&, ArgumentPosition);
template MatrixX<double> dDifference<double>(const Model<double>&, const VectorX<double>&,
                                             const VectorX<double>&, ArgumentPosition);
template MatrixX<double> integrateCoeffWiseJacobian<double>(const Model<double>&, const VectorX<double>&);
template VectorX<double> checkedConfiguration<double>(const Model<double>&, const VectorX<double>&);
template VectorX<double> checkedTangent<double>(const Model<double>&, const VectorX<double>&);

}  // namespace liecheck

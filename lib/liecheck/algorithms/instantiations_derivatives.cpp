// Explicit instantiations of the derivatives of the dynamics for float and double, declared extern in the header.

#include <liecheck/algorithms/derivatives.hpp>

namespace liecheck {

template void computeRNEADerivatives<float>(const Model<float>&, Data<float>&, In<float>, In<float>,
                                            In<float>, External<float>);
template void computeABADerivatives<float>(const Model<float>&, Data<float>&, In<float>, In<float>, In<float>,
                                           External<float>);
template void computeRNEADerivatives<double>(const Model<double>&, Data<double>&, In<double>, In<double>,
                                             In<double>, External<double>);
template void computeABADerivatives<double>(const Model<double>&, Data<double>&, In<double>, In<double>,
                                            In<double>, External<double>);

}  // namespace liecheck

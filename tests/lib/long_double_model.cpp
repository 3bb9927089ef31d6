#include "long_double.hpp"

namespace liecheck {

template class Model<Real>;
template class Data<Real>;
template Model<Real> Model<double>::cast<Real>() const;
template VectorX<Real> integrate<Real>(const Model<Real>&, const VectorX<Real>&, const VectorX<Real>&);
template VectorX<Real> difference<Real>(const Model<Real>&, const VectorX<Real>&, const VectorX<Real>&);

}  // namespace liecheck

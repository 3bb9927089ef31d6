// liecheck's own library in float128, for `liecheck cost`.

#include <subjects/liecheck_operations.hpp>
#include <wide/wide_scalars.hpp>

namespace liecheck::properties {

template <>
TypedOperations<float128> wide_scalar_operations() {
  return LiecheckOperations<float128>::make().operations;
}

}  // namespace liecheck::properties

// liecheck's own library in the double-double type of the QD library. Only `liecheck cost` uses it.

#include <wide/wide_scalars.hpp>

#ifdef LIECHECK_QD
#include <subjects/liecheck_operations.hpp>

namespace liecheck::properties {

template <>
TypedOperations<dd_real> wide_scalar_operations() {
  return LiecheckOperations<dd_real>::make().operations;
}

}  // namespace liecheck::properties
#endif

// liecheck's own library with 50 digits. Only `liecheck cost` uses it.

#include <subjects/liecheck_operations.hpp>
#include <wide/wide_scalars.hpp>

namespace liecheck::properties {

template <>
TypedOperations<Digits50> wide_scalar_operations() {
  return LiecheckOperations<Digits50>::make().operations;
}

}  // namespace liecheck::properties

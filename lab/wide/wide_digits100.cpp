// liecheck's own library with 100 digits. Only `liecheck cost` uses it.

#include <subjects/liecheck_operations.hpp>
#include <wide/wide_scalars.hpp>

namespace liecheck::properties {

template <>
TypedOperations<Digits100> wide_scalar_operations() {
  return LiecheckOperations<Digits100>::make().operations;
}

}  // namespace liecheck::properties

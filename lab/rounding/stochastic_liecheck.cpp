#include <rounding/subjects.hpp>
#include <subjects/liecheck_operations.hpp>

namespace liecheck::properties {

TypedSubject<Stochastic> stochastic_liecheck() {
  return LiecheckOperations<Stochastic>::make();
}

}  // namespace liecheck::properties

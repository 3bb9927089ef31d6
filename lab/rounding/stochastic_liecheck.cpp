#include <rounding/subjects.hpp>
#include <subjects/liecheck_operations.hpp>

namespace liecheck::properties {

Subject<Stochastic> stochastic_liecheck() {
  return LiecheckOperations<Stochastic>::make();
}

}  // namespace liecheck::properties

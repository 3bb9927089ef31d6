#include <subjects/rounded_calls.hpp>

namespace liecheck::properties {

template Subject erased(const TypedSubject<double>&);

}  // namespace liecheck::properties

#include <rounding/subjects.hpp>
#include <subjects/textbook.hpp>

namespace liecheck::properties {

std::vector<TypedSubject<Stochastic>> stochastic_textbooks() {
  return {Textbook<Stochastic>::make<8, false>(), Textbook<Stochastic>::make<3, true>()};
}

}  // namespace liecheck::properties

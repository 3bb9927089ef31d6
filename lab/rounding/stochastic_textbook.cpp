#include <rounding/subjects.hpp>
#include <subjects/textbook_subject.hpp>

namespace liecheck::properties {

std::vector<TypedSubject<Stochastic>> stochastic_textbooks() {
  return {TextbookSubject<Stochastic>::make<8, false>(), TextbookSubject<Stochastic>::make<3, true>()};
}

}  // namespace liecheck::properties

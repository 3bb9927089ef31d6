// Subject "textbook" in float and double: subjects/textbook.hpp. It is the positive control: every campaign over all
// subjects must find its large errors near the cutoff. The variants textbook:1e-1 ... textbook:1e-12 have the cutoff
// in their name and run only if they are named.

#include <subjects/textbook.hpp>

#include <utility>
#include <vector>

namespace liecheck::properties {
namespace {

const Registered<float> in_float(Textbook<float>::make<8, false>());
const Registered<double> in_double(Textbook<double>::make<8, false>());

template <class S, int... i>
std::vector<Registered<S>> variants(std::integer_sequence<int, i...>) {
  return {Registered<S>(Textbook<S>::template make<i + 1, true>())...};
}
const auto variants_in_float = variants<float>(std::make_integer_sequence<int, 12>());
const auto variants_in_double = variants<double>(std::make_integer_sequence<int, 12>());

}  // namespace
}  // namespace liecheck::properties

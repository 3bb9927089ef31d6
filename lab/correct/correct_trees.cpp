#include <correct/correct_kane.hpp>
#include <correct/correct_lagrange.hpp>
#include <correct/correct_newton.hpp>

namespace liecheck::properties::correct {
namespace {

template <class S, template <class> class Of>
TypedSubject<S> subject(const char* name, const char* version) {
  TypedSubject<S> s{name, version, {}};
  s.operations.tree = bind<Of<S>, S>;
  return s;
}
template <class S>
struct RegisteredTrees {
  Registered<S> lagrange{subject<S, DenseTree>("correct:lagrange", "dense Jacobians in body axes")};
  Registered<S> kane{subject<S, KaneTree>("correct:kane", "centres of mass in world axes")};
  Registered<S> newton{subject<S, NewtonTree>("correct:newton", "recursion in the axes of each body")};
};
const RegisteredTrees<float> in_float;
const RegisteredTrees<double> in_double;

}  // namespace
}  // namespace liecheck::properties::correct

// liecheck's own library in float and double; liecheck:fast and liecheck:tight run where they are named.

#include <subjects/own.hpp>
#include <subjects/own_tree.hpp>

namespace liecheck::properties {
namespace {

template <class S>
Subject<S> whole() {
  Subject<S> s = Own<S>::with_robots();
  s.operations.tree = &own_tree<S>;
  return s;
}

const Registered<float> in_float(whole<float>());
const Registered<double> in_double(whole<double>());
const Registered<float> fast_in_float(Own<float, Precision::fast>::make());
const Registered<double> fast_in_double(Own<double, Precision::fast>::make());
const Registered<float> tight_in_float(Own<float, Precision::tight>::make());
const Registered<double> tight_in_double(Own<double, Precision::tight>::make());

}  // namespace
}  // namespace liecheck::properties

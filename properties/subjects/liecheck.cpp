// liecheck's own library in float and double. liecheck:fast and liecheck:tight run only if they are named.

#include <subjects/liecheck_operations.hpp>
#include <subjects/liecheck_trees.hpp>

namespace liecheck::properties {
namespace {

template <class S>
Subject<S> whole() {
  Subject<S> s = LiecheckOperations<S>::with_robots();
  s.operations.tree = &liecheck_tree<S>;
  return s;
}

const Registered<float> in_float(whole<float>());
const Registered<double> in_double(whole<double>());
const Registered<float> fast_in_float(LiecheckOperations<float, Precision::fast>::make());
const Registered<double> fast_in_double(LiecheckOperations<double, Precision::fast>::make());
const Registered<float> tight_in_float(LiecheckOperations<float, Precision::tight>::make());
const Registered<double> tight_in_double(LiecheckOperations<double, Precision::tight>::make());

}  // namespace
}  // namespace liecheck::properties

#pragma once
// A pose and an increment without zeros or symmetry.

#include <liecheck/multibody/se3_configuration.hpp>

namespace liecheck::test {

template <class S>
Vector7<S> generic() {
  Vector7<S> q;
  q << S(0.3), S(-1.2), S(2.5), SO3<S>(Vector4<S>(S(0.4), S(-0.2), S(0.5), S(-0.7))).normalized().to_vector();
  return q;
}
template <class S>
Vector6<S> increment() {
  Vector6<S> d;
  d << S(0.7), S(-0.4), S(1.1), S(0.9), S(-1.3), S(0.6);
  return d;
}
template <class A, class B>
auto error(const A& a, const B& b) {
  return (a - b).norm();
}

}  // namespace liecheck::test

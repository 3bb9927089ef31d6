#pragma once
// Calls a function of an operation with consecutive numbers, as docs/operations.md orders them.

#include <adapters/shapes.hpp>
#include <functional>
#include <tuple>
#include <utility>
#include <vector>

namespace liecheck::properties::adapters {

/// The numbers of f(arguments), in the scalar S of its arguments.
template <class S, class F, class R, class... A>
std::vector<S> called_as(const F& f, R (*)(A...), const std::vector<double>& arguments) {
  const std::vector<S> in(arguments.begin(), arguments.end());
  std::vector<S> result(Shape<R>::size);
  const S* at = in.data();
  const auto next = [&]<class T>(const T*) {
    const S* const here = std::exchange(at, at + Shape<T>::size);
    return Shape<T>::get(here);
  };
  // The braces of a tuple evaluate the arguments in their order.
  const std::tuple<std::remove_cvref_t<A>...> all{next(static_cast<std::remove_cvref_t<A>*>(nullptr))...};
  Shape<R>::put(std::apply(f, all), result.data());
  return result;
}
template <class S, class R, class... A>
std::vector<S> called(R (*f)(A...), const std::vector<double>& arguments) {
  return called_as<S>(f, f, arguments);
}
template <class S, class R, class... A>
std::vector<S> called(const std::function<R(A...)>& f, const std::vector<double>& arguments) {
  return called_as<S>(f, static_cast<R (*)(A...)>(nullptr), arguments);
}

}  // namespace liecheck::properties::adapters

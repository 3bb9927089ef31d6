#pragma once
// The arguments and results of operations as consecutive numbers: matrices row by row, a pose as R and p, a body as mass,
// c and I_C; an index, a reference and a truth value are one number. docs/operations.md has the order of each operation.

#include <operations/description.hpp>
#include <operations/values.hpp>
#include <span>
#include <vector>

namespace liecheck::properties {

/// The lengths of q and v of a robot or tree; 0 for values of fixed size.
struct ModelSize {
  int nq = 0, nv = 0;
};

/// How many numbers a part has.
constexpr int size_of(const Part& part, ModelSize model) {
  switch (part.size) {
    case nq:
      return model.nq;
    case nv:
      return model.nv;
    case nv_by_nv:
      return model.nv * model.nv;
    case six_by_nv:
      return 6 * model.nv;
    case three_by_nv:
      return 3 * model.nv;
    default:
      return part.size;
  }
}
/// How many numbers the values of some layouts have. The reference of a frame has no parts, and is one number.
constexpr std::size_t count_numbers(const auto& layouts, ModelSize model = {}) {
  int n = 0;
  for (const Layout* layout : layouts) {
    if (layout->parts.size() == 0) ++n;
    for (const Part& part : layout->parts) n += size_of(part, model);
  }
  return static_cast<std::size_t>(n);
}

/// Calls visit(number) for each number of a value, in their order.
template <class Value>
void for_each_number(Value& value, const auto& visit) {
  if constexpr (requires { value.rows(); }) {
    for (Eigen::Index i = 0; i < value.rows(); ++i)
      for (Eigen::Index j = 0; j < value.cols(); ++j) visit(value(i, j));
  } else if constexpr (requires { value.I_C; }) {
    visit(value.mass), for_each_number(value.c, visit), for_each_number(value.I_C, visit);
  } else if constexpr (requires { value.R; }) {
    for_each_number(value.R, visit), for_each_number(value.p, visit);
  } else if constexpr (requires { value.second; }) {
    for_each_number(value.first, visit), for_each_number(value.second, visit);
  } else {
    visit(value);
  }
}

/// Writes the numbers of a value, and moves `to` behind them.
template <class S, class Value>
void put_numbers(const Value& value, S*& to) {
  for_each_number(value, [&to](const auto& number) {
    if constexpr (std::is_enum_v<std::remove_cvref_t<decltype(number)>>)
      *to++ = static_cast<S>(static_cast<int>(number));
    else
      *to++ = static_cast<S>(number);
  });
}

/// Reads a value of this layout, and moves `from` behind its numbers.
template <class Value, class S>
Value take_numbers(const S*& from, const Layout& layout, ModelSize model) {
  Value value;
  const auto matrix = [model](const Part& part) {
    return MatX<S>(part.size == six_by_nv ? 6 : part.size == three_by_nv ? 3 : model.nv, model.nv);
  };
  if constexpr (std::is_same_v<Value, VecX<S>>)
    value.resize(size_of(layout.parts[0], model));
  else if constexpr (std::is_same_v<Value, MatX<S>>)
    value = matrix(layout.parts[0]);
  else if constexpr (std::is_same_v<Value, std::pair<MatX<S>, MatX<S>>>)
    value = {matrix(layout.parts[0]), matrix(layout.parts[1])};
  for_each_number(value, [&from](auto& number) {
    using Number = std::remove_cvref_t<decltype(number)>;
    if constexpr (std::is_enum_v<Number>)
      number = static_cast<Number>(static_cast<int>(*from++));
    else if constexpr (std::is_same_v<Number, S>)
      number = *from++;
    else if constexpr (std::is_same_v<Number, bool>)
      number = *from++ != S(0);
    else
      number = static_cast<Number>(*from++);
  });
  return value;
}

/// The numbers of f(arguments) in the scalar S.
template <class S, class F, class R, class... A>
std::vector<S> called_as(const F& f, R (*)(const A&...), const Operation& operation, const S* arguments,
                         ModelSize model = {}) {
  auto next = [layout = operation.arguments.begin()]() mutable -> const Layout& { return **layout++; };
  // The braces of a tuple evaluate the arguments in their order.
  const std::tuple<A...> all{take_numbers<A>(arguments, next(), model)...};
  const R result = std::apply(f, all);
  std::vector<S> numbers;
  for_each_number(result, [&](const auto& number) { numbers.push_back(static_cast<S>(number)); });
  return numbers;
}
template <class S, class R, class... A>
std::vector<S> called(R (*f)(const A&...), const Operation& operation, const S* arguments) {
  return called_as<S>(f, f, operation, arguments);
}
template <class S, class R, class... A>
std::vector<S> called(const std::function<R(const A&...)>& f, const Operation& operation, const S* arguments,
                      ModelSize model = {}) {
  return called_as<S>(f, static_cast<R (*)(const A&...)>(nullptr), operation, arguments, model);
}

}  // namespace liecheck::properties

#pragma once
// The exact results of operations as functions of consecutive numbers, by the operation's name.

#include <functional>
#include <map>
#include <oracles/ball_oracles.hpp>
#include <oracles/orientations.hpp>
#include <string_view>
#include <tuple>
#include <vector>

namespace liecheck::properties::conventions {

namespace formula_detail {

using namespace oracles;

/// Reads values one after the other. B is a ball, which proves that a result is accurate, or a Real.
template <class B>
class Reader {
 public:
  explicit Reader(const std::vector<B>& numbers) : at_(numbers.data()), end_(at_ + numbers.size()) {}
  template <class Value>
  Value take() {
    if constexpr (requires(Value v) { v.I_C; }) {
      return {take<B>(), take<Vec3<B>>(), take<Mat3<B>>()};  // the braces evaluate in this order
    } else if constexpr (requires(Value v) { v.R; }) {
      return {take<Mat3<B>>(), take<Vec3<B>>()};
    } else if constexpr (requires(Value v) { v.x; }) {
      Value m;
      for (B& x : m.x) x = next();
      return m;
    } else if constexpr (std::is_same_v<Value, Order>) {
      return Order(static_cast<int>(next()));
    } else {
      return next();
    }
  }

 private:
  const B& next() {
    if (at_ == end_) throw std::logic_error("too few numbers");
    return *at_++;
  }
  const B *at_, *end_;
};

/// Appends the numbers of a value, or of the result of an oracle.
template <class B, class Value>
void append(std::vector<B>& to, const Value& v) {
  if constexpr (std::is_same_v<Value, B>)
    to.push_back(v);
  else if constexpr (requires { v.I_C; })
    append(to, v.mass), append(to, v.c), append(to, v.I_C);
  else if constexpr (requires { v.second; })
    append(to, v.first), append(to, v.second);
  else if constexpr (requires { v.R, v.p; })
    append(to, v.R), append(to, v.p);
  else if constexpr (requires { v.matrix(); })
    append(to, v.matrix());
  else if constexpr (requires { v.value(); })
    append(to, v.value());
  else if constexpr (requires { v.resolved; })
    append(to, v.value);
  else
    to.insert(to.end(), v.x.begin(), v.x.end());
}

template <class B>
using Formula = std::function<std::vector<B>(Reader<B>)>;
template <class B>
using Formulas = std::map<std::string_view, Formula<B>>;

/// The formula that reads arguments of these types, one after the other.
template <class B, class... A, class F>
Formula<B> of(F f) {
  return [f](Reader<B> x) {
    const std::tuple<A...> arguments{x.template take<A>()...};
    std::vector<B> numbers;
    numbers.reserve(36);  // of the largest result
    append(numbers, std::apply(f, arguments));
    return numbers;
  };
}

}  // namespace formula_detail

formula_detail::Formulas<oracles::Real> representations();
formula_detail::Formulas<oracles::Real> transforms();
formula_detail::Formulas<oracles::Real> navigation();

}  // namespace liecheck::properties::conventions

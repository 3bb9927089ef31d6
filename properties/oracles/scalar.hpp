#pragma once
// The scalar of a subject as a value: what budgets are scaled by, and what a subject's numbers are rounded to.
//
// Every float is exactly a double. So the numbers of a case travel as doubles, and one program measures the results of
// every scalar. Only what must keep the bits of a computation in the scalar is a template: generators and simpler
// inputs (generators/), and the conversion around a call (subjects/rounded_calls.hpp).

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace liecheck::oracles {

/// The float nearest to x, as a double. GCC 12 drops the conversions of two neighbouring numbers to float and back, at -O2
/// on x86-64; it keeps that of a number which goes through memory.
inline double rounded_to_float(double x) {
  const volatile auto rounded = static_cast<float>(x);
  return static_cast<double>(rounded);
}

struct Scalar {
  std::string_view name;
  int digits, min_exponent, max_exponent;  ///< as std::numeric_limits counts them
  std::size_t size;                        ///< bytes of a number
  double epsilon, min, pi;  ///< 2^(1 - digits); the smallest normal number; the number nearest to pi

  /// The smallest denominator of a relative error: below it the last place of a number is subnormal.
  double least_denominator() const { return min / epsilon; }
  bool is_float() const { return digits == std::numeric_limits<float>::digits; }
  double rounded(double x) const { return is_float() ? rounded_to_float(x) : x; }
  /// Calls f.operator()<S>() with the type of the scalar.
  template <class F>
  decltype(auto) with(F&& f) const {
    return is_float() ? f.template operator()<float>() : f.template operator()<double>();
  }
  bool operator==(const Scalar& other) const { return digits == other.digits; }
};

template <class S>
inline constexpr Scalar scalar_of{std::is_same_v<S, float> ? "float" : "double",
                                  std::numeric_limits<S>::digits,
                                  std::numeric_limits<S>::min_exponent,
                                  std::numeric_limits<S>::max_exponent,
                                  sizeof(S),
                                  std::numeric_limits<S>::epsilon(),
                                  std::numeric_limits<S>::min(),
                                  std::numbers::pi_v<S>};

/// "float" or "double". Throws std::invalid_argument naming the text.
inline const Scalar& scalar_named(std::string_view name) {
  for (const Scalar* s : {&scalar_of<float>, &scalar_of<double>})
    if (s->name == name) return *s;
  throw std::invalid_argument("unknown scalar '" + std::string(name) + "'; known: float, double");
}

/// The numbers as those of S, and back. Both conversions are exact for numbers of S.
template <class S>
std::vector<S> numbers_in(const std::vector<double>& x) {
  return {x.begin(), x.end()};
}
template <class S>
std::vector<double> as_doubles(const std::vector<S>& x) {
  return {x.begin(), x.end()};
}

}  // namespace liecheck::oracles

#pragma once
// A scalar that records, in Gappa's language, the operations that the library's templates apply to it. Each
// operation is recorded twice: rounded, as t3, and exact, as T3. The proofs are thus about the code itself,
// not a copy of its formulas.

#include <fmt/format.h>
#include <cmath>
#include <liecheck/scalar/scalar.hpp>
#include <limits>
#include <stdexcept>
#include <string>

namespace liecheck::proofs {

/// The operations recorded so far, one in each line.
struct Program {
  std::string text;
  int operations = 0;
};
inline Program program;

/// Rounds to nearest in F; mul_add rounds once if FUSED, else twice. Constants are folded as by the compiler.
template <class F, bool FUSED>
class Traced {
 public:
  using Lane = F;

  Traced() = default;
  Traced(F x) : value_(x) {}
  Traced(int x) : value_(static_cast<F>(x)) {}
  /// The variable `name`. It has no rounding error.
  static Traced input(const std::string& name) { return Traced(name, name); }

  std::string rounded() const { return name_.empty() ? fmt::format("{:a}", value_) : name_; }
  std::string exact() const { return name_.empty() ? rounded() : exact_; }

  friend Traced operator+(const Traced& a, const Traced& b) {
    if (a.constant() && b.constant()) return a.value_ + b.value_;
    if (a.is(0)) return b;
    if (b.is(0)) return a;
    return operation("rnd({} + {})", "{} + {}", a, b);
  }
  friend Traced operator-(const Traced& a, const Traced& b) {
    if (a.constant() && b.constant()) return a.value_ - b.value_;
    if (b.is(0)) return a;
    return operation("rnd({} - {})", "{} - {}", a, b);
  }
  friend Traced operator-(const Traced& a) {
    if (a.constant()) return -a.value_;
    return operation("-{}", "-{}", a);
  }
  friend Traced operator*(const Traced& a, const Traced& b) {
    if (a.constant() && b.constant()) return a.value_ * b.value_;
    if (a.is(0) || b.is(0)) return F(0);
    if (a.is(1)) return b;
    if (b.is(1)) return a;
    if (a.power() || b.power()) return operation("{} * {}", "{} * {}", a, b);
    return operation("rnd({} * {})", "{} * {}", a, b);
  }
  friend Traced operator/(const Traced& a, const Traced& b) {
    if (a.constant() && b.constant()) return a.value_ / b.value_;
    if (b.power()) return operation("{} * {}", "{} * {}", a, Traced(F(1) / b.value_));
    return operation("rnd({} / {})", "{} / {}", a, b);
  }
  friend Traced mul_add(const Traced& a, const Traced& b, const Traced& c) {
    if (!FUSED || (a.constant() && b.constant())) return a * b + c;
    if (c.is(0)) return a * b;
    return operation("rnd({} * {} + {})", "{} * {} + {}", a, b, c);
  }

  // The concept Scalar requires these. Branches and functions of libm cannot be traced and throw.
  friend bool operator<(const Traced&, const Traced&) { return refused(), false; }
  friend bool operator<=(const Traced&, const Traced&) { return refused(), false; }
  friend Traced sqrt(const Traced&) { return refused(); }
  friend Traced sin(const Traced&) { return refused(); }
  friend Traced cos(const Traced&) { return refused(); }
  friend Traced atan2(const Traced&, const Traced&) { return refused(); }
  friend Traced fabs(const Traced&) { return refused(); }
  friend Traced ldexp(const Traced& x, int e) { return x * Traced(std::ldexp(F(1), e)); }
  friend bool isfinite(const Traced&) { return refused(), false; }

 private:
  [[noreturn]] static Traced refused() {
    throw std::logic_error("a branch or a function of libm is not traced");
  }

  F value_{};
  std::string name_, exact_;

  Traced(std::string name, std::string exact) : name_(std::move(name)), exact_(std::move(exact)) {}
  bool constant() const { return name_.empty(); }
  /// A power of two: its products and quotients are exact, barring underflow.
  bool power() const {
    int e;
    return constant() && std::frexp(value_, &e) == F(0.5);
  }
  bool is(int x) const { return constant() && value_ == static_cast<F>(x); }

  template <class... A>
  static Traced operation(const char* rounded, const char* exact, const A&... a) {
    const int n = program.operations++;
    const Traced result(fmt::format("t{}", n), fmt::format("T{}", n));
    program.text +=
        fmt::format("{} = {};\n", result.name_, fmt::format(fmt::runtime(rounded), a.rounded()...)) +
        fmt::format("{} = {};\n", result.exact_, fmt::format(fmt::runtime(exact), a.exact()...));
    return result;
  }
};

}  // namespace liecheck::proofs

template <class F, bool FUSED>
struct std::numeric_limits<liecheck::proofs::Traced<F, FUSED>> : std::numeric_limits<F> {};

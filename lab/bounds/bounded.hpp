#pragma once
// Longer than 400 lines: one scalar with all its operators.
// A scalar that carries a bound of its own rounding error. The library's templates are evaluated on it once for a whole
// box of inputs, so the bound is about the code itself, not about a copy of its formulas.
//
// A number holds the interval of what the code would compute in exact arithmetic, and the difference of the floating-point
// result from that as an affine form, sum_k c_k e_k with |e_k| <= 1 (Stolfi & de Figueiredo 1997): each rounding
// adds a symbol e_k, whose c_k is half a unit in the last place of the largest possible result. The coefficients are
// intervals, and the rules of + - * / and sqrt are exact, so that no term of higher order is left out:
//
//     fl(a + b): E_a + E_b + e        fl(a b): a E_b + E_a (b + E_b) + e        fl(a/b): (E_a - (a/b) E_b)/(b + E_b) + e
//
// Roundings that cancel, as in a sum of double words, cancel here: they have the same symbol. A result is exact, without
// a symbol, if it is a multiple of 2^q and not above 2^(q + 53).

#include <Eigen/Core>
#include <bounds/interval.hpp>
#include <cmath>
#include <compare>
#include <liecheck/scalar/double_word.hpp>
#include <limits>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace liecheck::properties {

/// A comparison has no answer for the whole box: it has to be divided.
struct Undecided : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What is known about the inputs of the box beyond the interval of each.
struct BoxFacts {
  int symbols = 0, bases = 0;  ///< used so far
  int new_base() { return ++bases; }
  /// The sums of the squares of inputs: bit i stands for input i.
  std::vector<std::pair<unsigned, Interval>> squares;
  Interval norm_excess;  ///< |Q|^2 - 1
  Interval x;            ///< theta^2

  static BoxFacts& current() {
    thread_local BoxFacts facts;
    return facts;
  }
};

/// RAW: the type in which a polynomial is evaluated; its approximation error is added afterwards.
template <bool RAW>
class BoundedNumber {
 public:
  using Lane = double;
  struct Term {
    int symbol;
    Interval c;
  };

  BoundedNumber() = default;
  BoundedNumber(double x)
      : exact_(x), computed_(x), quantum_(quantum_of(std::fabs(x))), of_x_(true), middle_(x), slope_(0) {}
  BoundedNumber(int x) : BoundedNumber(static_cast<double>(x)) {}
  /// An input: any double of the interval. `number` is its place, for BoxFacts::squares, or -1.
  static BoundedNumber input(const Interval& x, int number = -1) {
    BoundedNumber r;
    r.exact_ = r.computed_ = x;
    r.quantum_ = quantum_of(x.least());
    r.input_ = number;
    r.base_ = BoxFacts::current().new_base();
    return r;
  }
  /// An input to which the result is proportional: its size is arbitrary, so that all numbers that are proportional to it have
  /// relative rounding errors.
  static BoundedNumber scaling_input(const Interval& x) {
    BoundedNumber r = input(x);
    r.scales_ = true;
    r.quantum_ = unknown;
    return r;
  }
  /// A number of the interval, computed with an error up to `error`.
  static BoundedNumber with_error(const Interval& x, double error) {
    BoundedNumber r = opaque();
    r.exact_ = x;
    r.add_symbol(error);
    r.close();
    return r;
  }
  template <bool OTHER>
  explicit BoundedNumber(const BoundedNumber<OTHER>& o)
      : exact_(o.exact_),
        computed_(o.computed_),
        quantum_(o.quantum_),
        base_(BoxFacts::current().new_base()),
        of_x_(o.of_x_),
        scales_(o.scales_),
        middle_(o.middle_),
        slope_(o.slope_) {
    for (const auto& t : o.error_) error_.push_back({t.symbol, t.c});
  }

  const Interval& exact() const { return exact_; }
  const Interval& computed() const { return computed_; }
  const std::vector<Term>& error() const { return error_; }
  /// This number with one more error.
  BoundedNumber with_another_error(double error) const {
    BoundedNumber r = *this;
    r.add_symbol(error);
    r.close();
    return r;
  }

  friend BoundedNumber operator+(const BoundedNumber& a, const BoundedNumber& b) {
    if (a.is(0)) return b;
    if (b.is(0)) return a;
    return sum(a, b, true);
  }
  friend BoundedNumber operator-(const BoundedNumber& a) {
    BoundedNumber r = a;
    r.exact_ = -a.exact_, r.computed_ = -a.computed_, r.squares_ = 0, r.input_ = -1;
    r.offset_ = -a.offset_, r.factor_ = -a.factor_;
    r.middle_ = -a.middle_, r.slope_ = -a.slope_;
    for (Term& t : r.error_) t.c = -t.c;
    return r;
  }
  friend BoundedNumber operator-(const BoundedNumber& a, const BoundedNumber& b) { return a + -b; }
  friend BoundedNumber operator*(const BoundedNumber& a, const BoundedNumber& b) {
    if (a.is(0) || b.is(0)) return 0;
    if (a.is(1)) return b;
    if (b.is(1)) return a;
    return product(a, b, true);
  }
  friend BoundedNumber operator/(const BoundedNumber& a, const BoundedNumber& b) {
    if (b.computed_.least() == 0 || b.exact_.least() == 0) throw Undecided("a divisor may be 0");
    if (b.is_constant() && b.power_of_two()) return a * BoundedNumber(1 / b.computed_.low);
    BoundedNumber r = opaque();
    r.exact_ = a.exact_ / b.exact_;
    r.scales_ = a.scales_;
    if (a.of_x_ && b.of_x_) r.set_of_x(a.middle_ / b.middle_, (a.slope_ - r.exact_ * b.slope_) / b.exact_);
    r.add_terms(a.error_, Interval(1) / b.computed_, b.error_, -(r.exact_ / b.computed_));
    if (a.is_constant() && b.is_constant()) {  // as folded by the compiler: the error is known
      const double q = a.computed_.low / b.computed_.low,
                   remainder = std::fma(-q, b.computed_.low, a.computed_.low);
      r.add_symbol(Interval::up(std::fabs(remainder / b.computed_.low)));
      r.computed_ = q;
      r.quantum_ = quantum_of(std::fabs(q));
      return r;
    }
    r.round(unknown, true);
    return r;
  }
  friend BoundedNumber sqrt(const BoundedNumber& a) {
    if (!(a.computed_.low > 0 && a.exact_.low > 0))
      throw Undecided("the square root of a number that may be 0");
    BoundedNumber r = opaque();
    r.exact_ = sqrt(a.exact_);
    r.add_terms(a.error_, Interval(1) / (sqrt(a.computed_) + r.exact_), {}, 0);
    r.round(unknown, false);
    return r;
  }
  BoundedNumber& operator+=(const BoundedNumber& b) { return *this = *this + b; }
  BoundedNumber& operator-=(const BoundedNumber& b) { return *this = *this - b; }
  BoundedNumber& operator*=(const BoundedNumber& b) { return *this = *this * b; }
  BoundedNumber& operator/=(const BoundedNumber& b) { return *this = *this / b; }
  friend BoundedNumber mul_add(const BoundedNumber& a, const BoundedNumber& b, const BoundedNumber& c) {
#if defined(__FMA__)
    if (a.is(0) || b.is(0) || a.is(1) || b.is(1) || c.is(0)) return a * b + c;
    return sum(product(a, b, false), c, true);
#else
    return a * b + c;
#endif
  }

  friend bool operator<(const BoundedNumber& a, const BoundedNumber& b) {
    if (a.computed_.high < b.computed_.low) return true;
    if (a.computed_.low >= b.computed_.high) return false;
    throw Undecided("a comparison");
  }
  friend bool operator>(const BoundedNumber& a, const BoundedNumber& b) {
    return b < a;
  }
  friend bool operator<=(const BoundedNumber& a, const BoundedNumber& b) {
    return !(b < a);
  }
  friend bool operator>=(const BoundedNumber& a, const BoundedNumber& b) {
    return !(a < b);
  }
  friend bool operator==(const BoundedNumber& a, const BoundedNumber& b) {
    if (a.computed_.high < b.computed_.low || b.computed_.high < a.computed_.low) return false;
    if (a.computed_.is_point() && b.computed_.is_point()) return true;
    throw Undecided("a comparison");
  }
  friend bool operator!=(const BoundedNumber& a, const BoundedNumber& b) {
    return !(a == b);
  }
  friend BoundedNumber fabs(const BoundedNumber& a) {
    if (a.computed_.low >= 0) return a;
    if (a.computed_.high < 0) return -a;
    // The sign is not known: | |x + E| - |x| | <= |E|.
    double error = 0;
    for (const Term& t : a.error_) error = Interval::up(error + t.c.largest());
    BoundedNumber r = with_error({0, a.exact_.largest()}, error);
    r.quantum_ = a.quantum_;
    return r;
  }
  friend BoundedNumber abs(const BoundedNumber& a) {
    return fabs(a);
  }
  friend BoundedNumber copysign(const BoundedNumber& a, const BoundedNumber& b) {
    return b.computed_.low >= 0 || !(b < BoundedNumber(0)) ? fabs(a) : -fabs(a);
  }
  friend BoundedNumber ldexp(const BoundedNumber& a, int e) {
    return a * BoundedNumber(std::ldexp(1, e));
  }
  friend BoundedNumber frexp(const BoundedNumber&, int*) {
    return refused();
  }
  friend bool isfinite(const BoundedNumber&) {
    return true;
  }
  friend BoundedNumber sin(const BoundedNumber&) {
    return refused();
  }
  friend BoundedNumber cos(const BoundedNumber&) {
    return refused();
  }
  friend BoundedNumber atan2(const BoundedNumber&, const BoundedNumber&) {
    return refused();
  }

  /// a + b as the rounded sum and its rounding error, which an error-free transformation computes without error.
  static std::pair<BoundedNumber, BoundedNumber> sum_and_error(const BoundedNumber& a,
                                                               const BoundedNumber& b) {
    const BoundedNumber s = a + b;
    return {s, s.rounding_error(a.error_, b.error_)};
  }
  /// a b + c as a real number of the errors of a, b and c.
  static BoundedNumber without_rounding(const BoundedNumber& a, const BoundedNumber& b,
                                        const BoundedNumber& c) {
    return sum(product(a, b, false), c, false);
  }
  /// high + low = this number, but for an error; |low| <= difference.
  std::pair<BoundedNumber, BoundedNumber> parts(double difference, double error) const {
    BoundedNumber high = with_another_error(difference), low(0);
    low.error_.push_back({high.error_.back().symbol, -difference});
    low.add_symbol(error);
    low.close();
    high.quantum_ = low.quantum_ = unknown;
    return {high, low};
  }
  static std::pair<BoundedNumber, BoundedNumber> product_and_error(const BoundedNumber& a,
                                                                   const BoundedNumber& b) {
    const int before = BoxFacts::current().symbols;
    const BoundedNumber p = a * b;
    return {p, p.last_symbol_since(before)};
  }

 private:
  template <bool>
  friend class BoundedNumber;
  static constexpr int unknown = -5000;  ///< a quantum: nothing is known
  Interval exact_, computed_;
  std::vector<Term> error_;  ///< by symbol, ascending
  int quantum_ = unknown;    ///< the floating-point number is a multiple of 2^quantum
  int input_ = -1;
  unsigned squares_ = 0;  ///< the inputs whose squares this number sums; no other terms
  /// In exact arithmetic the number is offset + factor * (the quantity number base), so that x - x is 0, not an interval
  /// about it. base 0: the number is a constant.
  double offset_ = 0, factor_ = 1;
  int base_ = 0;
  /// If `of_x_`, the number is a function of x = theta^2 alone in exact arithmetic: its value at the middle of the box, and an
  /// interval of its derivative. Mean values make the intervals of long formulas narrow.
  bool of_x_ = false, scales_ = false;
  Interval middle_, slope_;

  static BoundedNumber opaque() {
    BoundedNumber r;
    r.base_ = BoxFacts::current().new_base();
    return r;
  }
  /// Sets the exact value of a + b.
  void add_exactly(const BoundedNumber& a, const BoundedNumber& b) {
    if (a.exact_.is_point() || b.exact_.is_point() || a.base_ == b.base_) {
      const auto offset = liecheck::two_sum<double>(a.offset(), b.offset());
      const auto factor = liecheck::two_sum<double>(a.factor(), b.factor());
      if (offset.low == 0 && factor.low == 0) {
        offset_ = offset.high, factor_ = factor.high;
        base_ = a.exact_.is_point() ? b.base_ : a.base_;
        exact_ = factor_ == 0 ? Interval(offset_) : a.exact_ + b.exact_;
        if (factor_ != 0 && a.of_x_ && b.of_x_) set_of_x(a.middle_ + b.middle_, a.slope_ + b.slope_);
        if (factor_ == 0) of_x_ = true, middle_ = offset_, slope_ = 0;
        return;
      }
    }
    exact_ = a.exact_ + b.exact_;
    if (a.of_x_ && b.of_x_) set_of_x(a.middle_ + b.middle_, a.slope_ + b.slope_);
  }
  /// Sets the mean value form, and what follows for the interval.
  void set_of_x(const Interval& middle, const Interval& slope) {
    const Interval& x = BoxFacts::current().x;
    of_x_ = true, middle_ = middle, slope_ = slope;
    exact_ = intersection(exact_, middle + slope * (x - Interval(x.middle())));
  }
  /// As a linear function of the base; of a constant, the factor is 0.
  double offset() const {
    return exact_.is_point() ? exact_.low : offset_;
  }
  double factor() const {
    return exact_.is_point() ? 0 : factor_;
  }
  bool is_constant() const {
    return error_.empty() && exact_.is_point();
  }
  bool is(double x) const {
    return error_.empty() && exact_.is(x);
  }
  bool power_of_two() const {
    int e;
    return std::fabs(std::frexp(computed_.low, &e)) == 0.5;
  }
  [[noreturn]] static BoundedNumber refused() {
    throw Undecided("a function that has no bound here");
  }

  /// Every double x with |x| >= least is a multiple of 2^quantum_of(least).
  static int quantum_of(double least) {
    return least > 0 ? std::max(std::ilogb(least) - 52, -1074) : unknown;
  }

  static BoundedNumber sum(const BoundedNumber& a, const BoundedNumber& b, bool rounded) {
    BoundedNumber r = opaque();
    r.add_exactly(a, b);
    r.scales_ = a.scales_ || b.scales_;
    if (a.squares_ && b.squares_ && !(a.squares_ & b.squares_)) r.set_squares(a.squares_ | b.squares_);
    r.add_terms(a.error_, 1, b.error_, 1);
    const int quantum = std::min(a.quantum_, b.quantum_);
    if (rounded)
      r.round(quantum, false);
    else
      r.quantum_ = quantum, r.close();
    return r;
  }
  static BoundedNumber product(const BoundedNumber& a, const BoundedNumber& b, bool rounded) {
    BoundedNumber r = opaque();
    const bool same = a.input_ >= 0 && a.input_ == b.input_;
    r.exact_ = same ? square(a.exact_) : a.exact_ * b.exact_;
    r.scales_ = a.scales_ || b.scales_;
    if (a.of_x_ && b.of_x_) r.set_of_x(a.middle_ * b.middle_, a.slope_ * b.exact_ + a.exact_ * b.slope_);
    if (same) r.set_squares(1u << a.input_);
    r.add_terms(b.error_, a.exact_, a.error_, b.computed_);
    const int quantum =
        a.quantum_ == unknown || b.quantum_ == unknown ? unknown : std::max(a.quantum_ + b.quantum_, unknown);
    if (rounded) {
      if ((a.is_constant() && a.power_of_two()) || (b.is_constant() && b.power_of_two()))
        r.close_exact(quantum);
      else
        r.round(quantum, true);
    } else {
      r.quantum_ = quantum;
      r.close();
    }
    return r;
  }
  void set_squares(unsigned inputs) {
    squares_ = inputs;
    base_ = -static_cast<int>(inputs), offset_ = 0, factor_ = 1;
    for (const auto& [mask, value] : BoxFacts::current().squares)
      if (mask == inputs) {
        exact_ = intersection(exact_, value);
        const Interval& x = BoxFacts::current().x;
        if (value.low == x.low && value.high == x.high) of_x_ = true, middle_ = x.middle(), slope_ = 1;
      }
  }
  /// error_ = f a + g b.
  void add_terms(const std::vector<Term>& a, const Interval& f, const std::vector<Term>& b,
                 const Interval& g) {
    error_.reserve(a.size() + b.size() + 1);
    auto i = a.begin();
    auto j = b.begin();
    while (i != a.end() || j != b.end()) {
      if (j == b.end() || (i != a.end() && i->symbol < j->symbol)) {
        error_.push_back({i->symbol, f * i->c}), ++i;
      } else if (i == a.end() || j->symbol < i->symbol) {
        error_.push_back({j->symbol, g * j->c}), ++j;
      } else {
        const Interval c = f.is(1) && g.is(1) && i->c.is_point() && j->c.is_point() && i->c.low == -j->c.low
                               ? Interval(0)
                               : f * i->c + g * j->c;
        if (!c.is(0)) error_.push_back({i->symbol, c});
        ++i, ++j;
      }
    }
  }
  void add_symbol(double size) {
    if (size > 0) error_.push_back({BoxFacts::current().symbols++, size});
  }
  /// Sets computed_.
  void close() {
    double sum = 0;
    for (const Term& t : error_) sum = Interval::up(sum + t.c.largest());
    computed_ = sum == 0 ? exact_ : exact_ + Interval::around_zero(sum);
  }
  /// A product with a power of two, exact but for underflow.
  void close_exact(int quantum) {
    close();
    if (quantum < -1074) add_symbol(std::numeric_limits<double>::denorm_min()), close();
    quantum_ = scales_ ? unknown : std::max(quantum, quantum_of(computed_.least()));
  }
  /// Adds the error of rounding the result, a multiple of 2^quantum, to nearest.
  void round(int quantum, bool may_underflow) {
    close();
    const double largest = computed_.largest();
    if (!(largest < 0x1p1000)) throw Undecided("overflow");
    const bool exact = quantum != unknown && quantum >= -1074 && largest <= std::ldexp(1, quantum + 53);
    if (largest > 0 && !exact) {
      double size = scales_ ? Interval::up(largest * 0x1p-53)
                            : std::ldexp(1, std::max(std::ilogb(largest), -1022) - 53);
      if (may_underflow) size = Interval::up(size + std::numeric_limits<double>::denorm_min());
      add_symbol(size);
      close();
    }
    quantum_ = scales_ ? unknown : std::max(quantum, quantum_of(computed_.least()));
  }
  /// The exact rounding error of a sum: minus the symbol that it added, if any.
  BoundedNumber rounding_error(const std::vector<Term>& a, const std::vector<Term>& b) const {
    int last = -1;
    if (!a.empty()) last = a.back().symbol;
    if (!b.empty()) last = std::max(last, b.back().symbol);
    return last_symbol_since(last + 1);
  }
  BoundedNumber last_symbol_since(int first) const {
    BoundedNumber r(0);
    if (error_.empty() || error_.back().symbol < first) return r;
    r.error_.push_back({error_.back().symbol, -error_.back().c});
    r.quantum_ = unknown;
    r.close();
    return r;
  }
};

using Bounded = BoundedNumber<false>;

}  // namespace liecheck::properties

template <bool RAW>
struct std::numeric_limits<liecheck::properties::BoundedNumber<RAW>> : std::numeric_limits<double> {};

template <>
struct Eigen::NumTraits<liecheck::properties::Bounded>
    : Eigen::GenericNumTraits<liecheck::properties::Bounded> {
  using Real = liecheck::properties::Bounded;
  static Real epsilon() { return std::numeric_limits<double>::epsilon(); }
  static Real dummy_precision() { return 1e-12; }
  static Real highest() { return std::numeric_limits<double>::max(); }
  static Real lowest() { return std::numeric_limits<double>::lowest(); }
  static int digits10() { return std::numeric_limits<double>::digits10; }
};

#include <hard_cases/expression.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <campaign/case_id.hpp>
#include <cctype>
#include <oracles/number.hpp>
#include <oracles/real.hpp>
#include <stdexcept>

namespace liecheck::properties {

namespace {

using Number = oracles::Real100;
using Numbers = std::vector<Number>;

Number power_of_two(int e) {
  return ldexp(Number(1), e);
}

/// The spacing of the format at x.
Number ulp(const Number& x, const Scalar& f) {
  return power_of_two(std::max(oracles::exponent_of(x), f.min_exponent) - f.digits);
}

/// x rounded to nearest, ties to even, with the sign of zero. The result may be 2^max_exponent, beyond f.
Number rounded(const Number& x, const Scalar& f) {
  if (x == 0) return x;
  const Number unit = ulp(x, f), scaled = abs(x) / unit, down = floor(scaled), rest = scaled - down;
  const Number half = Number(1) / 2;
  const bool up = rest > half || (rest == half && fmod(down, Number(2)) != 0);
  const Number magnitude = (up ? Number(down + 1) : down) * unit;
  return x < 0 ? Number(-magnitude) : magnitude;
}

/// x rounded to f, then moved by k neighbours towards +infinity (towards -infinity for k < 0).
Number stepped(const Number& x, long k, const Scalar& f) {
  Number y = rounded(x, f);
  for (long i = 0; i < std::abs(k); ++i) {
    // The spacing below a power of two is half of that above it.
    const Number outward = ulp(y, f);
    const bool away = y == 0 || (y > 0) == (k > 0);
    Number step = outward;
    if (!away && abs(y) == power_of_two(oracles::exponent_of(y) - 1) &&
        oracles::exponent_of(y) > f.min_exponent)
      step = outward / 2;
    y = k > 0 ? Number(y + step) : Number(y - step);
  }
  return y;
}

/// A number as it was typed, in decimal or hexadecimal, to 100 digits. Throws std::invalid_argument.
Number number_of(const std::string& word) {
  Number value;
  char* end = nullptr;
  mpfr_clear_flags();
  mpfr_strtofr(value.backend().data(), word.c_str(), &end, 0, MPFR_RNDN);
  const bool beyond = mpfr_underflow_p() || mpfr_overflow_p();
  if (end != word.c_str() + word.size() || (!beyond && !isfinite(value)))
    throw std::invalid_argument(fmt::format("not a number: '{}'", word));
  // Functions of numbers beyond would take digits without end.
  const int exponent = beyond ? 0 : oracles::exponent_of(value);
  if (beyond || (value != 0 && (exponent > 16384 || exponent < -16493)))
    throw std::invalid_argument(fmt::format("beyond the range from 2^-16494 to 2^16384: '{}'", word));
  return value;
}

class Parser {
 public:
  Parser(std::string_view text, const Scalar& format) : text_(text), f_(format) {}

  Numbers whole() {
    Numbers all = list([this](std::size_t from, const Numbers& x) { check_literal(from, x); });
    skip_space();
    if (at_ < text_.size()) fail(fmt::format("'{}' is not expected here", text_.substr(at_, 12)));
    return all;
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw std::invalid_argument(fmt::format("'{}', column {}: {}", text_, at_ + 1, why));
  }
  void skip_space() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  bool take(char c) {
    skip_space();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }

  /// look(start, numbers) is called for each item.
  template <class Look>
  Numbers list(const Look& look) {
    if (++depth_ > 50) fail("nested too deeply");
    Numbers all;
    do {
      const std::size_t from = at_;
      const Numbers next = sum();
      look(from, next);
      all.insert(all.end(), next.begin(), next.end());
      if (all.size() > 1000) fail("too many numbers");
    } while (take(','));
    --depth_;
    return all;
  }
  Numbers list() {
    return list([](std::size_t, const Numbers&) {});
  }
  /// Refuses an item that is a number as it was typed, but 0 in the format. (A computed number may be the
  /// rest of a rounding at 100 digits, such as cos(pi / 2), and becomes 0.)
  void check_literal(std::size_t from, const Numbers& x) const {
    const bool as_typed =
        text_.find_first_not_of(" \t-", from) == literal_start_ &&
        text_.substr(literal_end_, at_ - literal_end_).find_first_not_of(" \t") == text_.npos;
    if (as_typed && x[0] != 0 && rounded(x[0], f_) == 0)
      fail(fmt::format("'{}' rounds to zero in {}",
                       text_.substr(literal_start_, literal_end_ - literal_start_), f_.name));
  }
  Numbers sum() {
    return chain("+-", [this] { return chain("*/", [this] { return sign(); }); });
  }
  /// Operands that the given operators join from left to right.
  template <class Operand>
  Numbers chain(std::string_view operators, Operand operand) {
    Numbers left = operand();
    for (;;) {
      const auto found = std::find_if(operators.begin(), operators.end(), [this](char c) { return take(c); });
      if (found == operators.end()) return left;
      left = combine(left, *found, operand());
    }
  }
  Numbers sign() {
    if (++depth_ > 50) fail("nested too deeply");
    Numbers value;
    if (take('-')) {
      value = sign();
      for (Number& x : value) x = -x;
    } else {
      value = power();
    }
    --depth_;
    return value;
  }
  Numbers power() {
    const Numbers base = primary();
    if (!take('^')) return base;
    return combine(base, '^', sign());
  }

  static Number apply(const Number& a, char operation, const Number& b) {
    return operation == '+'   ? a + b
           : operation == '-' ? a - b
           : operation == '*' ? a * b
           : operation == '/' ? a / b
                              : Number(pow(a, b));
  }
  /// Works number by number. A single number is combined with every number of the other side.
  Numbers combine(const Numbers& a, char operation, const Numbers& b) {
    if (a.size() != b.size() && a.size() != 1 && b.size() != 1)
      fail(fmt::format("cannot combine {} numbers with {}", a.size(), b.size()));
    Numbers all;
    for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i)
      all.push_back(checked(apply(a[a.size() == 1 ? 0 : i], operation, b[b.size() == 1 ? 0 : i])));
    return all;
  }
  Number checked(const Number& x) const {
    if (!isfinite(x)) fail("not a finite number");
    if (x != 0 && std::abs(oracles::exponent_of(x)) > 100000) fail("a number beyond every scalar's range");
    return x;
  }

  Numbers primary() {
    skip_space();
    if (take('(')) {
      const Numbers inner = list();
      if (!take(')')) fail("')' is missing");
      return inner;
    }
    if (at_ < text_.size() && (std::isdigit(static_cast<unsigned char>(text_[at_])) || text_[at_] == '.'))
      return {literal()};
    std::size_t end = at_;
    while (end < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[end])) || text_[end] == '_'))
      ++end;
    const std::string name(text_.substr(at_, end - at_));
    if (name.empty())
      fail(at_ < text_.size() ? fmt::format("a number is expected, not '{}'", text_[at_])
                              : "a number is missing at the end");
    if (end < text_.size() && text_[end] == '(') {
      const std::size_t start = at_;
      at_ = end + 1;
      const Numbers arguments = list();
      if (!take(')')) fail("')' is missing");
      const std::size_t after = at_;
      at_ = start;  // the place that an error message names
      Numbers value = call(name, arguments);
      at_ = after;
      return value;
    }
    const Numbers value{constant(name)};
    at_ = end;
    return value;
  }

  Number literal() {
    std::size_t end = at_;
    const bool hexadecimal = text_.substr(at_, 2) == "0x" || text_.substr(at_, 2) == "0X";
    const auto exponent = [&](char c) { return hexadecimal ? c == 'p' || c == 'P' : c == 'e' || c == 'E'; };
    while (end < text_.size() &&
           (std::isalnum(static_cast<unsigned char>(text_[end])) || text_[end] == '.' ||
            ((text_[end] == '-' || text_[end] == '+') && end > at_ && exponent(text_[end - 1]))))
      ++end;
    const std::string word(text_.substr(at_, end - at_));
    if (word.size() > 60) fail("a number is at most 60 characters long");
    Number value;
    try {
      value = number_of(word);
    } catch (const std::exception& e) {
      fail(e.what());
    }
    checked(value);
    literal_start_ = at_, literal_end_ = at_ = end;
    return value;
  }

  Number constant(const std::string& name) const {
    if (name == "pi") return boost::math::constants::pi<Number>();
    if (name == "eps") return power_of_two(1 - f_.digits);
    if (name == "min_normal") return Number(f_.min);
    if (name == "denorm_min") return power_of_two(f_.min_exponent - f_.digits);
    if (name == "max") return power_of_two(f_.max_exponent) - power_of_two(f_.max_exponent - f_.digits);
    fail(
        fmt::format("'{}' is unknown; constants: pi, eps, min_normal, denorm_min, max; functions: sqrt, sin, "
                    "cos, round, nextup, nextdown, scaled, unit, about, rotation",
                    name));
  }

  Numbers call(const std::string& name, const Numbers& x) const {
    const auto takes = [&](std::size_t low, std::size_t high) {
      if (x.size() < low || x.size() > high)
        fail(low == high ? fmt::format("{} takes {} numbers, not {}", name, low, x.size())
                         : fmt::format("{} takes {} to {} numbers, not {}", name, low, high, x.size()));
    };
    const auto each = [&](auto f) {
      Numbers all;
      for (const Number& v : x) all.push_back(checked(f(v)));
      return all;
    };
    if (name == "sqrt") return each([](const Number& v) { return Number(sqrt(v)); });
    if (name == "sin") return each([](const Number& v) { return Number(sin(v)); });
    if (name == "cos") return each([](const Number& v) { return Number(cos(v)); });
    if (name == "round") return each([&](const Number& v) { return rounded(v, f_); });
    if (name == "scaled") {  // |x|^(max_exponent / 1024): the same share of the exponent range as in double
      return each([&](const Number& v) {
        const Number m = v == 0 ? Number(0) : Number(pow(Number(abs(v)), Number(f_.max_exponent) / 1024));
        return v < 0 ? Number(-m) : m;
      });
    }
    if (name == "nextup" || name == "nextdown") {
      takes(1, 2);
      const Number k = x.size() == 2 ? x[1] : Number(1);
      if (k != floor(k) || abs(k) > 1000) fail(name + " takes an integer number of steps, at most 1000");
      const long steps = static_cast<long>(static_cast<double>(k));
      return {stepped(x[0], name == "nextup" ? steps : -steps, f_)};
    }
    if (name == "unit") {
      takes(2, 4);
      Number squares(0);
      for (const Number& v : x) squares += v * v;
      return each([&](const Number& v) { return Number(v / sqrt(squares)); });
    }
    if (name == "about") {  // quaternion x y z w of an axis and an angle
      takes(4, 4);
      const Number n = sqrt(Number(x[0] * x[0] + x[1] * x[1] + x[2] * x[2])), half = x[3] / 2;
      Numbers q;
      for (std::size_t i = 0; i < 3; ++i) q.push_back(checked(Number(x[i] / n * sin(half))));
      q.push_back(cos(half));
      return q;
    }
    if (name == "rotation") {  // the matrix of x y z w, row by row
      takes(4, 4);
      const Number &a = x[0], &b = x[1], &c = x[2], &w = x[3];
      const Number s = checked(Number(2 / (a * a + b * b + c * c + w * w)));
      return {1 - s * (b * b + c * c), s * (a * b - c * w),     s * (a * c + b * w),
              s * (a * b + c * w),     1 - s * (a * a + c * c), s * (b * c - a * w),
              s * (a * c - b * w),     s * (b * c + a * w),     1 - s * (a * a + b * b)};
    }
    constant(name);  // throws for an unknown name
    fail(name + " is a constant");
  }

  std::string_view text_;
  const Scalar& f_;
  std::size_t at_ = 0, literal_start_ = 0, literal_end_ = 0;  ///< the last two: of the last literal
  int depth_ = 0;
};

}  // namespace

std::vector<std::string> evaluate(std::string_view text, const Scalar& scalar) {
  const Numbers values = Parser(text, scalar).whole();
  std::vector<std::string> all;
  bool zero = true, meant = false;
  for (const Number& x : values) {
    const Number y = rounded(x, scalar);
    if (abs(y) >= power_of_two(scalar.max_exponent))
      throw std::invalid_argument(
          fmt::format("'{}': {} is beyond the range of {}", text, static_cast<double>(x), scalar.name));
    zero = zero && y == 0;
    meant = meant || x != 0;
    all.push_back(
        hexadecimal_float(y == 0 && mpfr_signbit(y.backend().data()) ? -0.0 : static_cast<double>(y)));
  }
  if (zero && meant) throw std::invalid_argument(fmt::format("'{}' rounds to zero in {}", text, scalar.name));
  return all;
}

}  // namespace liecheck::properties

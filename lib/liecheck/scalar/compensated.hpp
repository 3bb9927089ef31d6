#pragma once
// Sums and dot products that stay accurate if their terms cancel. Three methods: compensation (Ogita, Rump &
// Oishi 2005), factors split at a fixed digit (Rump, Ogita & Oishi 2008), and exact sums (Shewchuk 1997).

#include <array>
#include <bit>
#include <liecheck/scalar/double_word.hpp>
#include <liecheck/scalar/precision.hpp>
#include <liecheck/scalar/scalar.hpp>
#include <limits>

namespace liecheck {

/// sum a_i b_i, computed as if in twice the digits and then rounded. Ogita, Rump & Oishi (2005), algorithm
/// 5.3 (Dot2): error eps |sum| + n^2 eps^2 sum |a_i b_i|. In fast precision it is the plain sum.
template <Scalar S, Precision P = Precision::standard>
class CompensatedSum {
 public:
  CompensatedSum& add_product(const S& a, const S& b) {
    if constexpr (P == Precision::fast) {
      high_ = mul_add(a, b, high_);
      return *this;
    }
    const auto [p, pe] = two_prod(a, b);
    const auto [s, se] = two_sum(high_, p);
    high_ = s;
    low_ += pe + se;
    return *this;
  }
  CompensatedSum& add(const S& a) {
    const auto [s, se] = two_sum(high_, a);
    high_ = s;
    low_ += se;
    return *this;
  }
  S value() const { return high_ + low_; }
  DoubleWord<S> double_word() const { return two_sum<S>(high_, low_); }

 private:
  S high_ = S(0);
  S low_ = S(0);
};

/// A factor split at a fixed digit: value = high + low exactly, and high is a multiple of 2^-f,
/// f = (digits - BITS)/2. A sum of products of high parts is exact while it is below 2^BITS (Rump, Ogita &
/// Oishi 2008, algorithm 3.2, ExtractScalar). Domain: |value| < 2^(digits/2 - 1); products of larger factors
/// are rounded as usual. In fast precision low is 0. S may be a Simd.
template <class S, int BITS, Precision P = Precision::standard>
struct SplitFactor {
  S value, high, low;
  [[gnu::always_inline]] SplitFactor(const S& x) : value(x), high(x), low(S(0)) {
    if constexpr (P != Precision::fast) {
      using std::ldexp;
      using Number = Lane<S>;
      constexpr int digits = std::numeric_limits<Number>::digits, places = (digits - BITS) / 2;
      const S sigma(Number(ldexp(Number(3), digits - 2 - places)));
      high = stored(S(x + sigma)) - sigma;
      low = x - high;
    }
  }
  /// Splits a factor of any size at the last digit of sigma; about n digits go to low if sigma is
  /// 2^(n + 1) times a bound of the factor.
  [[gnu::always_inline]] SplitFactor(const S& x, const S& sigma) : value(x), high(x), low(S(0)) {
    if constexpr (P != Precision::fast) {
      high = stored(S(x + sigma)) - sigma;
      low = x - high;
    }
  }
  /// Splits the double word x + x_low at the last digit of sigma.
  [[gnu::always_inline]] SplitFactor(const S& x, const S& x_low, const S& sigma) : SplitFactor(x, sigma) {
    if constexpr (P != Precision::fast) {
      low = low + x_low;
      value = high + low;
    }
  }
  /// The factor value + x_low, |x_low| <= eps |value|. Later than `value`, x_low is no loss of time.
  [[gnu::always_inline]] SplitFactor plus(const S& x_low) const {
    SplitFactor c = *this;
    if constexpr (P != Precision::fast) c.low = low + x_low;
    return c;
  }
  /// Constructs a factor from parts that are already split.
  [[gnu::always_inline]] static SplitFactor of(const S& value, const S& high, const S& low) {
    SplitFactor c = value;
    c.high = high, c.low = low;
    return c;
  }
  [[gnu::always_inline]] friend SplitFactor operator-(SplitFactor a) {
    a.value = -a.value, a.high = -a.high, a.low = -a.low;
    return a;
  }
};

/// sum a b of split factors as high + low(). high is the exact sum of the products of high parts. Error
/// 2^-(digits/2 - BITS) eps times sum |a b|.
template <class S, int BITS, Precision P = Precision::standard>
struct SplitDot {
  S high = S(0), low_a = S(0), low_b = S(0);  ///< low is two sums that the processor can compute in parallel
  /// a b.
  [[gnu::always_inline]] static SplitDot product(const SplitFactor<S, BITS, P>& a,
                                                 const SplitFactor<S, BITS, P>& b) {
    SplitDot p;
    p.high = a.high * b.high;
    if constexpr (P != Precision::fast) p.low_a = a.low * b.value, p.low_b = a.high * b.low;
    return p;
  }
  /// a^2.
  [[gnu::always_inline]] static SplitDot square(const SplitFactor<S, BITS, P>& a) {
    SplitDot p;
    p.high = a.high * a.high;
    if constexpr (P != Precision::fast) p.low_a = a.low * S(a.value + a.high);
    return p;
  }
  [[gnu::always_inline]] SplitDot& add_product(const SplitFactor<S, BITS, P>& a,
                                               const SplitFactor<S, BITS, P>& b) {
    high = mul_add(a.high, b.high, high);
    if constexpr (P != Precision::fast) {
      low_a = mul_add(a.low, b.value, low_a);
      low_b = mul_add(a.high, b.low, low_b);
    }
    return *this;
  }
  [[gnu::always_inline]] SplitDot& subtract_product(const SplitFactor<S, BITS, P>& a,
                                                    const SplitFactor<S, BITS, P>& b) {
    return add_product(a, -b);
  }
  [[gnu::always_inline]] SplitDot& add_square(const SplitFactor<S, BITS, P>& a) {
    high = mul_add(a.high, a.high, high);
    if constexpr (P != Precision::fast) low_a = mul_add(a.low, S(a.value + a.high), low_a);
    return *this;
  }
  [[gnu::always_inline]] S low() const { return low_a + low_b; }
  [[gnu::always_inline]] S value() const {
    if constexpr (P == Precision::fast) return high;
    return high + low();
  }
  /// The low part of the double word: the sum minus `value`. Precondition: `value` is value().
  [[gnu::always_inline]] S rounding_error(const S& value) const {
    if constexpr (P == Precision::fast) return S(0);
    return (high - value) + low();
  }
};

/// a b and a^2 of double words, rounded to S. The error is one rounding plus eps/2 of the products that
/// contain low. Without fused multiply-add the arguments are renormalised first, since the product of the
/// high parts is rounded too. Precondition: |a|, |b| < 2^(digits/2 - 1); |low| may exceed eps/2 |high|.
template <Scalar S>
[[gnu::always_inline]] inline S rounded_product(const DoubleWord<S>& a, const DoubleWord<S>& b) {
#if defined(LIECHECK_FMA)
  if constexpr (std::is_floating_point_v<Lane<S>>)
    return mul_add(a.high, b.high, mul_add(a.low, S(b.high + b.low), S(a.high * b.low)));
#endif
  const auto x = fast_two_sum<S>(a.high, a.low), y = fast_two_sum<S>(b.high, b.low);
  return mul_add(x.high, y.high, mul_add(x.high, y.low, S(x.low * y.high)));
}
template <Scalar S>
[[gnu::always_inline]] inline S rounded_square(const DoubleWord<S>& a) {
#if defined(LIECHECK_FMA)
  if constexpr (std::is_floating_point_v<Lane<S>>)
    return mul_add(a.high, a.high, S(a.low * (a.high + S(a.high + a.low))));
#endif
  const auto x = fast_two_sum<S>(a.high, a.low);
  const auto sum = SplitDot<S, 1>::square(x.high);
  return sum.high + (sum.low_a + S(2) * x.high * x.low);
}

/// a . b of N numbers with the exact sign and a relative error of 2 eps, however much cancels and however
/// small the products are. A sum that underflows becomes the smallest normal number with the sum's sign. The
/// products are summed as a nonoverlapping expansion (Shewchuk 1997, theorem 10), the largest first, scaled
/// so that no part underflows. After a cancellation the sum is scaled up again. Double words are multiplied
/// part by part.
template <Scalar S, int N, class V, Scalar Result = S>
Result exact_dot(const V& a, const V& b) {
  using std::frexp, std::ldexp;
  if constexpr (requires(S number) { number.low; }) {
    using Part = decltype(S::low);
    std::array<Part, 4 * N> x, y;
    for (int i = 0; i < 4 * N; ++i) {
      x[i] = i & 1 ? a[i / 4].low : a[i / 4].high;
      y[i] = i & 2 ? b[i / 4].low : b[i / 4].high;
    }
    return exact_dot<Part, 4 * N, std::array<Part, 4 * N>, S>(x, y);
  }
  constexpr int gap = 2 * std::numeric_limits<S>::digits + 12, none = std::numeric_limits<int>::min();
  constexpr int log2_n = std::bit_width(unsigned(N));
  std::array<S, N> x, y;
  std::array<int, N> exponent;  // of each product; none if it is zero or already added
  for (int i = 0; i < N; ++i) {
    int ea = 0, eb = 0;
    x[i] = frexp(S(a[i]), &ea), y[i] = frexp(S(b[i]), &eb);
    exponent[i] = x[i] == S(0) || y[i] == S(0) ? none : ea + eb;
  }
  std::array<S, 2 * N> expansion;
  int size = 0, scale = 0;  // the result is 2^scale times the sum of the expansion
  const auto grow = [&](S t) {
    for (int i = 0; i < size; ++i) {
      const auto [sum, error] = two_sum(t, expansion[i]);
      expansion[i] = error;
      t = sum;
    }
    expansion[size++] = t;
  };
  Result sum(0);
  for (;;) {
    int top = none;
    for (const int e : exponent) top = e > top ? e : top;
    if (top == none) break;
    if (sum != Result(0)) {
      int e = 0;
      static_cast<void>(frexp(sum, &e));
      if (top < e + scale - std::numeric_limits<Result>::digits - log2_n)
        break;  // all other products are below eps of the sum
      if (top < e + scale) top = e + scale;
    }
    for (int i = 0; i < size; ++i) expansion[i] = S(ldexp(expansion[i], scale - top));
    scale = top;
    for (int i = 0; i < N; ++i) {
      if (exponent[i] == none || exponent[i] < top - gap) continue;
      const auto [p, e] = two_prod(S(ldexp(x[i], exponent[i] - top)), y[i]);
      grow(e);
      grow(p);
      exponent[i] = none;
    }
    sum = Result(0);
    for (int i = 0; i < size; ++i) sum += Result(expansion[i]);
  }
  const Result result = Result(ldexp(sum, scale)), least = Result(std::numeric_limits<S>::min());
  if (sum != Result(0) && result < least && result > -least) return sum < Result(0) ? Result(-least) : least;
  return result;
}

}  // namespace liecheck

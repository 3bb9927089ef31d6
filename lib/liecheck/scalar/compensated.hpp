#pragma once
// Error-free transformations (Dekker 1971; Ogita, Rump & Oishi 2005), for the few sums whose terms cancel.

#include <array>
#include <bit>
#include <liecheck/scalar/precision.hpp>
#include <liecheck/scalar/scalar.hpp>
#include <limits>
#include <utility>

namespace liecheck {

/// (s, e) with s = fl(a + b) and s + e = a + b exactly. Knuth (1969), 4.2.2 theorem B. No overflow assumed.
template <Scalar S>
std::pair<S, S> two_sum(const S& a, const S& b) {
  const S s = a + b;
  const S b_virtual = s - a;
  const S a_virtual = s - b_virtual;
  return {s, (a - a_virtual) + (b - b_virtual)};
}

/// (h, l) with a = h + l, each with half the digits. Veltkamp (1968); |a| < max / 2^(digits / 2 + 1).
template <Scalar S>
std::pair<S, S> split(const S& a) {
  using std::ldexp;
  constexpr int half = (std::numeric_limits<S>::digits + 1) / 2;
  static const S factor = S(ldexp(S(1), half)) + S(1);
  const S c = factor * a;
  const S high = c - (c - a);
  return {high, a - high};
}

/// (p, e) with p = fl(a b) and p + e = a b exactly, barring underflow. Dekker (1971), eq. 5.14.
template <Scalar S>
std::pair<S, S> two_product(const S& a, const S& b) {
  const S p = a * b;
#if defined(__FMA__)
  if constexpr (std::is_floating_point_v<S>) return {p, std::fma(a, b, -p)};
#endif
  const auto [ah, al] = split(a);
  const auto [bh, bl] = split(b);
  return {p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
}

/// Sum of products a_i b_i as if computed in twice the digits, then rounded: error at most
/// eps |sum| + n^2 eps^2 sum |a_i b_i|. Ogita, Rump & Oishi (2005), algorithm 5.3 (Dot2).
/// In fast precision, as usual.
template <Scalar S, Precision P = Precision::standard>
class CompensatedSum {
 public:
  CompensatedSum& add_product(const S& a, const S& b) {
    if constexpr (P == Precision::fast) {
      high_ = mul_add(a, b, high_);
      return *this;
    }
    const auto [p, pe] = two_product(a, b);
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
  /// (value, what it leaves of the sum).
  std::pair<S, S> pair() const { return two_sum<S>(high_, low_); }

 private:
  S high_ = S(0);
  S low_ = S(0);
};

/// A number cut in two at a fixed place: head + tail = value exactly, the head a multiple of 2^-f, f = (digits - BITS)/2,
/// so that a sum of products of heads is exact while it stays below 2^BITS: no product is ever split (Rump, Ogita &
/// Oishi 2008, algorithm 3.2). |value| < 2^(digits/2 - 1); any larger one is only rounded as usual. In fast
/// precision, the value alone. S may be several numbers at once.
template <class S, int BITS, Precision P = Precision::standard>
struct Cut {
  S value, head, tail;
  [[gnu::always_inline]] Cut(const S& x) : value(x), head(x), tail(S(0)) {
    if constexpr (P != Precision::fast) {
      using std::ldexp;
      using Number = Lane<S>;
      constexpr int digits = std::numeric_limits<Number>::digits, places = (digits - BITS) / 2;
      const S cut(Number(ldexp(Number(3), digits - 2 - places)));
      head = (x + cut) - cut;
      tail = x - head;
    }
  }
  /// Cut where `place` has its last digit instead: at 2^(places + 1) times a bound of numbers of any size.
  [[gnu::always_inline]] Cut(const S& x, const S& place) : value(x), head(x), tail(S(0)) {
    if constexpr (P != Precision::fast) {
      head = (x + place) - place;
      tail = x - head;
    }
  }
  /// The parts as they are.
  [[gnu::always_inline]] static Cut of(const S& value, const S& head, const S& tail) {
    Cut c = value;
    c.head = head, c.tail = tail;
    return c;
  }
  [[gnu::always_inline]] friend Cut operator-(Cut a) {
    a.value = -a.value, a.head = -a.head, a.tail = -a.tail;
    return a;
  }
  /// high + low, cut where `place` has its last digit.
  [[gnu::always_inline]] Cut(const S& high, const S& low, const S& place) : Cut(high, place) {
    if constexpr (P != Precision::fast) {
      tail = tail + low;
      value = head + tail;
    }
  }
};

/// sum a b as high + low, high the exact sum of the products of heads: error 2^-(digits/2 - BITS) eps of sum |a b|.
template <class S, int BITS, Precision P = Precision::standard>
struct CutSum {
  S high = S(0), low_a = S(0), low_b = S(0);  ///< low in two parts, which do not wait for one another
  [[gnu::always_inline]] CutSum& add_product(const Cut<S, BITS, P>& a, const Cut<S, BITS, P>& b) {
    high = mul_add(a.head, b.head, high);
    if constexpr (P != Precision::fast) {
      low_a = mul_add(a.tail, b.value, low_a);
      low_b = mul_add(a.head, b.tail, low_b);
    }
    return *this;
  }
  [[gnu::always_inline]] CutSum& add_square(const Cut<S, BITS, P>& a) {
    high = mul_add(a.head, a.head, high);
    if constexpr (P != Precision::fast) low_a = mul_add(a.tail, S(a.value + a.head), low_a);
    return *this;
  }
  [[gnu::always_inline]] S low() const { return low_a + low_b; }
  [[gnu::always_inline]] S value() const {
    if constexpr (P == Precision::fast) return high;
    return high + low();
  }
  /// What `value` leaves of the sum.
  [[gnu::always_inline]] S rest(const S& value) const {
    if constexpr (P == Precision::fast) return S(0);
    return (high - value) + low();
  }
};

/// head + tail, the tail small and already rounded; and the same as value + low, the value rounded once more.
template <Scalar S>
struct TwoParts {
  S head, tail, value, low;
  TwoParts() = default;
  [[gnu::always_inline]] TwoParts(const S& h, const S& t)
      : head(h), tail(t), value(h + t), low((h - value) + t) {}
};

/// a b and a^2, rounded once and by eps/2 of the tails' share. Fused, they wait neither for low nor, but for that share,
/// for the value; else the heads' product would be rounded too. |value| < 2^(digits/2 - 1).
template <Scalar S>
[[gnu::always_inline]] inline S product(const TwoParts<S>& a, const TwoParts<S>& b) {
#if defined(__FMA__)
  if constexpr (std::is_floating_point_v<Lane<S>>)
    return mul_add(a.head, b.head, mul_add(a.tail, b.value, S(a.head * b.tail)));
#endif
  return mul_add(a.value, b.value, mul_add(a.value, b.low, S(a.low * b.value)));
}
template <Scalar S>
[[gnu::always_inline]] inline S square(const TwoParts<S>& a) {
#if defined(__FMA__)
  if constexpr (std::is_floating_point_v<Lane<S>>)
    return mul_add(a.head, a.head, S(a.tail * (a.head + a.value)));
#endif
  const auto sum = CutSum<S, 1>().add_square(a.value);
  return sum.high + (sum.low_a + S(2) * a.value * a.low);
}

/// a . b with its exact sign and a relative error of 2 eps however much cancels and however small the products
/// are; a sum that underflows is the smallest normal number with its sign. The products are summed as a
/// nonoverlapping expansion (Shewchuk 1997, theorem 10), largest first and scaled to that, so that no part underflows;
/// what is left after a cancellation is scaled up again before the next ones.
template <Scalar S, int N, class V>
S exact_dot(const V& a, const V& b) {
  using std::frexp, std::ldexp;
  constexpr int gap = 2 * std::numeric_limits<S>::digits + 12, none = std::numeric_limits<int>::min();
  constexpr int log2_n = std::bit_width(unsigned(N));
  std::array<S, N> x, y;
  std::array<int, N> exponent;  // none: added, or zero
  for (int i = 0; i < N; ++i) {
    int ea = 0, eb = 0;
    x[i] = frexp(S(a[i]), &ea), y[i] = frexp(S(b[i]), &eb);
    exponent[i] = x[i] == S(0) || y[i] == S(0) ? none : ea + eb;
  }
  std::array<S, 2 * N> expansion;
  int size = 0, scale = 0;  // of the sum: that of the expansion times 2^scale
  const auto grow = [&](S t) {
    for (int i = 0; i < size; ++i) {
      const auto [sum, rest] = two_sum(t, expansion[i]);
      expansion[i] = rest;
      t = sum;
    }
    expansion[size++] = t;
  };
  S sum(0);
  for (;;) {
    int top = none;
    for (const int e : exponent) top = e > top ? e : top;
    if (top == none) break;
    if (sum != S(0)) {
      int e = 0;
      frexp(sum, &e);
      if (top < e + scale - std::numeric_limits<S>::digits - log2_n) break;  // the rest: below an eps of it
      if (top < e + scale) top = e + scale;
    }
    for (int i = 0; i < size; ++i) expansion[i] = S(ldexp(expansion[i], scale - top));
    scale = top;
    for (int i = 0; i < N; ++i) {
      if (exponent[i] == none || exponent[i] < top - gap) continue;
      const auto [p, e] = two_product(S(ldexp(x[i], exponent[i] - top)), y[i]);
      grow(e);
      grow(p);
      exponent[i] = none;
    }
    sum = S(0);
    for (int i = 0; i < size; ++i) sum += expansion[i];
  }
  const S result = S(ldexp(sum, scale)), least = std::numeric_limits<S>::min();
  if (sum != S(0) && result < least && result > -least) return sum < S(0) ? S(-least) : least;
  return result;
}

}  // namespace liecheck

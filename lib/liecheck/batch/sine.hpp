#pragma once
// sin and cos of a pack of angles.

#include <liecheck/batch/pack.hpp>
#include <liecheck/scalar/stumpff.hpp>

namespace liecheck::batch::detail {

/// c_K(x), K = 0 or 1, on [0, (pi/4)^2]: 0.617 < 5/8. scalar/stumpff.hpp economises it.
template <class S, int K>
struct SineSeries {
  static constexpr int most = std::numeric_limits<S>::digits / 5 + 10, outer = 2;
  static constexpr S domain() { return S(5) / S(8); }
  static constexpr S first() { return S(1); }
  static constexpr S ratio(int j) { return S(-1) / S((2 * j + K - 1) * (2 * j + K)); }
};
template <class S>
using CosineSeries0 = SineSeries<S, 0>;
template <class S>
using SineSeries1 = SineSeries<S, 1>;

/// Error 1 eps for sine (relative) and cosine (absolute). With angle = k pi/2 + r, |r| <= pi/4, the series
/// gives those of r (Cody & Waite 1980, chapter 8). Lanes with |angle| > 512 or not finite call std::sin and
/// std::cos.
template <class P>
struct SineAndCosine {
  P sine, cosine;

  [[gnu::always_inline]] explicit SineAndCosine(const P& angle) {
    using S = Lane<P>;
    // k pi/2 is exact in the first two parts for |k| < 2^9: they have digits - 10 bits.
    constexpr bool wide = sizeof(S) == 8;
    constexpr S part1 = wide ? S(0x1.921fb54442cp+0) : S(0x1.9218p+0),
                part2 = wide ? S(0x1.18469898cc4p-44) : S(0x1.ed5p-14),
                part3 = wide ? S(0x1.1701b839a252p-88) : S(0x1.10b462p-30);
    const P shift(S(3) * S(std::size_t(1) << (std::numeric_limits<S>::digits - 2)));
    const P k = (mul_add(angle, P(S(0.63661977236758134308)), shift)) - shift;
    const P near = mul_add(-k, P(part1), angle), second = k * P(part2), rough = near - second;
    const P r = rough + mul_add(-k, P(part3), (near - rough) - second), x = r * r;
    const P s = mul_add(r * x, stumpff_detail::evaluate<SineSeries1, 1>(x), r),
            c = mul_add(x, stumpff_detail::evaluate<CosineSeries0, 1>(x), P(1));
    // k = 4 n + m, m in {-2, ..., 2}.
    const P m = k - P(4) * (mul_add(k, P(S(0.25)), shift) - shift), size = fabs(m);
    const auto odd = size.v == P(1).v, negative_sine = (m.v < P(0).v) | (size.v == P(2).v),
               negative_cosine = (m.v == P(1).v) | (size.v == P(2).v);
    sine = P::select(odd, c, s), cosine = P::select(odd, s, c);
    sine = P::select(negative_sine, -sine, sine), cosine = P::select(negative_cosine, -cosine, cosine);
    const auto moderate = fabs(angle).v <= P(512).v;
    if (!P::all(moderate)) [[unlikely]]
      for (int lane = 0; lane < P::size; ++lane)
        if (moderate[lane] == 0)
          sine.v[lane] = std::sin(angle.v[lane]), cosine.v[lane] = std::cos(angle.v[lane]);
  }
};

}  // namespace liecheck::batch::detail

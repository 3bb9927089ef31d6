#pragma once
// Coefficients of exp and of its Jacobians for the subjects correct:NAME, in three families of formulas.
//
//   c_k(theta) = sum_j (-theta^2)^j / (2j + k)!,  c_0 = cos theta, c_1 = sin theta / theta,
//   c_k = (1/(k-2)! - c_(k-2)) / theta^2
//
// All families take the series where the closed forms cancel, for theta below 1, 2 or 3, and compute
// 1 - cos theta without cancellation near 2 pi k. Source: Stumpff 1959, chapter V.

#include <array>
#include <cmath>
#include <limits>

namespace liecheck::properties::correct {

/// c_0 ... c_6
template <class W>
using Coefficients = std::array<W, 7>;

inline constexpr int factorials[] = {1, 1, 2, 6, 24, 120, 720};

/// c_5 and c_6 by their series in x = theta^2, the others by c_k = 1/k! - x c_(k+2).
template <class W>
Coefficients<W> series(const W& x) {
  Coefficients<W> c;
  for (int k : {5, 6}) {
    W& sum = c[static_cast<std::size_t>(k)];
    W term = sum = W(1) / factorials[k];
    for (int n = k + 1; std::abs(term) > std::numeric_limits<W>::epsilon() / 8 * sum; n += 2)
      sum += term *= -x / W(n * (n + 1));
  }
  for (std::size_t k = 5; k-- > 0;) c[k] = W(1) / factorials[k] - x * c[k + 2];
  return c;
}

/// All c_k from sin theta and 1 - cos theta.
template <class W>
Coefficients<W> closed(const W& theta, const W& sine, const W& versine) {
  const W x = theta * theta;
  Coefficients<W> c{W(1) - versine, sine / theta, versine / x};
  for (std::size_t k = 3; k < 7; ++k) c[k] = (W(1) / factorials[k - 2] - c[k - 2]) / x;
  return c;
}

/// sin theta = 2 s c and 1 - cos theta = 2 s^2 of the half angle.
template <class W>
Coefficients<W> by_half_angles(const W& theta) {
  if (theta < W(3)) return series(W(theta * theta));
  const W s = std::sin(theta / 2), c = std::cos(theta / 2);
  return closed(theta, W(2 * s * c), W(2 * s * s));
}

/// sin theta and cos theta, as most books print them.
template <class W>
Coefficients<W> by_full_angles(const W& theta) {
  if (theta < W(2)) return series(W(theta * theta));
  const W s = std::sin(theta), c = std::cos(theta);
  return closed(theta, s, c < 0 ? W(1 - c) : W(s * s / (1 + c)));
}

/// sin theta and 1 - cos theta are rational in t = tan(theta/2).
template <class W>
Coefficients<W> by_tangents(const W& theta) {
  if (theta < W(2)) return series(W(theta * theta));
  const W t = std::tan(theta / 2), u = t / (1 + t * t);
  return closed(theta, W(2 * u), W(2 * t * u));
}

/// dc_k/dtheta / theta = k c_(k+2) - c_(k+1) for k = 2 and 3, the coefficients of the derivative of J. Far
/// from 0, c_(k+2) and c_(k+1) nearly cancel, and this difference is formed before it is divided by theta^2.
template <class W>
W slope(int k, const W& theta, const Coefficients<W>& c) {
  const auto at = static_cast<std::size_t>(k);
  if (theta < W(2)) return k * c[at + 2] - c[at + 1];
  return (c[at - 1] - k * c[at]) / (theta * theta);
}

/// e and de/dx of J^-1 = I - [phi]/2 + e [phi]^2, where e = (1 - (theta/2) cot(theta/2)) / theta^2.
template <class W>
struct InverseCoefficients {
  W e, slope;

  InverseCoefficients(const W& theta, const Coefficients<W>& c) {
    const W x = theta * theta;
    if (theta < W(2)) {  // the c_k satisfy dc_k/dx = (k c_(k+2) - c_(k+1)) / 2
      e = (c[3] - 2 * c[4]) / (2 * c[2]);
      slope = ((3 * c[5] - c[4]) / 2 - (4 * c[6] - c[5]) - e * (2 * c[4] - c[3])) / (2 * c[2]);
    } else {
      e = (1 - c[1] / (2 * c[2])) / x;
      slope = (c[3] / (4 * c[2]) - e) / x;
    }
  }
};

}  // namespace liecheck::properties::correct

#pragma once
// A reference solution for motions without a closed form: Gragg's modified midpoint rule, extrapolated in h^2
// (Bulirsch and Stoer). Solutions of two orders must agree. Hairer, Norsett and Wanner (1993), section II.9.

#include <oracles/motions/state.hpp>
#include <vector>

namespace liecheck::oracles {

template <class State, class T>
struct Extrapolated {
  State y;
  T disagreement;  ///< norm of the difference of the two orders at the end
};

/// y(t1) for y' = f(y) and y(0) = y, by steps of order 2 `columns`. The error estimate of a step is the
/// difference of the last two columns. It is at most `tolerance` (1 + ||y||).
template <int N, class T, class F>
Vec<N, T> extrapolate(const F& f, Vec<N, T> y, const T& t1, int columns, const T& tolerance) {
  const auto size = [](const Vec<N, T>& v) {
    T m(0);
    for (int i = 0; i < N; ++i) m = larger<T>(m, abs(v[i]));
    return m;
  };
  T t(0), H = t1;
  std::vector<Vec<N, T>> row(static_cast<std::size_t>(columns));
  while (t < t1) {
    const T h_step = smaller<T>(H, t1 - t);
    const Vec<N, T> slope = f(y);
    T error(0);
    for (int j = 0; j < columns; ++j) {
      const int n = 2 * (j + 1);
      const T h = h_step / n;
      Vec<N, T> before = y, now = y + h * slope;
      for (int i = 1; i < n; ++i) {
        Vec<N, T> next = before + T(2 * h) * f(now);
        before = now, now = next;
      }
      Vec<N, T> value = now;  // Gragg's smoothing is only needed for stiff motions
      for (int k = 1; k <= j; ++k) {
        const T ratio = T(j + 1) / T(j + 1 - k), weight = 1 / (ratio * ratio - 1);
        const Vec<N, T> last = row[static_cast<std::size_t>(k - 1)];
        row[static_cast<std::size_t>(k - 1)] = value;
        const Vec<N, T> change = weight * (value - last);
        value = value + change;
        error = size(change);
      }
      row[static_cast<std::size_t>(j)] = value;
    }
    const Vec<N, T>& end = row[static_cast<std::size_t>(columns - 1)];
    if (!(error <= tolerance * (1 + size(y)))) {
      H = h_step / 2;
      if (!(H > t1 * T(1e-9))) throw std::domain_error("extrapolate: the motion is too stiff, or not finite");
      continue;
    }
    y = end;
    t = h_step < t1 - t ? T(t + h_step) : t1;
    if (error * 1000 < tolerance * (1 + size(y))) H = h_step * T(1.25);
  }
  return y;
}

/// The solution of order 32, and its difference from that of order 28.
template <int N, class T, class F>
Extrapolated<Vec<N, T>, T> reference(const F& f, const Vec<N, T>& y0, const T& t1, const T& tolerance) {
  Extrapolated<Vec<N, T>, T> r;
  r.y = extrapolate<N, T>(f, y0, t1, 16, tolerance);
  const Vec<N, T> other = extrapolate<N, T>(f, y0, t1, 14, tolerance);
  r.disagreement = norm(r.y - other);
  return r;
}

}  // namespace liecheck::oracles

#pragma once
// Functions of time through the rows of a table (t_i, x_i1 ... x_im), with an interpolation that is named:
//
//   linear   x_i + s (x_(i+1) - x_i),  s = (t - t_i)/(t_(i+1) - t_i)
//   cubic    the cubic Hermite polynomial with the slopes d_i of the parabola through (t_(i-1), t_i, t_(i+1)), at the
//            ends of the first and the last three rows: continuous with its first derivative
//            (Bessel's interpolation: de Boor 2001, A Practical Guide to Splines, ch. IV)
//
// Before the first row and after the last one, x is constant. Each row is an event: between rows, x is a polynomial.
// Two rows with the same time are a jump of a linear table.

#include <algorithm>
#include <liecheck/scene/parameters.hpp>
#include <liecheck/spatial/types.hpp>

namespace liecheck::scene {

template <Scalar S>
class Curve {
 public:
  Curve() = default;
  Curve(const Value& table, bool cubic) : width_(table.width - 1), cubic_(cubic) {
    for (std::size_t i = 0; i < table.numbers.size(); i += table.width) {
      times_.push_back(S(table.numbers[i]));
      for (std::size_t k = 1; k < table.width; ++k) x_.push_back(S(table.numbers[i + k]));
    }
    if (!cubic) return;
    if (std::ranges::adjacent_find(times_) != times_.end())
      throw std::invalid_argument(
          "a table with a jump, two rows with the same time, has no cubic interpolation: write "
          "'interpolation: linear'");
    for (std::size_t i = 0; i < times_.size(); ++i)
      for (std::size_t k = 0; k < width_; ++k) slopes_.push_back(slope(i, k));
  }
  std::size_t width() const { return width_; }  ///< m, or 0 without a table
  const std::vector<S>& times() const { return times_; }

  struct Point {
    S x, rate;
  };
  /// x_k and its rate at t, by the polynomial of the interval that holds `piece`.
  Point at(const S& t, const S& piece, std::size_t k) const {
    const std::size_t i = std::size_t(std::upper_bound(times_.begin(), times_.end(), piece) - times_.begin());
    if (i == 0) return {x(0, k), S(0)};
    if (i == times_.size()) return {x(i - 1, k), S(0)};
    const S h = times_[i] - times_[i - 1], s = (t - times_[i - 1]) / h, rise = x(i, k) - x(i - 1, k);
    if (!cubic_) return {S(x(i - 1, k) + s * rise), S(rise / h)};
    // x = x0 + s (h d0 + s (b + s c)): Hermite's polynomial by the differences of its slopes and the chord
    const S d0 = h * slopes_[(i - 1) * width_ + k], d1 = h * slopes_[i * width_ + k];
    const S b = S(3) * rise - S(2) * d0 - d1, c = d0 + d1 - S(2) * rise;
    return {S(x(i - 1, k) + s * (d0 + s * (b + s * c))), S((d0 + s * (S(2) * b + s * (S(3) * c))) / h)};
  }

 private:
  const S& x(std::size_t i, std::size_t k) const { return x_[i * width_ + k]; }
  S chord(std::size_t i, std::size_t k) const {
    return (x(i + 1, k) - x(i, k)) / (times_[i + 1] - times_[i]);
  }
  /// The slope at row i of the parabola through the three rows nearest to it.
  S slope(std::size_t i, std::size_t k) const {
    const std::size_t n = times_.size();
    if (n == 1) return S(0);
    if (n == 2) return chord(0, k);
    const std::size_t m = std::clamp(i, std::size_t(1), n - 2);
    const S bend = (chord(m, k) - chord(m - 1, k)) / (times_[m + 1] - times_[m - 1]);
    return chord(m - 1, k) + bend * (S(2) * times_[i] - times_[m - 1] - times_[m]);
  }

  std::size_t width_ = 0;
  bool cubic_ = false;
  std::vector<S> times_, x_, slopes_;
};

/// The key `interpolation` of parts with a table.
inline const Key interpolation_key{"interpolation", Kind::Choice, "linear|cubic", "linear",
                                   "between the rows"};

/// The curve of a table among the parameters, empty if it is not given.
template <Scalar S>
Curve<S> curveOf(const Parameters& p, const std::string& key) {
  if (!p.has(key)) return {};
  return {p.table(key), p.has("interpolation") && p.word("interpolation") == "cubic"};
}

}  // namespace liecheck::scene

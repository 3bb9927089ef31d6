#pragma once
// A mergeable log-scale histogram of errors. It has 32 bins per octave, so quantiles are accurate to 2.2 %.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace liecheck::properties {

class Histogram {
 public:
  using Bins = std::vector<std::pair<int, std::uint64_t>>;

  void add(double x) {
    ++count_;
    if (!(x > 0)) {
      ++zeros_;
      return;
    }
    const int bin = bin_of(x);
    if (static_cast<std::size_t>(bin - first_) >= window_.size()) widen(bin);  // also if bin < first_
    ++window_[static_cast<std::size_t>(bin - first_)];
  }
  std::uint64_t count() const { return count_; }
  /// The bins and their counts, in ascending order.
  const Bins& bins() const {
    sort_in();
    return bins_;
  }
  void add_bin(int bin, std::uint64_t n) { merge_bins({{bin, n}}), count_ += n; }
  void merge(const Histogram& o) {
    merge_bins(o.bins());
    count_ += o.count_;
  }
  /// The upper edge of the bin that holds the quantile; 0 if the quantile is an exact zero.
  double quantile(double q) const {
    const auto rank = static_cast<std::uint64_t>(std::ceil(q * static_cast<double>(count_)));
    std::uint64_t seen = 0;
    for (const auto& [bin, n] : bins()) {
      seen += n;
      if (seen >= rank) return bin == zero ? 0.0 : std::exp2((bin + 1) / 32.0);
    }
    return 0;
  }

 private:
  static constexpr int zero = -1000000;

  /// floor(32 log2 x) for x > 0, by the exponent and a table of 2^(k/32): five times as fast as std::log2.
  static int bin_of(double x) {
    if (!std::isfinite(x)) return 40000;
    static const auto edges = [] {
      std::array<double, 33> e{};
      for (std::size_t k = 0; k <= 32; ++k) e[k] = std::exp2(static_cast<double>(k) / 32);
      return e;
    }();
    int exponent = 0;
    const double mantissa = 2 * std::frexp(x, &exponent);    // in [1, 2)
    auto k = static_cast<std::size_t>((mantissa - 1) * 32);  // m - 1 <= log2 m < m - 1 + 3/32
    while (mantissa >= edges[k + 1]) ++k;
    return std::clamp((exponent - 1) * 32 + static_cast<int>(k), -8000, 40000);
  }
  /// Widens the window so that it contains the block of 128 bins around this one.
  void widen(int bin) {
    const int from = (bin >> 7) * 128;
    if (window_.empty()) first_ = from;
    if (from < first_) window_.insert(window_.begin(), static_cast<std::size_t>(first_ - from), 0);
    first_ = std::min(first_, from);
    window_.resize(std::max(window_.size(), static_cast<std::size_t>(from + 128 - first_)));
  }
  void sort_in() const {
    Bins add;
    if (zeros_ > 0) add.emplace_back(zero, std::exchange(zeros_, 0));
    for (std::size_t i = 0; i < window_.size(); ++i)
      if (window_[i] > 0) add.emplace_back(first_ + static_cast<int>(i), std::exchange(window_[i], 0));
    merge_bins(add);
  }
  void merge_bins(const Bins& add) const {
    if (add.empty()) return;
    Bins all;
    all.reserve(bins_.size() + add.size());
    auto a = bins_.begin();
    for (const auto& b : add) {
      while (a != bins_.end() && a->first < b.first) all.push_back(*a++);
      all.push_back(b);
      if (a != bins_.end() && a->first == b.first) all.back().second += (a++)->second;
    }
    all.insert(all.end(), a, bins_.end());
    bins_ = std::move(all);
  }

  mutable Bins bins_;
  // Not yet counted in bins_:
  mutable std::uint64_t zeros_ = 0;
  mutable std::vector<std::uint64_t> window_;  ///< counts of the bins from first_ on
  int first_ = 0;
  std::uint64_t count_ = 0;
};

}  // namespace liecheck::properties

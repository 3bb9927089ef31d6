#pragma once
// A mergeable log-scale histogram of errors: 32 bins an octave, so a quantile is right to 2.2 %.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

namespace liecheck::properties {

class Histogram {
 public:
  void add(double x) {
    ++count_;
    ++bins_[x > 0 ? std::clamp(static_cast<int>(std::floor(std::log2(x) * 32)), -8000, 40000) : zero];
  }
  std::uint64_t count() const { return count_; }
  const std::map<int, std::uint64_t>& bins() const { return bins_; }
  void add_bin(int bin, std::uint64_t n) { bins_[bin] += n, count_ += n; }
  void merge(const Histogram& o) {
    count_ += o.count_;
    for (const auto& [bin, n] : o.bins_) bins_[bin] += n;
  }
  /// The upper edge of the bin that holds the quantile; 0 where that is an exact zero.
  double quantile(double q) const {
    const auto rank = static_cast<std::uint64_t>(std::ceil(q * static_cast<double>(count_)));
    std::uint64_t seen = 0;
    for (const auto& [bin, n] : bins_) {
      seen += n;
      if (seen >= rank) return bin == zero ? 0.0 : std::exp2((bin + 1) / 32.0);
    }
    return 0;
  }

 private:
  static constexpr int zero = -1000000;
  std::map<int, std::uint64_t> bins_;
  std::uint64_t count_ = 0;
};

}  // namespace liecheck::properties

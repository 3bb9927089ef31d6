#pragma once
// How many cases are measured together.

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace liecheck::properties {

/// Begins with one case, and doubles while a window takes little time. So a stop request waits for a short time
/// only, and a call of a whole window takes no longer than a call of a slow subject may.
class Window {
 public:
  /// The size of the next window, of at most `left` cases.
  std::uint64_t next(std::uint64_t left) {
    const auto now = Clock::now();
    if (now - start_ < brief) size_ = std::min(2 * size_, most);
    if (now - start_ > 4 * brief) size_ = std::max(size_ / 2, std::uint64_t(1));
    if (first_) size_ = 1;
    first_ = false, start_ = now;
    return std::min(size_, left);
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::uint64_t most = 128;
  static constexpr std::chrono::milliseconds brief{100};
  std::uint64_t size_ = 1;
  bool first_ = true;
  Clock::time_point start_ = Clock::now();
};

}  // namespace liecheck::properties

#pragma once
// Progress of long work, on standard error.

#include <chrono>
#include <functional>
#include <string>

namespace liecheck::properties {

/// On a terminal, a bar with the remaining time, rewritten at most five times a second; elsewhere, a plain line every ten
/// seconds. The destructor clears a bar that has no last line.
class Progress {
 public:
  explicit Progress(std::string what = "", bool quiet = false);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  /// `share` of the work in [0, 1]. detail(elapsed [s]), such as a count and its rate, is called where a line is due.
  void show(double share, const std::function<std::string(double)>& detail, bool last = false);
  double elapsed() const;  ///< [s]

 private:
  using Clock = std::chrono::steady_clock;
  std::string what_;
  bool terminal_, quiet_, open_ = false;
  Clock::time_point start_;
  double shown_ = 0;
};

}  // namespace liecheck::properties

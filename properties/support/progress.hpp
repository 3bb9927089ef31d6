#pragma once
// Shows the progress of long work on standard error.

#include <chrono>
#include <functional>
#include <string>

namespace liecheck::properties {

/// On a terminal, shows a bar with the remaining time, at most five times a second. Elsewhere, prints a line
/// every ten seconds. The destructor clears the bar.
class Progress {
 public:
  explicit Progress(std::string what = "", bool quiet = false);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  /// `share`: how much of the work is done, in [0, 1]. detail(elapsed [s]) returns text for the line, such as
  /// a count; it is called only if a line is printed. `last` ends the line, which then stays.
  void show(double share, const std::function<std::string(double)>& detail, bool last = false);
  void show(double share, const std::string& detail) {
    show(share, [&](double) { return detail; });
  }
  double elapsed() const;  ///< [s]

 private:
  using Clock = std::chrono::steady_clock;
  std::string what_;
  bool terminal_, quiet_, open_ = false;
  Clock::time_point start_;
  double shown_ = 0;
};

}  // namespace liecheck::properties

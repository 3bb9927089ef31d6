#pragma once
// Shows the progress of long work on standard error.

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace liecheck::properties {

/// On a terminal, shows a bar with the remaining time, at most five times a second. Elsewhere, prints a line
/// every ten seconds. The destructor clears the bar.
class Progress {
 public:
  explicit Progress(std::string what = "", bool quiet = false);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  /// `share`: how much of the work is done, in [0, 1], or -1 if nobody knows. detail(elapsed [s]) returns text for the line, such as
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

/// Shows how many of equal pieces of work, of several threads, are done, from a thread of its own, so that a piece that
/// takes long is no silence. Without a number of pieces it shows, off a terminal, that the work goes on.
class Steps {
 public:
  explicit Steps(std::string what, std::size_t all = 0);
  void done(const std::string& piece);

 private:
  Progress progress_;
  std::mutex mutex_;
  std::string piece_;
  std::size_t done_ = 0, all_;
  std::condition_variable_any ended_;
  std::jthread shows_;  ///< the last member: it ends before what it reads
};

/// Shows how many pieces of a number that nobody knows are done, and looks at them and at signals at every `every`th. If
/// the pieces have no name, it shows the time alone.
class Counted {
 public:
  explicit Counted(std::string what, std::string pieces = "rows", std::size_t every = 256);
  void next();      ///< throws GivenUp at a signal, unless the work has just begun
  bool given_up();  ///< whether next() would; shows the pieces

 private:
  Progress progress_;
  std::string pieces_;
  std::size_t every_, done_ = 0;
};

}  // namespace liecheck::properties

#pragma once
// What a signal stops: Ctrl-C (SIGINT), SIGTERM or SIGHUP. The handler is in app/command.cpp.
//
// As long as there is nothing to lose, the first signal ends the program at once, with exit code 3: while it
// reads its input, which may be a pipe without data, and in commands that only print. Once there are results
// or an unfinished file, it sets stop_requested, and the command ends with what was done.

#include <atomic>

namespace liecheck::properties {

/// Set by a signal and polled by long work. The step in progress is finished or dropped; no new one begins.
inline std::atomic<bool> stop_requested{false};

/// While one exists, a signal sets stop_requested instead of ending the program.
class Unfinished {
 public:
  Unfinished() { ++count_; }
  ~Unfinished() { --count_; }
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;
  static bool any() { return count_ > 0; }

 private:
  static inline std::atomic<int> count_{0};
  static_assert(std::atomic<int>::is_always_lock_free);  // a signal handler reads it
};

}  // namespace liecheck::properties

#pragma once
// What a signal stops: Ctrl-C (SIGINT), SIGTERM or SIGHUP. The handler is in app/command.cpp.
//
// As long as there is nothing to lose, the first signal ends the program at once, with exit code 3: while it
// reads its input, which may be a pipe without data, and in commands that only print. Once there are results
// or an unfinished file, it sets stop_requested, and the command ends with what was done.

#include <atomic>
#include <chrono>

namespace liecheck::properties {

/// Set by a signal and polled by long work. The step in progress is finished or dropped; no new one begins.
inline std::atomic<bool> stop_requested{false};

/// When the first signal came, in milliseconds of the steady clock; 0 before.
inline std::atomic<long> signalled_at{0};

/// Whether SIGALRM has a handler, which says what the program waits for: then it is sent a second after the signal.
inline std::atomic<bool> tells_what_it_waits_for{false};

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

/// Thrown by a call that is given up because the program must end: its case is dropped. It is no std::exception, so that
/// no law takes it for a refusal.
struct GivenUp {};

/// While one exists, slow calls of adapters on this thread are given up at stop_requested and after `until`, if there is
/// an end: the clock is not read without one, because long sums ask at every row. Soon after a
/// signal, those of every thread are given up: what is printed at the end may call an adapter only if that is fast.
class GivesUp {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr Clock::time_point never = Clock::time_point::max();
  explicit GivesUp(Clock::time_point until) {
    exists_ = true;
    until_ = until;
  }
  ~GivesUp() { exists_ = false; }
  GivesUp(const GivesUp&) = delete;
  GivesUp& operator=(const GivesUp&) = delete;
  static bool now() {
    const long signal = signalled_at;
    return (exists_ && (stop_requested || (until_ != never && Clock::now() > until_))) ||
           (signal && Clock::now().time_since_epoch() > std::chrono::milliseconds(signal) + grace);
  }

 private:
  static constexpr std::chrono::milliseconds grace{700};
  static inline thread_local bool exists_ = false;
  static inline thread_local Clock::time_point until_ = never;
};

}  // namespace liecheck::properties

#pragma once
// The number of machine instructions of a piece of code, counted one by one: the processor's trap flag raises a signal
// after each instruction, whose handler counts (Intel SDM 3A, 17.3.1.4). It needs no other program and no privilege.
//
// An instruction takes 2 to 30 us, so that a count is usually of a sample: a call of a function runs without traps and
// adds the mean of those calls that were counted, if two with the same small whole numbers as arguments (the index of a
// joint, a size) were, and agree. For that, the handler replaces the return address of the call by that of a trampoline,
// which sets the trap flag again. In a hurry, one such call suffices, and for most others the mean of any eight.

#include <functional>
#include <optional>

namespace liecheck::scene {

/// Counts one call at a time in a process. None on processors other than x86-64, or where nothing delivers the signal.
class InstructionCounter {
 public:
  using Work = std::function<void()>;
  /// If `every`, counts each instruction instead of a sample. No count takes longer than `seconds` after this; it is in
  /// a hurry in the second half of them, or always if they do not suffice for about `expected` instructions.
  explicit InstructionCounter(bool every = true, double seconds = 1e9, double expected = 0);

  /// The instructions of one call of f; none if the time does not suffice. Before it, f has run at least once, so that
  /// nothing is initialised while it is counted, and has thrown nothing. `before` runs before f and is not counted.
  std::optional<long> count(const Work& f, const Work& before = {}) const;
  /// Within f, its instructions so far.
  double soFar() const;
  bool hurried() const { return hurried_; }

 private:
  bool every_, hurried_ = false;
  double until_, half_;  ///< [s]
};

}  // namespace liecheck::scene

#pragma once
// The number of machine instructions of a piece of code, counted one by one: the processor's trap flag raises a signal
// after each instruction, whose handler counts (Intel SDM 3A, 17.3.1.4). It needs no other program and no privilege.

#include <functional>
#include <optional>

namespace liecheck::scene {

/// The instructions of one call of f; none on processors other than x86-64, or where nothing delivers the signal. f
/// runs once before, so that nothing is initialised while it is counted. An instruction takes about 20 us. One call at
/// a time in a process.
std::optional<long> countInstructions(const std::function<void()>& f);

}  // namespace liecheck::scene

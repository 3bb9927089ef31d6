#pragma once
// Counts the instructions that this thread retires in user space, if Linux offers a hardware counter.

#include <cstdint>
#include <string>

namespace liecheck::properties {

class InstructionCounter {
 public:
  InstructionCounter();
  ~InstructionCounter();
  InstructionCounter(const InstructionCounter&) = delete;
  InstructionCounter& operator=(const InstructionCounter&) = delete;
  /// Why there is no counter ("perf_event_open: ..."); empty if there is one.
  const std::string& absent() const { return absent_; }
  void start();
  /// The instructions since start(); 0 if there is no counter, or if it did not run all the time.
  std::uint64_t stop();

 private:
  int file_ = -1;
  std::string absent_;
};

}  // namespace liecheck::properties

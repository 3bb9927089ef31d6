#pragma once
// Instructions that this thread retires in user space, by Linux's hardware counter where there is one.

#include <cstdint>
#include <string>

namespace liecheck::properties {

class InstructionCounter {
 public:
  InstructionCounter();
  ~InstructionCounter();
  InstructionCounter(const InstructionCounter&) = delete;
  InstructionCounter& operator=(const InstructionCounter&) = delete;
  /// Why there is none ("perf_event_open: ..."); empty where there is.
  const std::string& absent() const { return absent_; }
  void start();
  /// Since start(); 0 where there is no counter, or where it did not run all the time.
  std::uint64_t stop();

 private:
  int file_ = -1;
  std::string absent_;
};

}  // namespace liecheck::properties

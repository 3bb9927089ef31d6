#include <timing/instructions.hpp>

#include <linux/perf_event.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace liecheck::properties {

InstructionCounter::InstructionCounter() {
  perf_event_attr a{};
  a.size = sizeof a;
  a.type = PERF_TYPE_HARDWARE;
  a.config = PERF_COUNT_HW_INSTRUCTIONS;
  a.disabled = a.exclude_kernel = a.exclude_hv = 1;
  a.read_format = PERF_FORMAT_TOTAL_TIME_ENABLED | PERF_FORMAT_TOTAL_TIME_RUNNING;
  file_ = static_cast<int>(::syscall(SYS_perf_event_open, &a, 0, -1, -1, 0));
  if (file_ < 0) absent_ = std::string("perf_event_open: ") + std::strerror(errno);
}

InstructionCounter::~InstructionCounter() {
  if (file_ >= 0) ::close(file_);
}

void InstructionCounter::start() {
  if (file_ < 0) return;
  ::ioctl(file_, PERF_EVENT_IOC_RESET, 0);
  ::ioctl(file_, PERF_EVENT_IOC_ENABLE, 0);
}

std::uint64_t InstructionCounter::stop() {
  if (file_ < 0) return 0;
  ::ioctl(file_, PERF_EVENT_IOC_DISABLE, 0);
  struct {
    std::uint64_t count, enabled, running;
  } read{};
  if (::read(file_, &read, sizeof read) != sizeof read || read.running < read.enabled) return 0;
  return read.count;
}

}  // namespace liecheck::properties

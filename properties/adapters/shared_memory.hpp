#pragma once
// Memory through which the program calls a shared library in a process of its own. Standard input and output
// of that process only wake a side that sleeps, and show that the other side has ended.

#include <adapters/adapter.hpp>
#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <support/stop.hpp>
#include <thread>

namespace liecheck::properties::adapters {

/// One call at a time. The program writes the call and counts `asked` up; the adapter answers and sets
/// `answered` to it.
struct Exchange {
  alignas(64) std::atomic<std::uint32_t> asked{0};
  std::atomic<bool> adapter_sleeps{false};
  alignas(64) std::atomic<std::uint32_t> answered{0};
  std::atomic<bool> program_sleeps{false};
  alignas(64) std::uint32_t operation = 0;  ///< its place in all_sizes(), then in model_operations()
  std::uint32_t is_double = 0, n = 0;
  std::uint32_t inputs = 0, results = 0;             ///< numbers of one call
  std::array<char, 256> reason{};                    ///< of a refusal, ended by 0
  alignas(64) std::array<std::byte, 1 << 22> bytes;  ///< the inputs, the results, the status of each
};
/// In place of an operation: `bytes` holds the `n` characters of the model that the following calls are about.
inline constexpr std::uint32_t is_a_model = 0xffffffff;
static_assert(std::atomic<std::uint32_t>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

/// The parts of Exchange::bytes for `n` calls, or for as many of them as have room.
struct Parts {
  std::size_t n, inputs, results;
  Parts(const OperationSizes& o, bool is_double, std::size_t wanted)
      : n(wanted), inputs(o.inputs * (is_double ? 8 : 4)), results(o.results * (is_double ? 8 : 4)) {
    n = std::min(n, std::tuple_size_v<decltype(Exchange::bytes)> / (inputs + results + 1));
    inputs *= n, results *= n;
  }
};

/// Waits until `ready`: first it looks, then it leaves its processor to others for about a millisecond, in which a
/// campaign makes the next inputs, then sleep() returns when the other side wakes this one, which takes as long as 50
/// cases. It looks less often after looking did not help, because then the other side has no processor of its own. On a
/// busy machine, leaving the processor takes seconds, so that at stop_requested sleep() comes at once, which may give up.
template <class Ready, class Sleep>
void wait_for(std::atomic<bool>& sleeps, const Ready& ready, const Sleep& sleep) {
  constexpr int most = 4000, least = 150, yields = 1000;
  thread_local int looks = most;
  for (int i = 0; i < looks + yields && !stop_requested; ++i) {
    if (ready()) {
      looks = i < looks ? std::min(most, 2 * looks) : std::max(least, looks / 4);
      return;
    }
    if (i >= looks) std::this_thread::yield();
#ifdef __SSE2__
    __builtin_ia32_pause();
#endif
  }
  looks = std::max(least, looks / 4);
  for (;;) {
    sleeps = true;
    if (ready()) break;
    sleep();
    if (ready()) break;
  }
  sleeps = false;
}

/// A file descriptor of new shared memory that holds an Exchange.
class SharedMemory {
 public:
  SharedMemory();                                  ///< new
  explicit SharedMemory(const std::string& file);  ///< of a path of another one
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;
  ~SharedMemory();
  Exchange& operator*() const { return *exchange_; }
  Exchange* operator->() const { return exchange_; }
  std::string path() const;  ///< by which a child of this process opens it

 private:
  void map(const char* what);
  int file_ = -1;
  Exchange* exchange_ = nullptr;
};

}  // namespace liecheck::properties::adapters

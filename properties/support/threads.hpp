#pragma once
// Runs work on several threads. Either all threads start the work, or none.

#include <fmt/format.h>

#include <atomic>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace liecheck::properties {

/// Runs work() on `count` threads, including the calling one, and waits until all have returned. Work begins
/// when all threads exist. If fewer can be started, throws std::runtime_error with their number. The first
/// exception in work() sets `stop`, which work() must poll. It is rethrown at the end.
template <class Work>
void run_on_threads(unsigned count, std::atomic<bool>& stop, const Work& work) {
  enum Gate { closed, open, cancelled };
  std::atomic<int> gate{closed};
  std::mutex mutex;
  std::exception_ptr error;
  const auto guarded = [&] {
    try {
      work();
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!error) error = std::current_exception();
      stop = true;
    }
  };
  std::vector<std::thread> threads;
  threads.reserve(count);
  std::string why;
  try {
    for (unsigned t = 1; t < count; ++t)
      threads.emplace_back([&] {
        gate.wait(closed);
        if (gate == open) guarded();
      });
  } catch (const std::exception& e) {  // std::system_error, or std::bad_alloc
    why = fmt::format("--jobs {}: only {} threads could be started: {}", count, threads.size() + 1, e.what());
  }
  gate = why.empty() ? open : cancelled;
  gate.notify_all();
  if (why.empty()) guarded();
  for (auto& t : threads) t.join();
  if (!why.empty()) throw std::runtime_error(why);
  if (error) std::rethrow_exception(error);
}

}  // namespace liecheck::properties

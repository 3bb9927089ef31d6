#include <app/command.hpp>

#include <csignal>
#include <ctime>
#include <support/stop.hpp>

namespace liecheck::properties {

namespace {

extern "C" void on_signal(int number) {
  static std::atomic<long> stopped_at{-1};  // [ms]
  timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  const long now = t.tv_sec * 1000 + t.tv_nsec / 1000000;
  long first = -1;
  if (!stopped_at.compare_exchange_strong(first, now) && now - first > 300)
    std::signal(number, SIG_DFL), std::raise(number);
  stop_requested = true;
}

}  // namespace

void stop_on_signals() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP})
    if (std::signal(number, on_signal) == SIG_IGN) std::signal(number, SIG_IGN);
}

}  // namespace liecheck::properties

#pragma once
// The request to stop, set by a signal handler and polled by long work.

#include <atomic>

namespace liecheck::properties {

/// Set by Ctrl-C, SIGTERM and SIGHUP. Work in progress is then finished, and no new work begins.
inline std::atomic<bool> stop_requested{false};

}  // namespace liecheck::properties

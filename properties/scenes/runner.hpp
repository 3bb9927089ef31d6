#pragma once
// The interface to run one benchmark with one method and any number of steps. liecheck in double and float128
// and other simulators (peers/) implement it.

#include <atomic>
#include <functional>
#include <memory>
#include <scenes/benchmark.hpp>
#include <stdexcept>

namespace liecheck::properties {

/// The number of steps over the whole duration, and a tolerance for a method that chooses its own steps.
struct Effort {
  long steps = 0;
  double tolerance = 0;
};

/// Thrown by a run that cannot finish; what() says when and why.
class Diverged : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Thrown by a run that was asked to stop.
class Stopped : public std::runtime_error {
 public:
  Stopped() : std::runtime_error("stopped") {}
};

class Runner {
 public:
  virtual ~Runner() = default;
  /// If it is set to true, a run throws Stopped within a few steps. May be null. (A peer is a library of its
  /// own, which has its own copy of every global variable.)
  const std::atomic<bool>* stop = nullptr;
  /// Runs from start to end. Calls watch(t, moment) at the start and after each of `samples` equal parts of
  /// the duration. Each part has a whole number of steps. Returns the number of steps made. Throws Diverged
  /// and Stopped.
  virtual long run(const Effort& effort, long samples,
                   const std::function<void(double t, const Moment& moment)>& watch) = 0;
  /// Makes the same run without samples, for timing.
  virtual void pass(const Effort& effort) = 0;

 protected:
  bool stopped() const { return stop && *stop; }
};

}  // namespace liecheck::properties

#pragma once
// Runs one benchmark with one method, as often and as finely as asked: ours in double and in float128, and other
// people's simulators (peers/).

#include <functional>
#include <memory>
#include <scenes/benchmark.hpp>
#include <stdexcept>

namespace liecheck::properties {

/// How much effort: steps over the whole duration, or for a method that chooses its own steps a tolerance.
struct Effort {
  long steps = 0;
  double tolerance = 0;
};

/// What a run could not finish: what() says when and why.
class Diverged : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Runner {
 public:
  virtual ~Runner() = default;
  /// From the start to the end; watch(t, moment) at the start and after each of `samples` equal parts of the duration,
  /// in which whole numbers of steps must lie. Returns how many steps were made. Throws Diverged.
  virtual long run(const Effort& effort, long samples,
                   const std::function<void(double t, const Moment& moment)>& watch) = 0;
  /// The same unwatched, for its time.
  virtual void pass(const Effort& effort) = 0;
};

/// Ours, scalar "double" or "float128". A tolerance of 0 lets an adaptive method accept every step that it is given.
/// Throws std::invalid_argument where the method does not run this scene.
std::unique_ptr<Runner> make_runner(const Benchmark& scene, const std::string& method,
                                    const std::string& scalar);

}  // namespace liecheck::properties

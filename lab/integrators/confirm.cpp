#include <chrono>
#include <integrators/confirm.hpp>
#include <integrators/independent.hpp>
#include <scenes/runner.hpp>
#include <thread>

namespace liecheck::properties {
namespace {

/// Sets `late` after a minute, or when the run is to stop.
class Limit {
 public:
  explicit Limit(const std::atomic<bool>* stop)
      : watch_([this, stop](const std::stop_token& done) {
          const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
          while (!done.stop_requested() && !(stop && *stop) && std::chrono::steady_clock::now() < end)
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
          late = true;
        }) {}
  std::atomic<bool> late = false;

 private:
  std::jthread watch_;
};

}  // namespace

Confirmation confirmation_of(const Benchmark& s, const std::vector<Moment>& moments,
                             const std::atomic<bool>* stop, long double tolerance) {
  Confirmation c{"", MotionError::none(), {}};
  Limit limit(stop);
  try {
    c.at = moments_of<long double>(independent_tree<long double>(s), s, long(moments.size()) - 1, tolerance,
                                   &limit.late);
    for (std::size_t k = 0; k < c.at.size(); ++k)
      c.apart.take_larger(motion_error(s.robot, c.at[k], moments[k]));
  } catch (const std::logic_error& e) {  // std::invalid_argument, std::domain_error
    c.unconfirmed = e.what();
  } catch (const std::runtime_error&) {
    if (stop && *stop) throw Stopped();
    c.unconfirmed = "maximal coordinates take longer than a minute";
  }
  return c;
}

}  // namespace liecheck::properties

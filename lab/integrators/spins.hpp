#pragma once
// Long runs of a triaxial torque-free body: a thousand turns, and the flips of Dzhanibekov's body.

#include <atomic>
#include <cstddef>
#include <string>
#include <vector>

namespace liecheck::properties {

/// Moments 1, 2, 3 kg m^2, omega0 = (1, 2, -1) rad/s. The run takes `turns` times 2 pi / |omega0|.
struct LongSpin {
  std::string integrator;
  int order = 0;
  long turns = 0, steps_per_turn = 0;
  double error = 0;    ///< largest attitude error at the ends of four quarters [rad]
  double limit = 0;    ///< turns * 2 pi eps: the effect of a relative error of eps in omega [rad]
  double seconds = 0;  ///< time taken
};
/// Once `stop` is set, returns the runs that were done.
std::vector<LongSpin> long_spins(long turns = 1000, const std::atomic<bool>* stop = nullptr);

/// The same body with omega0 = (delta, 1, delta) rad/s. At a flip, omega_2 changes its sign.
struct Flips {
  double perturbation = 0;
  std::string scalar, integrator;
  std::vector<double> exact;     ///< times of the flips from the closed form [s]
  std::vector<double> relative;  ///< relative error of each time; inf if the flip was not found
  /// The number of flips, from the first on, that are right to 1e-6, and the time of the last of them [s].
  std::size_t predicted = 0;
  double horizon = 0;
};
/// Runs delta = 1e-2 ... 1e-12 in double. If double misses flips, also runs this delta in float128, except
/// for 1e-9, 1e-10 and 1e-11. Once `stop` is set, returns the runs that were done.
std::vector<Flips> dzhanibekov_flips(std::size_t flips = 6, const std::atomic<bool>* stop = nullptr);

}  // namespace liecheck::properties

#pragma once
// Two long runs of a triaxial torque-free body against its closed form: a thousand turns, and Dzhanibekov's flips.

#include <atomic>
#include <cstddef>
#include <string>
#include <vector>

namespace liecheck::properties {

/// Moments 1, 2, 3 kg m^2, omega0 = (1, 2, -1) rad/s, `turns` times 2 pi / |omega0|.
struct LongSpin {
  std::string integrator;
  int order = 0;
  long turns = 0, steps_per_turn = 0;
  double error = 0;    ///< of the attitude, the largest at four quarters [rad]
  double limit = 0;    ///< turns 2 pi eps: what a last-digit error of omega becomes [rad]
  double seconds = 0;  ///< it took
};
std::vector<LongSpin> long_spins(long turns = 1000);

/// omega0 = (delta, 1, delta) rad/s about the middle axis. A flip: omega_2 passes 0.
struct Flips {
  double perturbation = 0;
  std::string scalar, integrator;
  std::vector<double> exact;     ///< [s], from the closed form
  std::vector<double> relative;  ///< error of each time that was found, over that time; inf: it was not found
  /// How many in a row are right to 1e-6, and the time of the last of those [s]: the horizon of prediction.
  std::size_t predicted = 0;
  double horizon = 0;
};
/// delta = 1e-2 ... 1e-12 in double, 1e-8 and 1e-12 in float128 too.
std::vector<Flips> dzhanibekov_flips(std::size_t flips = 6, std::atomic<bool>* stop = nullptr);

}  // namespace liecheck::properties

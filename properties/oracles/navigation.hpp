#pragma once
// Preintegrated inertial measurements at 100 digits, and their derivatives by the biases.
//
// With G_m = sum_k [phi]^k m! / (k + m)! at phi = omega dt, a measurement gives, in body axes, the rotation G_0, the velocity
// G_1 a dt and the position G_2 a dt^2 / 2 (Brossard et al. 2022), or a dt and a dt^2 / 2 (Forster et al. 2017). They are
// power series in |phi|^2; no angle, sine or quaternion occurs. Derivatives follow from the derivatives of the terms.
//
// G_1 = I + [phi] G_2 / 2 and G_0 = I + [phi] G_1 follow from the two series of G_2, so that the rotation depends on both.
// Confirmed by the rotation of half angles (closed_forms.hpp), and a central difference along one direction of the biases.

#include <array>
#include <oracles/spatial.hpp>

namespace liecheck::oracles {

struct Preintegrated {
  Mat3<> R;
  Vec3<> p, v;
  Mat3<> R_g, p_g, p_a, v_g, v_a;  ///< derivatives by the biases; R_g is on the right
  bool resolved = false;
};
using Samples = std::array<Vec3<>, 3>;
/// `exact`: as Brossard et al. define it.
Preintegrated preintegrated(const Samples& gyro, const Samples& accelerometer, const Real& dt, bool exact);

}  // namespace liecheck::oracles

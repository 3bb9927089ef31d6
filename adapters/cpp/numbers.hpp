#pragma once
// What the adapters in C++ share.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string_view>

template <class S, std::size_t n>
using In = std::span<const S, n>;
template <class S, std::size_t n>
using Out = std::span<S, n>;

/// The angle and the unit axis of phi, for a function that makes a rotation of them. phi = 0 is the angle 0 about any
/// axis.
template <class S>
S angle_of(In<S, 3> phi) {
  return std::hypot(phi[0], phi[1], phi[2]);
}
template <class S>
std::array<S, 3> axis_of(In<S, 3> phi) {
  const S largest = std::max({std::abs(phi[0]), std::abs(phi[1]), std::abs(phi[2])});
  if (largest == 0) return {1, 0, 0};
  const std::array<S, 3> n{phi[0] / largest, phi[1] / largest, phi[2] / largest};
  const S length = std::hypot(n[0], n[1], n[2]);
  return {n[0] / length, n[1] / length, n[2] / length};
}

/// Q or -Q, the same rotation, with w >= 0: for a logarithm that tells them apart.
template <class S>
std::array<S, 4> nearer_to_one(In<S, 4> Q) {
  if (Q[3] < 0) return {-Q[0], -Q[1], -Q[2], -Q[3]};
  return {Q[0], Q[1], Q[2], Q[3]};
}

/// Roll, pitch and yaw of the order and the angles a, b, c: those of R = R_z(yaw) R_y(pitch) R_x(roll). Order 0, X Y Z with
/// static axes, and order 11, Z Y X with rotating axes, mean them; any other order is refused.
template <class S>
std::array<S, 3> roll_pitch_yaw(In<S, 4> x) {
  if (x[0] == 0) return {x[1], x[2], x[3]};
  if (x[0] == 11) return {x[3], x[2], x[1]};
  throw std::invalid_argument("the library has only roll, pitch, yaw: orders 0 and 11");
}
/// The same angle in [-pi, pi], for a library that documents no range.
template <class S>
S in_range(S angle) {
  return std::remainder(angle, S(2 * M_PI));
}
template <class S>
void put_roll_pitch_yaw(S order, S roll, S pitch, S yaw, Out<S, 3> angles) {
  roll_pitch_yaw<S>(std::array<S, 4>{order, 0, 0, 0});  // refuses other orders
  angles[0] = order == 0 ? roll : yaw, angles[1] = pitch, angles[2] = order == 0 ? yaw : roll;
}

/// A program of source() and its operation.
struct Program {
  std::string_view operation;
  const char* text;
};
/// The one of the operation, or null.
template <std::size_t n>
const char* program_for(const Program (&all)[n], std::string_view operation) {
  const Program* const at =
      std::find_if(all, all + n, [&](const Program& p) { return p.operation == operation; });
  return at == std::end(all) ? nullptr : at->text;
}

/// A program in C++ for source(): one header, statements, and the numbers that it prints. A place {phi} stands for
/// the numbers of that argument, {scalar} for float or double.
#define PROGRAM(header, statements, result)                             \
  "#include <" header ">\n#include <cstdio>\nint main() {\n" statements \
  "\nfor (const double all[] = {" result "}; double x : all) std::printf(\"%.17g \", x);\n}"

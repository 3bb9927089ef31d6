#pragma once
// What the adapters in C++ share.

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string_view>

template <class S, std::size_t n>
using In = std::span<const S, n>;
template <class S, std::size_t n>
using Out = std::span<S, n>;

/// An axis for a function that makes a rotation of an axis and an angle. phi = 0 is the angle 0 about any
/// axis.
template <class S>
std::array<S, 3> axis_of(In<S, 3> phi) {
  if (phi[0] == 0 && phi[1] == 0 && phi[2] == 0) return {1, 0, 0};
  return {phi[0], phi[1], phi[2]};
}

/// Q or -Q, the same rotation, with w >= 0: for a logarithm that tells them apart.
template <class S>
std::array<S, 4> nearer_to_one(In<S, 4> Q) {
  if (Q[3] < 0) return {-Q[0], -Q[1], -Q[2], -Q[3]};
  return {Q[0], Q[1], Q[2], Q[3]};
}

/// A program of source() and its operation.
struct Program {
  std::string_view operation;
  const char* text;
};
/// The one of the operation, or null.
template <std::size_t n>
const char* program_for(const Program (&all)[n], std::string_view operation) {
  const Program* const at = std::ranges::find(all, operation, &Program::operation);
  return at == std::end(all) ? nullptr : at->text;
}

/// A program in C++ for source(): one header, statements, and the numbers that it prints. A place {phi} stands for
/// the numbers of that argument, {scalar} for float or double.
#define PROGRAM(header, statements, result)                             \
  "#include <" header ">\n#include <cstdio>\nint main() {\n" statements \
  "\nfor (const double all[] = {" result "}; double x : all) std::printf(\"%.17g \", x);\n}"

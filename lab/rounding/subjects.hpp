#pragma once
// Subjects whose templates are compiled for Stochastic. Each is in a file of its own, compiled with line numbers.

#include <rounding/stochastic.hpp>
#include <subjects/typed.hpp>
#include <vector>

namespace liecheck::properties {

TypedSubject<Stochastic> stochastic_liecheck();
/// With the cutoff 1e-8, and with 1e-3, whose truncation errors no rounding shows.
std::vector<TypedSubject<Stochastic>> stochastic_textbooks();

/// liecheck's algorithms on the built-in quadruped. Their argument is [q, v, a] or, for aba, [q, v, tau].
struct RobotFunction {
  const Operation* operation;
  std::function<std::vector<double>(const std::vector<double>&)> exact, in_double, at_random;
};
std::vector<RobotFunction> quadruped_functions();
/// Random states: positions up to 1 m, any attitude and joint angle, v and a up to 1.
std::vector<std::vector<double>> quadruped_states(std::size_t n, std::uint64_t seed);

}  // namespace liecheck::properties

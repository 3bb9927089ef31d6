#pragma once
// Linear stability of a method at a state: the eigenvalues of one step, and those of the equations of motion.
//
//   y = (delta, v),  y_dot = J y + ...,  one step: y1 = M y0 + ...
//   unstable if the spectral radius of M exceeds 1 and exp(h max Re eig J), each by more than 5 %
//
// J and M are central differences with increments of 1e-7 [m, rad, m/s, rad/s]. A motion that is unstable
// itself, such as a pendulum upside down, does not make a method unstable. (Hairer & Wanner 1996, IV.2.)

#include <liecheck/scene/setup.hpp>

namespace liecheck::scene {

struct Stability {
  double growth = 0;    ///< spectral radius of M; infinite if the step fails
  double natural = 1;   ///< exp(h max Re eig J), or 1 if that is larger
  double stiffest = 0;  ///< max |eig J| [1/s]
  bool stable() const { return growth <= 1.05 * natural; }
};

/// The largest nv that is analysed, so that it takes less than a second.
constexpr int largest_analysed = 60;

template <class Sys>
Stability stabilityOf(Setup<Sys>&, const State<Sys>&, double h);
/// The effect without which the fastest mode is slowest: its name; none if no effect makes a mode faster.
template <class Sys>
std::string stiffestEffect(const Setup<Sys>&, const State<Sys>&);

extern template Stability stabilityOf(Setup<LoneBody<double>>&, const State<LoneBody<double>>&, double);
extern template Stability stabilityOf(Setup<ThrownBody<double>>&, const State<ThrownBody<double>>&, double);
extern template Stability stabilityOf(Setup<LoneJoint<double>>&, const State<LoneJoint<double>>&, double);
extern template Stability stabilityOf(Setup<Tree<double>>&, const State<Tree<double>>&, double);
extern template std::string stiffestEffect(const Setup<LoneBody<double>>&, const State<LoneBody<double>>&);
extern template std::string stiffestEffect(const Setup<ThrownBody<double>>&, const State<ThrownBody<double>>&);
extern template std::string stiffestEffect(const Setup<LoneJoint<double>>&, const State<LoneJoint<double>>&);
extern template std::string stiffestEffect(const Setup<Tree<double>>&, const State<Tree<double>>&);

}  // namespace liecheck::scene

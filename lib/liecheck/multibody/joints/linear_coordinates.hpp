#pragma once
// N coordinates in which integrate is a plain sum, such as a revolute angle [rad] or a prismatic position
// [m]. Base class of Universe, Revolute, Prismatic, Helical, Translation and Mimic.

#include <algorithm>
#include <liecheck/multibody/argument_position.hpp>
#include <liecheck/spatial/types.hpp>
#include <string>

namespace liecheck {

template <class S>
using Vector1 = Eigen::Matrix<S, 1, 1>;

template <Scalar S, int N>
struct LinearCoordinates {
  static constexpr int nq = N, nv = N, unit_begin = N, columns = N;
  using Configuration = Eigen::Matrix<S, N, 1>;
  using Tangent = Eigen::Matrix<S, N, 1>;
  using Jacobian = Eigen::Matrix<S, N, N>;
  using CoefficientJacobian = Eigen::Matrix<S, N, N>;
  using Subspace = Eigen::Matrix<S, 6, N>;

  static Configuration neutral() { return Configuration::Zero(); }
  static Configuration normalized(const Configuration& q) { return q; }
  static S normDefect(const Configuration&) { return S(0); }

  /// integrate is q + delta, difference is q1 - q0. Error 1/2 eps each.
  static Configuration integrate(const Configuration& q, const Tangent& delta) { return q + delta; }
  static Tangent difference(const Configuration& q0, const Configuration& q1) { return q1 - q0; }

  /// |q1 - q0| <= budget max(1, |q0|, |q1|): angles that differ by 2 pi are different configurations.
  static bool isSame(const Configuration& q0, const Configuration& q1, const S& budget) {
    for (int i = 0; i < N; ++i) {
      const S scale = std::max({S(1), absolute<S>(q0[i]), absolute<S>(q1[i])}),
              apart = absolute<S>(S(q1[i] - q0[i]));
      if (!finite<S>(apart) || !(apart <= budget * scale)) return false;
    }
    return true;
  }

  static Jacobian dIntegrate(const Configuration&, const Tangent&, ArgumentPosition) {
    return Jacobian::Identity();
  }
  static Jacobian dDifference(const Configuration&, const Configuration&, ArgumentPosition argument) {
    return argument == ArgumentPosition::ARG0 ? Jacobian(-Jacobian::Identity())
                                              : Jacobian(Jacobian::Identity());
  }
  static CoefficientJacobian integrateCoeffWiseJacobian(const Configuration&) {
    return CoefficientJacobian::Identity();
  }
};

}  // namespace liecheck

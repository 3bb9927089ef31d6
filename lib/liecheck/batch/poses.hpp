#pragma once
// Operations on many poses at once, by SIMD instructions. A batch is a structure of arrays: each column is
// one pose, and each row holds one number of all poses.
//
// Every function has a counterpart for one pose, whose error bounds hold for each column. The counterpart
// itself computes the columns that need a branch of it: |phi| > pi, or within 1e-3 of pi for logarithms,
// relative rotations below eps, numbers near overflow, and quaternions off unit. It throws for the same
// input.
//
// `result` may be moved in, to use its memory again:  q = integrate(q0, delta, {}, std::move(q)).

#include <Eigen/Core>
#include <algorithm>
#include <concepts>
#include <initializer_list>
#include <liecheck/batch/instructions.hpp>
#include <stdexcept>

namespace liecheck::batch {

/// ROWS numbers of each of m columns [ROWS x m].
template <class S, int ROWS>
using Rows = Eigen::Array<S, ROWS, Eigen::Dynamic, Eigen::RowMajor>;

namespace detail {

enum class Operation {
  exp6,
  log6,
  integrate,
  difference,
  act,
  exp6Matrix,
  compose,
  actMatrix,
  Jexp6,
  rightJacobianInverse,
  Jlog6
};

/// Row r of an argument, and of the result, begins r * columns numbers after the first. S is float or double.
template <std::floating_point S>
void run(Operation operation, std::initializer_list<const S*> arguments, S* result, Eigen::Index columns,
         const Options& options);

template <Operation operation, class S, int ROWS, class... Arguments>
Rows<S, ROWS> of(const Options& options, Rows<S, ROWS>& result, const Arguments&... arguments) {
  const Eigen::Index columns = std::min({arguments.cols()...});
  if (columns != std::max({arguments.cols()...}))
    throw std::invalid_argument("the arguments of a batch have different numbers of columns");
  result.resize(Eigen::NoChange, columns);
  run<S>(operation, {arguments.data()...}, result.data(), columns, options);
  return std::move(result);
}

}  // namespace detail

/// quaternion::exp6 of each column: xi [6 x m; m, rad]. Result [p; x y z w] [7 x m; m].
template <std::floating_point S>
Rows<S, 7> exp6(const Rows<S, 6>& xi, const Options& options = {}, Rows<S, 7> result = {}) {
  return detail::of<detail::Operation::exp6>(options, result, xi);
}

/// quaternion::log6 of each column: q [7 x m; m]. Result [6 x m; m, rad].
template <std::floating_point S>
Rows<S, 6> log6(const Rows<S, 7>& q, const Options& options = {}, Rows<S, 6> result = {}) {
  return detail::of<detail::Operation::log6>(options, result, q);
}

/// integrateSE3 of each column: q [7 x m; m], delta [6 x m; m, rad]. Result [7 x m].
template <std::floating_point S>
Rows<S, 7> integrate(const Rows<S, 7>& q, const Rows<S, 6>& delta, const Options& options = {},
                     Rows<S, 7> result = {}) {
  return detail::of<detail::Operation::integrate>(options, result, q, delta);
}

/// differenceSE3 of each column: q0, q1 [7 x m; m]. Result [6 x m; m, rad].
template <std::floating_point S>
Rows<S, 6> difference(const Rows<S, 7>& q0, const Rows<S, 7>& q1, const Options& options = {},
                      Rows<S, 6> result = {}) {
  return detail::of<detail::Operation::difference>(options, result, q0, q1);
}

/// R(Q) x + p of each column: q = [p; x y z w] [7 x m; m], x [3 x m; m]. Result [3 x m; m].
template <std::floating_point S>
Rows<S, 3> act(const Rows<S, 7>& q, const Rows<S, 3>& x, const Options& options = {},
               Rows<S, 3> result = {}) {
  return detail::of<detail::Operation::act>(options, result, q, x);
}

// Poses by matrices have twelve rows: the entries of R row by row, and p [m].

/// exp6 of each column: xi [6 x m; m, rad]. Result [12 x m].
template <std::floating_point S>
Rows<S, 12> exp6Matrix(const Rows<S, 6>& xi, const Options& options = {}, Rows<S, 12> result = {}) {
  return detail::of<detail::Operation::exp6Matrix>(options, result, xi);
}

/// X Y of each column [12 x m]. Result [12 x m].
template <std::floating_point S>
Rows<S, 12> compose(const Rows<S, 12>& X, const Rows<S, 12>& Y, const Options& options = {},
                    Rows<S, 12> result = {}) {
  return detail::of<detail::Operation::compose>(options, result, X, Y);
}

/// R x + p of each column: X [12 x m], x [3 x m; m]. Result [3 x m; m].
template <std::floating_point S>
Rows<S, 3> act(const Rows<S, 12>& X, const Rows<S, 3>& x, const Options& options = {},
               Rows<S, 3> result = {}) {
  return detail::of<detail::Operation::actMatrix>(options, result, X, x);
}

// Jacobians have 36 rows: their entries [6 x 6] row by row.

/// Jexp6 of each column, J_r(xi): xi [6 x m; m, rad]. Result [36 x m].
template <std::floating_point S>
Rows<S, 36> Jexp6(const Rows<S, 6>& xi, const Options& options = {}, Rows<S, 36> result = {}) {
  return detail::of<detail::Operation::Jexp6>(options, result, xi);
}

/// rightJacobianInverse of each column, J_r^-1(xi): xi [6 x m; m, rad]. Result [36 x m].
template <std::floating_point S>
Rows<S, 36> rightJacobianInverse(const Rows<S, 6>& xi, const Options& options = {}, Rows<S, 36> result = {}) {
  return detail::of<detail::Operation::rightJacobianInverse>(options, result, xi);
}

/// J_r^-1 at the logarithm of each column: q [7 x m; m]. Result [36 x m].
template <std::floating_point S>
Rows<S, 36> Jlog6(const Rows<S, 7>& q, const Options& options = {}, Rows<S, 36> result = {}) {
  return detail::of<detail::Operation::Jlog6>(options, result, q);
}

}  // namespace liecheck::batch

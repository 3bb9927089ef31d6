#pragma once
// Newton's method for the stage equations of an implicit Runge-Kutta method, in double.
//
//   Y_i = h sum_j a_ij f_i,  f_i = f(t + c_i h, Y_i),  Y_i = (delta_i, v_i - v0)
//   (1 - h A (x) J) dY = -R,  R_i = Y_i - h sum_j a_ij f_j,  J_j = df/dy at Y_j by forward differences
//
// Errors of J slow the iteration and do not change its result, so that J is formed anew only where an iteration
// does not divide the residual by 10, or where h has changed. The length of a correction is halved until the
// residual decreases (Armijo; Nocedal & Wright 2006, sec. 11.2). The iteration ends when rounding errors
// prevent a decrease; the last correction must then be below 1e-9 (|v| + h |a| + h 1 m/s^2), in which h bounds
// the scale from below: a body that comes to rest has no scale of its own.

#include <Eigen/LU>
#include <functional>
#include <liecheck/spatial/types.hpp>
#include <optional>
#include <vector>

namespace liecheck::scene {

class StageNewton {
 public:
  using Vector = VectorX<double>;
  using Matrix = Eigen::MatrixXd;
  /// Sets f(t + c_i h, y) [2 nv] for the stage i and y = (delta, v - v0) [2 nv].
  using Rate = std::function<void(int stage, const Vector& y, Vector& f)>;

  /// Replaces Y [2 nv, s], a first guess, by the solution, and sets F [2 nv, s] to its rates. Returns the number
  /// of iterations, or none if they did not converge. `speed` is max |v0|.
  std::optional<long> solve(const std::vector<std::vector<double>>& a, double h, double speed,
                            const Rate& rate, Matrix& Y, Matrix& F);

 private:
  double residual(const std::vector<std::vector<double>>& a, double h, const Rate& rate, const Matrix& Y,
                  Matrix& F);
  /// Sets lu_ to the factors of 1 - h A (x) J at Y. False if J is not finite.
  bool factorise(const std::vector<std::vector<double>>& a, double h, const Rate& rate, const Matrix& Y,
                 const Matrix& F);
  double size(const Matrix& Y, double h) const;

  Matrix R_, trial_, F_trial_, J_, M_;
  Vector y_, f_, step_;
  Eigen::PartialPivLU<Matrix> lu_;
  double h_ = 0;        ///< of the factors in lu_, or 0
  bool fresh_ = false;  ///< true if they are of this Y
};

}  // namespace liecheck::scene

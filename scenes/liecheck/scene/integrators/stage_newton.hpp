#pragma once
// Newton's method for the stage equations of an implicit Runge-Kutta method, in double.
//
//   Y_i = h sum_j a_ij f_i,  f_i = f(t + c_i h, Y_i),  Y_i = (delta_i, v_i - v0)
//   (1 - h A (x) J) dY = -R,  R_i = Y_i - h sum_j a_ij f_j,  J = df/dy by forward differences
//
// Errors of J slow the iteration and do not change its result. So J is that of the start of an earlier step as long as
// an iteration divides the residual by 10; otherwise that of the start of this step; and if that is too slow, too, each
// stage has its own, at Y_j. (Hairer & Wanner 1996, IV.8.) The length of a correction is halved until the residual
// decreases (Armijo; Nocedal & Wright 2006, sec. 11.2). The iteration ends when rounding errors prevent a decrease;
// the last correction must then be below 1e-9 (|v| + h |a| + h 1 m/s^2), in which h bounds the scale from below: a
// body that comes to rest has no scale of its own.

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
  /// Sets f(t + c_i h, y) [2 nv] for the stage i and y = (delta, v - v0) [2 nv]; for i = start, f(t, y).
  using Rate = std::function<void(int stage, const Vector& y, Vector& f)>;

  static constexpr int start = -1;

  /// Replaces Y [2 nv, s], a first guess, by the solution, and sets F [2 nv, s] to its rates. Returns the number
  /// of iterations, or none if they did not converge. `speed` is max |v0|.
  std::optional<long> solve(const std::vector<std::vector<double>>& a, double h, double speed,
                            const Rate& rate, Matrix& Y, Matrix& F);
  /// Forgets the J of earlier steps, so that a run has the same bits after any other.
  void forget() { known_ = false, h_ = 0; }
  /// J at the start of a recent step, or null.
  const Matrix* jacobian() const { return known_ ? &J_ : nullptr; }

 private:
  double residual(const std::vector<std::vector<double>>& a, double h, const Rate& rate, const Matrix& Y,
                  Matrix& F);
  /// Sets J_ to df/dy at y, of which f is the rate. False if it is not finite.
  bool differentiate(const Rate& rate, int stage, const Vector& y, const Vector& f);
  /// Sets lu_ to the factors of 1 - h A (x) J, with the J of source_. False if J is not finite.
  bool factorise(const std::vector<std::vector<double>>& a, double h, const Rate& rate, const Matrix& Y,
                 const Matrix& F);
  double size(const Matrix& Y, double h) const;

  /// Where J is formed.
  enum class Source { Earlier, Start, Stages };

  Matrix R_, trial_, F_trial_, J_, M_;
  Vector y_, y_c_, f_, f_c_, step_;
  Eigen::PartialPivLU<Matrix> lu_;
  double h_ = 0;  ///< of the factors in lu_, or 0
  Source source_ = Source::Start;
  bool known_ = false;  ///< true if J_ is that of the start of a step
};

}  // namespace liecheck::scene

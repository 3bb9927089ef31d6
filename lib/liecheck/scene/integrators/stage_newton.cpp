#include <cmath>
#include <liecheck/scene/integrators/stage_newton.hpp>
#include <limits>

namespace liecheck::scene {

/// The Euclidean norm of Y as velocities: increments count divided by h. Newton's correction decreases that of R_.
double StageNewton::size(const Matrix& Y, double h) const {
  const Eigen::Index n = Y.rows() / 2;
  if (!Y.allFinite()) return std::numeric_limits<double>::infinity();
  return std::hypot(Y.topRows(n).stableNorm() / h, Y.bottomRows(n).stableNorm());
}

/// Sets F and R_, and returns the size of R_.
double StageNewton::residual(const std::vector<std::vector<double>>& a, double h, const Rate& rate,
                             const Matrix& Y, Matrix& F) {
  for (Eigen::Index i = 0; i < Y.cols(); ++i) {
    y_ = Y.col(i);
    rate(int(i), y_, f_);
    F.col(i) = f_;
  }
  R_ = Y;
  for (Eigen::Index i = 0; i < Y.cols(); ++i)
    for (Eigen::Index j = 0; j < Y.cols(); ++j) R_.col(i) -= h * a[std::size_t(i)][std::size_t(j)] * F.col(j);
  return size(R_, h);
}

std::optional<long> StageNewton::solve(const std::vector<std::vector<double>>& a, double h, double speed,
                                       const Rate& rate, Matrix& Y, Matrix& F) {
  constexpr long limit = 100;
  constexpr double increment = 1e-8, eps = std::numeric_limits<double>::epsilon();
  const Eigen::Index n = Y.rows(), s = Y.cols(), all = n * s;
  F.resize(n, s), F_trial_.resize(n, s), J_.resize(n, n), M_.resize(all, all), f_.resize(n);
  double merit = residual(a, h, rate, Y, F);
  for (long k = 0; k < limit && std::isfinite(merit); ++k) {
    const double scale = speed + std::abs(h) * (F.bottomRows(n / 2).cwiseAbs().maxCoeff() + 1);
    if (merit <= eps * scale) return k;
    M_.setIdentity();
    for (Eigen::Index j = 0; j < s; ++j) {
      for (Eigen::Index c = 0; c < n; ++c) {
        y_ = Y.col(j);
        y_[c] += increment;
        rate(int(j), y_, f_);
        J_.col(c) = (f_ - F.col(j)) / increment;
      }
      for (Eigen::Index i = 0; i < s; ++i)
        M_.block(i * n, j * n, n, n) -= h * a[std::size_t(i)][std::size_t(j)] * J_;
    }
    if (!M_.allFinite()) return {};
    lu_.compute(M_);
    step_ = lu_.solve(Eigen::Map<const Vector>(R_.data(), all));
    const Eigen::Map<const Matrix> step(step_.data(), n, s);
    const double length = size(step, h);
    if (!std::isfinite(length)) return {};
    double share = 1, found = 0;
    for (; share > 1e-6; share /= 2) {
      trial_ = Y - share * step;
      found = residual(a, h, rate, trial_, F_trial_);
      if (found <= (1 - 0.1 * share) * merit) break;
    }
    if (!(share > 1e-6)) {
      residual(a, h, rate, Y, F);
      return length <= 1e-9 * scale ? std::optional(k + 1) : std::nullopt;
    }
    Y = trial_, F = F_trial_, merit = found;
  }
  return {};
}

}  // namespace liecheck::scene

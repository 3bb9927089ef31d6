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

bool StageNewton::factorise(const std::vector<std::vector<double>>& a, double h, const Rate& rate,
                            const Matrix& Y, const Matrix& F) {
  constexpr double increment = 1e-8;
  const Eigen::Index n = Y.rows(), s = Y.cols();
  h_ = 0;
  J_.resize(n, n);
  M_.setIdentity(n * s, n * s);
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
  if (!M_.allFinite()) return false;
  lu_.compute(M_);
  h_ = h, fresh_ = true;
  return true;
}

std::optional<long> StageNewton::solve(const std::vector<std::vector<double>>& a, double h, double speed,
                                       const Rate& rate, Matrix& Y, Matrix& F) {
  constexpr long limit = 100;
  constexpr double eps = std::numeric_limits<double>::epsilon();
  const Eigen::Index n = Y.rows(), s = Y.cols();
  F.resize(n, s), F_trial_.resize(n, s), f_.resize(n);
  fresh_ = false;
  double merit = residual(a, h, rate, Y, F);
  for (long k = 0; k < limit && std::isfinite(merit); ++k) {
    const double scale = speed + std::abs(h) * (F.bottomRows(n / 2).cwiseAbs().maxCoeff() + 1);
    if (merit <= eps * scale) return k;
    if ((h != h_ || lu_.rows() != n * s) && !factorise(a, h, rate, Y, F)) return {};
    step_ = lu_.solve(Eigen::Map<const Vector>(R_.data(), n * s));
    const Eigen::Map<const Matrix> step(step_.data(), n, s);
    const double length = size(step, h);
    double share = std::isfinite(length) ? 1 : 0, found = 0;
    for (; share > (fresh_ ? 1e-6 : 0.5); share /= 2) {
      trial_ = Y - share * step;
      found = residual(a, h, rate, trial_, F_trial_);
      if (found <= (1 - 0.1 * share) * merit) break;
    }
    if (!(share > (fresh_ ? 1e-6 : 0.5))) {
      residual(a, h, rate, Y, F);
      if (!fresh_) {
        h_ = 0;
        continue;
      }
      h_ = 0;
      return length <= 1e-9 * scale ? std::optional(k + 1) : std::nullopt;
    }
    fresh_ = false;
    if (!(found <= 0.1 * merit)) h_ = 0;
    Y = trial_, F = F_trial_, merit = found;
  }
  return {};
}

}  // namespace liecheck::scene

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

bool StageNewton::differentiate(const Rate& rate, int stage, const Vector& y, const Vector& f) {
  constexpr double increment = 1e-8;
  J_.resize(y.size(), y.size());
  for (Eigen::Index c = 0; c < y.size(); ++c) {
    y_c_ = y;
    y_c_[c] += increment;
    rate(stage, y_c_, f_c_);
    J_.col(c) = (f_c_ - f) / increment;
  }
  return J_.allFinite();
}

bool StageNewton::factorise(const std::vector<std::vector<double>>& a, double h, const Rate& rate,
                            const Matrix& Y, const Matrix& F) {
  const Eigen::Index n = Y.rows(), s = Y.cols();
  h_ = 0;
  if (source_ == Source::Start) {
    y_ = Vector::Zero(n);
    rate(start, y_, f_);
    known_ = differentiate(rate, start, y_, f_);
    if (!known_) return false;
  }
  M_.setIdentity(n * s, n * s);
  for (Eigen::Index j = 0; j < s; ++j) {
    if (source_ == Source::Stages) {
      known_ = false;
      y_ = Y.col(j), f_ = F.col(j);
      if (!differentiate(rate, int(j), y_, f_)) return false;
    }
    for (Eigen::Index i = 0; i < s; ++i)
      M_.block(i * n, j * n, n, n) -= h * a[std::size_t(i)][std::size_t(j)] * J_;
  }
  lu_.compute(M_);
  h_ = h;
  return true;
}

std::optional<long> StageNewton::solve(const std::vector<std::vector<double>>& a, double h, double speed,
                                       const Rate& rate, Matrix& Y, Matrix& F) {
  constexpr long limit = 100;
  constexpr double eps = std::numeric_limits<double>::epsilon();
  const Eigen::Index n = Y.rows(), s = Y.cols();
  F.resize(n, s), F_trial_.resize(n, s), f_.resize(n), f_c_.resize(n);
  const bool earlier = known_ && J_.rows() == n;
  source_ = earlier ? Source::Earlier : Source::Start;
  if (!earlier || h != h_ || lu_.rows() != n * s) h_ = 0;
  double merit = residual(a, h, rate, Y, F);
  // The next better J, if there is one.
  const auto improve = [&] {
    if (source_ == Source::Stages) return false;
    source_ = source_ == Source::Earlier ? Source::Start : Source::Stages, h_ = 0;
    return true;
  };
  bool fresh = false;       // the stages' own J are those of Y
  bool contracted = false;  // the last correction divided the residual by 10
  for (long k = 0; k < limit && std::isfinite(merit); ++k) {
    const double scale = speed + std::abs(h) * (F.bottomRows(n / 2).cwiseAbs().maxCoeff() + 1);
    if (merit <= eps * scale) return k;
    if (h_ == 0) {
      if (!factorise(a, h, rate, Y, F)) return {};
      fresh = true;
    }
    step_ = lu_.solve(Eigen::Map<const Vector>(R_.data(), n * s));
    const Eigen::Map<const Matrix> step(step_.data(), n, s);
    const double length = size(step, h), shortest = source_ == Source::Stages && fresh ? 1e-6 : 0.5;
    double share = std::isfinite(length) ? 1 : 0, found = 0;
    for (; share > shortest; share /= 2) {
      trial_ = Y - share * step;
      found = residual(a, h, rate, trial_, F_trial_);
      if (found <= (1 - 0.1 * share) * merit) break;
    }
    if (!(share > shortest)) {
      residual(a, h, rate, Y, F);
      const bool small = length <= 1e-9 * scale;
      // At the level of rounding errors no J decreases the residual, so that the size of a correction decides, by a J
      // that is of this step or has shown that it is good.
      if (small && (contracted || source_ != Source::Earlier)) return k + 1;
      if (source_ == Source::Stages && !fresh)
        h_ = 0;
      else if (!improve())
        return {};
      continue;
    }
    fresh = false, contracted = found <= 0.1 * merit;
    if (!contracted && !improve()) h_ = 0;
    Y = trial_, F = F_trial_, merit = found;
  }
  return {};
}

}  // namespace liecheck::scene

#pragma once
// Weighted means of rotations and poses. Weights are positive; their sum does not matter.

#include <array>
#include <liecheck/multibody/se3_configuration.hpp>
#include <liecheck/spatial/relative_rotation.hpp>

namespace liecheck {

namespace means_detail {

/// Throws std::invalid_argument unless all weights are positive numbers whose sum is finite.
template <class Weights>
void requirePositive(const Weights& weights) {
  using S = typename Weights::Scalar;
  const S sum = weights.sum();
  bool good = finite<S>(sum);
  for (int i = 0; i < int(weights.size()); ++i) good = good && S(0) < weights[i];
  if (!good) throw std::invalid_argument("the weights of a mean are not all positive and finite");
}

/// The eigenvector of the largest eigenvalue of a symmetric M [4 x 4], by Jacobi's rotations.
template <Scalar S>
Vector4<S> largestEigenvector(Eigen::Matrix<S, 4, 4> M) {
  using std::sqrt;
  Eigen::Matrix<S, 4, 4> V = Eigen::Matrix<S, 4, 4>::Identity();
  for (int sweep = 0; sweep < 60; ++sweep) {
    bool done = true;
    for (int p = 0; p < 4; ++p)
      for (int q = p + 1; q < 4; ++q) {
        if (!(eps<S>() * eps<S>() * absolute<S>(M(p, p)) * absolute<S>(M(q, q)) < M(p, q) * M(p, q)))
          continue;
        done = false;
        const S h = (M(q, q) - M(p, p)) / (S(2) * M(p, q)), root = S(sqrt(S(S(1) + h * h)));
        const S t = h < S(0) ? S(S(1) / (h - root)) : S(S(1) / (h + root)),
                c = S(1) / S(sqrt(S(S(1) + t * t))), s = t * c;
        const auto turn = [&](S& x, S& y) {
          const S old = x;
          x = c * old - s * y, y = s * old + c * y;
        };
        for (int i = 0; i < 4; ++i) turn(M(i, p), M(i, q));
        for (int i = 0; i < 4; ++i) turn(M(p, i), M(q, i));
        for (int i = 0; i < 4; ++i) turn(V(i, p), V(i, q));
      }
    if (done) break;
  }
  int first = 0;
  for (int i = 1; i < 4; ++i)
    if (M(first, first) < M(i, i)) first = i;
  return V.col(first);
}

}  // namespace means_detail

/// The chordal mean: the unit Q that maximises sum_i w_i (Q . Q_i)^2, which minimises sum_i w_i |R - R_i|^2. The signs of
/// the Q_i do not matter. Error 8 eps/g of the rotation, where g is the difference of the two largest eigenvalues of
/// sum_i w_i Q_i Q_i^T over the largest: two clusters of equal weight have no mean. Throws std::invalid_argument if a Q_i is
/// zero or a weight is not positive. Source: Markley et al. 2007, eq. 12.
template <Scalar S, std::size_t N>
SO3<S> chordalMean(const std::array<SO3<S>, N>& all, const Eigen::Matrix<S, int(N), 1>& weights) {
  means_detail::requirePositive(weights);
  // Of the rotations as seen from the first, so that a small spread is known to eps of itself.
  const SO3<S> first = all[0].normalized();
  Eigen::Matrix<S, 4, 4> M = Eigen::Matrix<S, 4, 4>::Zero();
  const S sum = weights.sum();
  for (std::size_t i = 0; i < N; ++i) {
    const Vector4<S> q = (first.inverse() * all[i].normalized()).to_vector();
    const S share = weights[int(i)] / sum;
    for (int k = 0; k < 4; ++k) M.col(k) += share * Vector4<S>(q * q[k]);
  }
  return (first * SO3<S>(means_detail::largestEigenvector<S>(M))).normalized();
}

/// T [7; m] with sum_i w_i log(T^-1 T_i) = 0, of poses whose rotations are within 2 rad of one another: T is moved by the
/// mean of the logarithms until this is of the order of the rounding. Error 16 eps. Throws std::invalid_argument if there is
/// no convergence, as for rotations that are farther apart. Source: Pennec & Arsigny 2013, algorithm 1.
template <Scalar S, std::size_t N>
Vector7<S> meanPose(const std::array<Vector7<S>, N>& all, const Eigen::Matrix<S, int(N), 1>& weights) {
  std::array<SO3<S>, N> rotations;
  S length(0);
  Vector7<S> mean = all[0];
  for (std::size_t i = 0; i < N; ++i) {
    rotations[i] = SO3<S>(Vector4<S>(all[i].template tail<4>()));
    length = std::max(length, all[i].template head<3>().cwiseAbs().maxCoeff());
  }
  mean.template tail<4>() = chordalMean<S, N>(rotations, weights).to_vector();
  S before = std::numeric_limits<S>::infinity();
  for (int step = 0; step < 200; ++step) {
    Vector6<S> delta = Vector6<S>::Zero();
    for (std::size_t i = 0; i < N; ++i)
      delta += S(weights[int(i)] / weights.sum()) * differenceSE3<S>(mean, all[i]);
    const S turn = delta.template tail<3>().cwiseAbs().maxCoeff(),
            move = delta.template head<3>().cwiseAbs().maxCoeff(),
            size = std::max(turn, length > S(0) ? S(move / length) : S(0));
    mean = integrateSE3<S>(mean, delta);
    // Below 16 eps the steps are rounding errors once they stop shrinking.
    if (size == S(0) || (size < S(16) * eps<S>() && !(size < before / S(2)))) return mean;
    before = size;
  }
  throw std::invalid_argument("the poses are too far apart to have a mean");
}

/// The rotation Q with sum_i w_i log(Q* Q_i) = 0, of rotations within 2 rad of one another. Error 16 eps; throws as meanPose.
/// Source: Moakher 2002, eq. 3.16.
template <Scalar S, std::size_t N>
SO3<S> geodesicMean(const std::array<SO3<S>, N>& all, const Eigen::Matrix<S, int(N), 1>& weights) {
  std::array<Vector7<S>, N> poses;
  for (std::size_t i = 0; i < N; ++i) poses[i] << S(0), S(0), S(0), all[i].to_vector();
  return SO3<S>(Vector4<S>(meanPose<S, N>(poses, weights).template tail<4>()));
}

}  // namespace liecheck

#include <Eigen/Eigenvalues>
#include <liecheck/scene/modes.hpp>

namespace liecheck::scene {

std::optional<Modes> modesOf(const Eigen::MatrixXd& D) {
  if (!D.allFinite()) return {};
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(D, false);
  if (solver.info() != Eigen::Success) return {};
  return Modes{solver.eigenvalues().cwiseAbs().maxCoeff(), solver.eigenvalues().real().maxCoeff()};
}

}  // namespace liecheck::scene

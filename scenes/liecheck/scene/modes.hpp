#pragma once
// What the analysis of stability asks of the eigenvalues of a matrix.

#include <Eigen/Core>
#include <optional>

namespace liecheck::scene {

struct Modes {
  double fastest;  ///< max |eig|
  double rising;   ///< max Re eig
};
/// None if a number is not finite or the iteration fails.
std::optional<Modes> modesOf(const Eigen::MatrixXd& D);

}  // namespace liecheck::scene

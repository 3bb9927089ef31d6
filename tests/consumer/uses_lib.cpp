#include <liecheck/batch/poses.hpp>
#include <liecheck/liecheck.hpp>

int main() {
  liecheck::batch::Rows<double, 6> xi(6, 100);
  xi.setConstant(0.5);
  const auto q = liecheck::batch::exp6(xi);
  const auto one = liecheck::quaternion::exp6<double>(liecheck::Motion<double>(
      liecheck::Vector3<double>::Constant(0.5), liecheck::Vector3<double>::Constant(0.5)));
  return (q.col(99).matrix() - one).norm() < 1e-15 ? 0 : 1;
}

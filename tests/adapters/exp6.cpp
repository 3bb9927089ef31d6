// exp6 of the library as an adapter, for `liecheck lab wire`.

#include <liecheck_adapter.hpp>

#include <liecheck/spatial/exp_log.hpp>

struct Exp6 {
  static constexpr const char *name = "exp6", *version = "1";
  static void exp6(std::span<const double, 6> xi, std::span<double, 12> X) {
    const auto T = liecheck::exp6<double>(
        liecheck::Motion<double>(Eigen::Map<const Eigen::Matrix<double, 6, 1>>(xi.data())));
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(X.data()) = T.rotation();
    Eigen::Map<Eigen::Vector3d>(X.data() + 9) = T.translation();
  }
};
LIECHECK_ADAPTER(Exp6, exp6)

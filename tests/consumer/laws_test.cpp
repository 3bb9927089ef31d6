// The laws of liecheck in a test program of mylib. OldLib is another subject of the same program.
#include <liecheck_laws.hpp>

#include "adapter.hpp"

LIECHECK_SUBJECT(MyLib, exp3_quaternion, exp3_matrix, log3_quaternion, left_jacobian6, inverse)
LIECHECK_PROPERTY(MyLib, exp_oracle)
LIECHECK_PROPERTY(MyLib, pose_group)
LIECHECK_TEST(MyLib, log_oracle)
LIECHECK_TEST(MyLib, lagrange)  // of which it offers no operation

namespace old {
struct OldLib {
  static constexpr const char *name = "oldlib", *version = "0.9";
  static void exp3_quaternion(std::span<const double, 3> phi, std::span<double, 4> Q) {
    const double theta = std::hypot(phi[0], phi[1], phi[2]),
                 s = theta > 0 ? std::sin(theta / 2) / theta : 0.5;
    Q[0] = std::cos(theta / 2);  // w x y z
    for (int i = 0; i < 3; ++i) Q[i + 1] = s * phi[i];
  }
  static void inverse(std::span<const double, 12> X, std::span<double, 12> Y) { MyLib::inverse(X, Y); }
  static void inverse(std::span<const float, 12> X, std::span<float, 12> Y) {
    double x[12], y[12];
    for (int i = 0; i < 12; ++i) x[i] = X[i];
    MyLib::inverse(std::span<const double, 12>(x), std::span<double, 12>(y));
    for (int i = 0; i < 12; ++i) Y[i] = static_cast<float>(y[i]);
  }
};
LIECHECK_SUBJECT(OldLib, exp3_quaternion, inverse)
LIECHECK_TEST(OldLib, exp_oracle)

struct Stated : OldLib {
  static constexpr const char *name = "stated", *conventions = "quaternion: wxyz";
};
LIECHECK_SUBJECT(Stated, exp3_quaternion)
LIECHECK_PROPERTY(Stated, exp_oracle)

struct Inverse : OldLib {
  static constexpr const char* name = "inverse";
};
LIECHECK_SUBJECT(Inverse, inverse)
LIECHECK_TESTS(Inverse)
LIECHECK_PROPERTY(Inverse, pose_group)
}  // namespace old

// liecheck's own library in float and double, for the command `environments`, which compiles it with other compilers
// and flags. Rotations are checked as at the library's checked entrance.

#include <Eigen/Core>

#include <liecheck/multibody/se3_configuration.hpp>
#include <liecheck/spatial/checked_rotation.hpp>
#include <liecheck/spatial/exp_log.hpp>
#include <liecheck/spatial/inertia.hpp>
#include <liecheck/spatial/jacobians.hpp>
#include <liecheck_adapter.hpp>

#include "numbers.hpp"

namespace {

using enum liecheck::ArgumentPosition;

template <class S, int n>
using Vector = Eigen::Matrix<S, n, 1>;
template <class S, int rows, int columns>
using Matrix = Eigen::Matrix<S, rows, columns>;

template <int n, class S>
Vector<S, n> vector(const S* x) {
  return Eigen::Map<const Vector<S, n>>(x);
}
template <class S>
Matrix<S, 3, 3> matrix(const S* x) {
  return Eigen::Map<const Eigen::Matrix<S, 3, 3, Eigen::RowMajor>>(x);
}
template <class S>
liecheck::SE3<S> pose(const S* x) {
  return {matrix(x), vector<3>(x + 9)};
}
template <class S>
liecheck::Motion<S> motion(const S* x) {
  return liecheck::Motion<S>(vector<6>(x));
}
template <class S>
liecheck::Force<S> force(const S* x) {
  return liecheck::Force<S>(vector<6>(x));
}
template <class S>
liecheck::Inertia<S> inertia(const S* x) {
  return {x[0], vector<3>(x + 1), matrix(x + 4)};
}
/// A quaternion that the library accepts. Throws std::invalid_argument.
template <class S>
liecheck::SO3<S> rotation(const S* Q) {
  return liecheck::checkedQuaternion<S>(vector<4>(Q));
}
/// A configuration (p, Q) whose quaternion the library accepts.
template <class S>
Vector<S, 7> configuration(const S* q) {
  rotation(q + 3);
  return vector<7>(q);
}

template <class S, int rows, int columns, std::size_t n>
void put(const Matrix<S, rows, columns>& x, Out<S, n> to) {
  static_assert(n == rows * columns);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) to[static_cast<std::size_t>(columns * i + j)] = x(i, j);
}
template <class S>
void put(const liecheck::SE3<S>& X, Out<S, 12> to) {
  put(Matrix<S, 3, 3>(X.rotation()), to.template first<9>());
  put(Vector<S, 3>(X.translation()), to.template last<3>());
}
template <class S>
void put(const liecheck::Inertia<S>& I, Out<S, 13> to) {
  to[0] = I.mass();
  put(Vector<S, 3>(I.lever()), to.template subspan<1, 3>());
  put(Matrix<S, 3, 3>(I.inertia()), to.template last<9>());
}

struct Liecheck {
  static constexpr const char *name = "liecheck_adapter", *version = LIECHECK_VERSION;

// An operation as a template function of spans: `x` has its arguments, and its value is written to the result.
#define OPERATION(name, inputs, results, value)           \
  template <class S>                                      \
  static void name(In<S, inputs> in, Out<S, results> y) { \
    const S* const x = in.data();                         \
    put(value, y);                                        \
  }
  OPERATION(exp3_quaternion, 3, 4, (liecheck::quaternion::exp3<S>(vector<3>(x)).to_vector()))
  OPERATION(exp3_matrix, 3, 9, (liecheck::exp3<S>(vector<3>(x))))
  OPERATION(log3_quaternion, 4, 3, (liecheck::quaternion::log3<S>(rotation(x))))
  OPERATION(log3_matrix, 9, 3, (liecheck::log3<S>(liecheck::checkedRotation<S>(matrix(x)))))
  OPERATION(exp6, 6, 12, (liecheck::exp6<S>(motion(x))))
  OPERATION(log6, 12, 6, (liecheck::checkedRotation<S>(matrix(x)), liecheck::log6<S>(pose(x)).to_vector()))
  OPERATION(compose, 24, 12, (pose(x) * pose(x + 12)))
  OPERATION(inverse, 12, 12, (pose(x).inverse()))
  OPERATION(act_point, 15, 3, (Vector<S, 3>(pose(x).act(vector<3>(x + 12)))))
  OPERATION(act_motion, 18, 6, (pose(x).act(motion(x + 12)).to_vector()))
  OPERATION(act_inverse_motion, 18, 6, (pose(x).actInv(motion(x + 12)).to_vector()))
  OPERATION(act_force, 18, 6, (pose(x).act(force(x + 12)).to_vector()))
  OPERATION(act_inverse_force, 18, 6, (pose(x).actInv(force(x + 12)).to_vector()))
  OPERATION(cross_motion, 12, 6, (motion(x).cross(motion(x + 6)).to_vector()))
  OPERATION(cross_force, 12, 6, (motion(x).cross(force(x + 6)).to_vector()))
  OPERATION(rotate_point, 7, 3, (Vector<S, 3>(rotation(x).act(vector<3>(x + 4)))))
  OPERATION(act_inertia, 25, 13, (pose(x).act(inertia(x + 12))))
  OPERATION(act_inverse_inertia, 25, 13, (pose(x).actInv(inertia(x + 12))))
  OPERATION(momentum, 19, 6, ((inertia(x) * motion(x + 13)).to_vector()))
  OPERATION(kinetic_energy, 19, 1, (Vector<S, 1>(inertia(x).kineticEnergy(motion(x + 13)))))
  OPERATION(inertia_matrix, 13, 36, (Matrix<S, 6, 6>(inertia(x).matrix())))
  OPERATION(integrate, 13, 7, (Vector<S, 7>(liecheck::integrateSE3<S>(configuration(x), vector<6>(x + 7)))))
  OPERATION(difference, 14, 6,
            (Vector<S, 6>(liecheck::differenceSE3<S>(configuration(x), configuration(x + 7)))))
  OPERATION(left_jacobian3, 3, 9, (liecheck::leftJacobian<S>(vector<3>(x))))
  OPERATION(right_jacobian3, 3, 9, (liecheck::rightJacobian<S>(vector<3>(x))))
  OPERATION(left_jacobian3_inverse, 3, 9, (liecheck::leftJacobianInverse<S>(vector<3>(x))))
  OPERATION(right_jacobian3_inverse, 3, 9, (liecheck::rightJacobianInverse<S>(vector<3>(x))))
  OPERATION(left_jacobian6, 6, 36, (liecheck::leftJacobian<S>(motion(x))))
  OPERATION(right_jacobian6, 6, 36, (liecheck::rightJacobian<S>(motion(x))))
  OPERATION(left_jacobian6_inverse, 6, 36, (liecheck::leftJacobianInverse<S>(motion(x))))
  OPERATION(right_jacobian6_inverse, 6, 36, (liecheck::rightJacobianInverse<S>(motion(x))))
  OPERATION(d_integrate_arg0, 13, 36, (liecheck::dIntegrateSE3<S>(configuration(x), vector<6>(x + 7), ARG0)))
  OPERATION(d_integrate_arg1, 13, 36, (liecheck::dIntegrateSE3<S>(configuration(x), vector<6>(x + 7), ARG1)))
  OPERATION(d_difference_arg0, 14, 36,
            (liecheck::dDifferenceSE3<S>(configuration(x), configuration(x + 7), ARG0)))
  OPERATION(d_difference_arg1, 14, 36,
            (liecheck::dDifferenceSE3<S>(configuration(x), configuration(x + 7), ARG1)))
  OPERATION(integrate_coefficient_jacobian, 7, 42,
            (Matrix<S, 7, 6>(liecheck::integrateCoeffWiseJacobianSE3<S>(configuration(x)))))
  OPERATION(normalize, 4, 4, (liecheck::SO3<S>(vector<4>(x)).normalized().to_vector()))
  OPERATION(first_order_normalize, 4, 4, (liecheck::SO3<S>(vector<4>(x)).firstOrderNormalized().to_vector()))
  OPERATION(matrix_from_quaternion_any_norm, 4, 9, (Matrix<S, 3, 3>(liecheck::SO3<S>(vector<4>(x)).matrix())))
  OPERATION(rotate_point_any_norm, 7, 3, (Vector<S, 3>(liecheck::SO3<S>(vector<4>(x)).act(vector<3>(x + 4)))))
  OPERATION(log3_any_norm, 4, 3, (liecheck::quaternion::log3<S>(liecheck::SO3<S>(vector<4>(x)))))
  OPERATION(integrate_any_norm, 13, 7,
            (Vector<S, 7>(liecheck::integrateSE3<S>(vector<7>(x), vector<6>(x + 7)))))
  OPERATION(difference_any_norm, 14, 6,
            (Vector<S, 6>(liecheck::differenceSE3<S>(vector<7>(x), vector<7>(x + 7)))))
  OPERATION(d_difference_any_norm, 14, 36,
            (liecheck::dDifferenceSE3<S>(vector<7>(x), vector<7>(x + 7), ARG1)))
#undef OPERATION
};

}  // namespace

LIECHECK_ADAPTER(Liecheck, exp3_quaternion, exp3_matrix, log3_quaternion, log3_matrix, exp6, log6, compose,
                 inverse, act_point, act_motion, act_inverse_motion, act_force, act_inverse_force,
                 cross_motion, cross_force, rotate_point, act_inertia, act_inverse_inertia, momentum,
                 kinetic_energy, inertia_matrix, integrate, difference, left_jacobian3, right_jacobian3,
                 left_jacobian3_inverse, right_jacobian3_inverse, left_jacobian6, right_jacobian6,
                 left_jacobian6_inverse, right_jacobian6_inverse, d_integrate_arg0, d_integrate_arg1,
                 d_difference_arg0, d_difference_arg1, integrate_coefficient_jacobian, normalize,
                 first_order_normalize, matrix_from_quaternion_any_norm, rotate_point_any_norm, log3_any_norm,
                 integrate_any_norm, difference_any_norm, d_difference_any_norm)

#include <oracles/motions/elliptic.hpp>
#include <oracles/motions/one_coordinate.hpp>

#include <boost/math/constants/constants.hpp>

namespace liecheck::oracles {

template <class T>
CoordinateState<T> Pendulum<T>::at(const T& t) const {
  const T pi = boost::math::constants::pi<T>(), periods = 2 * pi * floor(T(initial.q / (2 * pi) + T(0.5)));
  const T half_angle = (initial.q - periods) / 2, rate = initial.v / (2 * w);
  T sine, cosine;
  sin_cos(half_angle, sine, cosine);
  const T k = sqrt(T(sine * sine + rate * rate));
  if (k == 0) return initial;
  if (k < 1) {
    const T s = first_kind<T>(atan2(sine, rate), k);
    const Jacobi<T> e = jacobi<T>(w * t + s, k);
    return {periods + 2 * asin(T(k * e.sn)), 2 * w * k * e.cn};
  }
  const T sign = initial.v < 0 ? -1 : 1, modulus = 1 / k;
  if (k == 1 && rate == 0) return initial;  // at the unstable equilibrium
  const Jacobi<T> e = jacobi<T>(sign * k * w * t + first_kind<T>(half_angle, modulus), modulus);
  return {periods + 2 * e.am, sign * 2 * w * k * e.dn};
}

template struct Pendulum<Real>;
template struct Pendulum<Real100>;

}  // namespace liecheck::oracles

#include <oracles/motions/elliptic.hpp>
#include <oracles/motions/pendulum.hpp>

#include <boost/math/constants/constants.hpp>

namespace liecheck::oracles {

template <class T>
CoordinateState<T> Pendulum<T>::at(const T& t) const {
  const T pi = boost::math::constants::pi<T>(), turns = 2 * pi * floor(T(initial.q / (2 * pi) + T(0.5)));
  const T half = (initial.q - turns) / 2, rate = initial.v / (2 * w);
  T sine, cosine;
  sin_cos(half, sine, cosine);
  const T k = sqrt(T(sine * sine + rate * rate));
  if (k == 0) return initial;
  if (k < 1) {
    const T s = first_kind<T>(atan2(sine, rate), k);
    const Jacobi<T> e = jacobi<T>(w * t + s, k);
    return {turns + 2 * asin(T(k * e.sn)), 2 * w * k * e.cn};
  }
  const T sign = initial.v < 0 ? -1 : 1, modulus = 1 / k;
  if (k == 1 && rate == 0) return initial;  // upright, at rest
  const Jacobi<T> e = jacobi<T>(sign * k * w * t + first_kind<T>(half, modulus), modulus);
  return {turns + 2 * e.am, sign * 2 * w * k * e.dn};
}

template struct Pendulum<Real>;
template struct Pendulum<Real100>;

}  // namespace liecheck::oracles

#pragma once
// The right Jacobian of SE(3) by its definition, as a third formula beside those of oracles/jacobians.hpp.

#include <oracles/jacobians.hpp>
#include <oracles/matrix_exponential.hpp>

namespace liecheck::oracles {

/// Column i is vee(exp(-xi) d/dh exp(xi + h e_i)) by central differences at 100 digits, with exp by scaling
/// and squaring. Unit of length and step are those of oracles/jacobians.hpp. `resolved` is true if the matrix
/// has the form [[J, C], [0, J]]; unlike the oracles, this formula is not confirmed by phi1.
inline Jacobian6Result right_jacobian_fd(const Vec6<>& xi) {
  using T = Real100;
  Vec6<T> centre = cast<T>(xi);
  const T length = norm(head3(centre)), unit = length == 0 ? T(1) : length;
  for (int i = 0; i < 3; ++i) centre[i] /= unit;
  const Mat3<T> Rt = transpose(identity<3, T>() + affine_exponential(centre).E);
  const T h = ldexp(T(1), -110), by_2h = 1 / (2 * h);
  Mat6<T> m;
  for (int i = 0; i < 6; ++i) {
    Vec3<T> dp, dphi = zero_vector<3, T>();
    if (i < 3) {  // p is linear in rho: the derivative is p at rho = e_i
      Vec6<T> e = centre;
      for (int k = 0; k < 3; ++k) e[k] = k == i ? 1 : 0;
      dp = affine_exponential(e).p;
    } else {
      Vec6<T> plus = centre, minus = centre;
      plus[i] += h;
      minus[i] -= h;
      const AffineExponential<T> a = affine_exponential(plus), b = affine_exponential(minus);
      dp = by_2h * (a.p - b.p);
      dphi = vee(Rt * (by_2h * (a.E - b.E)));
    }
    const Vec6<T> column = stack(Rt * dp, dphi);
    for (int r = 0; r < 6; ++r) m(r, i) = column[r];
  }
  const Mat3<T> J = block(m, 0, 0), C = unit * block(m, 0, 1);
  const bool structure = agree(block(m, 1, 1), J) && norm(block(m, 1, 0)) <= T(agreement);
  return {cast<Real>(J), cast<Real>(C), structure};
}

}  // namespace liecheck::oracles

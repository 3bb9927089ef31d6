#include <oracles/jacobians.hpp>

#include <oracles/closed_forms.hpp>
#include <oracles/matrix_exponential.hpp>

namespace liecheck::oracles {
namespace {

enum class Form { direct, inverse };

/// Is K the inverse of V? If K V = I + r, the relative error of K is ||r||.
template <class T>
bool inverse_agrees(const Mat3<T>& V, const Mat3<T>& K) {
  return norm(K * V - identity<3, T>()) <= T(agreement);
}

/// Does [[J, C], [0, J]] equal V = phi1(ad xi), or the inverse of V? For the inverse V.a C + V.b J is zero;
/// if it is r, the error of C is J r. The error of a C that is zero is compared with C_scale.
template <class T>
bool phi1_agrees(const Vec6<Real100>& xi, Form form, const JacobianBlocks<Real100>& expected,
                 const Real100& C_scale) {
  const Dual3<T> V = phi1_adjoint(cast<T>(xi));
  const Mat3<T> J = cast<T>(expected.J), C = cast<T>(expected.C);
  if (form == Form::direct) return agree(V.a, J) && agree(V.b, C, agreement, T(C_scale));
  const T size = norm(C), scale(C_scale);
  return inverse_agrees(V.a, J) &&
         norm(J * (V.a * C + V.b * J)) <= T(agreement) * (scale > size ? scale : size);
}

bool confirm(const Vec6<Real100>& xi, Form form, const JacobianBlocks<Real100>& expected,
             const Real100& C_scale = 0) {
  const int e = exponent_of(norm(tail3(xi)));
  if (e > 80) return false;
  return confirmed(e <= 10, [&]<class T>(T) { return phi1_agrees<T>(xi, form, expected, C_scale); });
}

Jacobian6Result rounded(const JacobianBlocks<Real100>& blocks, bool resolved) {
  return {cast<Real>(blocks.J), cast<Real>(blocks.C), resolved};
}

Jacobian6Result left_jacobian(const Vec6<Real100>& xi, Form form) {
  const JacobianBlocks<Real100> blocks =
      form == Form::inverse ? closed_left_jacobian_inverse(xi) : closed_left_jacobian(xi);
  return rounded(blocks, confirm(xi, form, blocks));
}

Jacobian3Result left_jacobian(const Vec3<Real100>& phi, Form form) {
  const Vec6<Real100> xi = stack(zero_vector<3, Real100>(), phi);
  const Mat3<Real100> J =
      form == Form::inverse ? closed_left_jacobian_inverse(xi).J : closed_left_jacobian(xi).J;
  const int e = exponent_of(norm(phi));
  const bool resolved = e <= 80 && confirmed(e <= 10, [&]<class T>(T) {
                          const Mat3<T> V = phi1_so3(cast<T>(phi));
                          return form == Form::inverse ? inverse_agrees(V, cast<T>(J)) : agree(V, cast<T>(J));
                        });
  return {cast<Real>(J), resolved};
}

/// The step of every difference in this file; lengths are in units of ||rho||.
Real100 step() {
  return ldexp(Real100(1), -110);
}

/// Central differences of a tangent-valued function of a tangent vector at zero: column i is
/// (f(h e_i) - f(-h e_i)) / (2 h).
template <class F>
Mat6<Real100> central_differences(F&& f) {
  const Real100 h = step(), by_2h = 1 / (2 * h);
  Mat6<Real100> m;
  for (int i = 0; i < 6; ++i) {
    Vec6<Real100> e = zero_vector<6, Real100>();
    e[i] = h;
    const Vec6<Real100> column = by_2h * (f(e) - f(-e));
    for (int r = 0; r < 6; ++r) m(r, i) = column[r];
  }
  return m;
}

/// The unit of length of the differences. `result` confirms, in this unit, the structure [[J, C], [0, J]] and
/// the blocks (by phi1 or Ad). Then it converts C back to metres.
struct Scaled {
  Real100 unit;       ///< [m]; 1 if the given length is zero
  bool none = false;  ///< the given length is zero, and so is C

  explicit Scaled(const Vec3<Real100>& length) : unit(norm(length)) {
    none = unit == 0;
    if (none) unit = 1;
  }
  Real100 C_scale() const { return none ? Real100(1) : Real100(0); }

  template <class Confirm>
  Jacobian6Result result(const Mat6<Real100>& m, Confirm&& confirm) const {
    JacobianBlocks<Real100> blocks{block(m, 0, 0), block(m, 0, 1)};
    const bool structure = agree(block(m, 1, 1), blocks.J) && norm(block(m, 1, 0)) <= Real100(agreement);
    const bool resolved = structure && confirm(blocks);
    blocks.C = none ? zeros<3, 3, Real100>() : unit * blocks.C;
    return rounded(blocks, resolved);
  }
};

Vec7<Real100> configuration(const UnitPose<Real100>& pose) {
  return {{pose.p[0], pose.p[1], pose.p[2], pose.Q[0], pose.Q[1], pose.Q[2], pose.Q[3]}};
}

/// q moved to the origin. A common translation does not change the derivatives of integrate and difference,
/// but a large one would cost digits.
Vec7<Real100> at_origin(const Vec7<>& q) {
  Vec7<Real100> r = cast<Real100>(q);
  r[0] = r[1] = r[2] = 0;
  return r;
}

/// Ad(exp(-delta)) = [[R^T, -R^T [p]], [0, R^T]] with exp by scaling and squaring.
template <class T>
JacobianBlocks<T> adjoint_of_inverse(const Vec6<T>& delta) {
  const AffineExponential<T> X = affine_exponential(delta);
  const Mat3<T> Rt = transpose(identity<3, T>() + X.E);
  return {Rt, T(-1) * (Rt * hat(X.p))};
}

/// difference(q0, q1) on the branch of the relative quaternion `centre`, which is continuous at theta = pi.
Vec6<Real100> difference_on_branch(const Vec7<Real100>& q0, const Vec7<Real100>& q1,
                                   const Quaternion<Real100>& centre) {
  const RelativePose<Real100> r = relative_pose(q0, q1);
  Real100 along(0);
  for (int i = 0; i < 4; ++i) along += r.Q[i] * centre[i];
  return closed_log(along < 0 ? -r.Q : r.Q, r.p, true);
}

Jacobian6Result d_difference(const Vec7<>& q0, const Vec7<>& q1, Branch branch, int argument) {
  const Vec7<Real100> from = at_origin(q0);
  Vec7<Real100> to = at_origin(q1);
  const Vec3<Real100> p = head3(cast<Real100>(q1)) - head3(cast<Real100>(q0));
  const Scaled scaled(p);
  for (int i = 0; i < 3; ++i) to[i] = p[i] / scaled.unit;

  const RelativePose<Real100> relative = relative_pose(from, to);
  const bool flip = (relative.Q[3] < 0) != (branch == Branch::other);
  const Quaternion<Real100> centre = flip ? -relative.Q : relative.Q;
  const Mat6<Real100> m = central_differences([&](const Vec6<Real100>& e) {
    return argument == 0 ? difference_on_branch(configuration(closed_integrate(from, e)), to, centre)
                         : difference_on_branch(from, configuration(closed_integrate(to, e)), centre);
  });
  const Vec6<Real100> delta = closed_log(centre, relative.p, true);
  return scaled.result(m, [&](JacobianBlocks<Real100> blocks) {
    if (argument == 0) blocks = {Real100(-1) * blocks.J, Real100(-1) * blocks.C};
    return confirm(argument == 0 ? delta : -delta, Form::inverse, blocks, scaled.C_scale());
  });
}

/// delta with rho in units of scaled.unit.
Vec6<Real100> in_units(const Vec6<>& delta, const Scaled& scaled) {
  Vec6<Real100> r = cast<Real100>(delta);
  for (int i = 0; i < 3; ++i) r[i] /= scaled.unit;
  return r;
}

}  // namespace

Jacobian3Result left_jacobian_so3(const Vec3<>& phi) {
  return left_jacobian(cast<Real100>(phi), Form::direct);
}
Jacobian3Result left_jacobian_so3_inverse(const Vec3<>& phi) {
  return left_jacobian(cast<Real100>(phi), Form::inverse);
}

Jacobian6Result left_jacobian_se3(const Vec6<>& xi) {
  return left_jacobian(cast<Real100>(xi), Form::direct);
}
Jacobian6Result right_jacobian_se3(const Vec6<>& xi) {
  return left_jacobian(cast<Real100>(-xi), Form::direct);
}
Jacobian6Result left_jacobian_se3_inverse(const Vec6<>& xi) {
  return left_jacobian(cast<Real100>(xi), Form::inverse);
}
Jacobian6Result right_jacobian_se3_inverse(const Vec6<>& xi) {
  return left_jacobian(cast<Real100>(-xi), Form::inverse);
}

Jacobian6Result d_integrate_arg0(const Vec7<>& q, const Vec6<>& delta) {
  const Scaled scaled(head3(cast<Real100>(delta)));
  const Vec6<Real100> d = in_units(delta, scaled);
  const Vec7<Real100> q0 = at_origin(q), centre = configuration(closed_integrate(q0, d));
  const Mat6<Real100> m = central_differences([&](const Vec6<Real100>& e) {
    const Vec7<Real100> moved = configuration(closed_integrate(q0, e));
    return closed_difference(centre, configuration(closed_integrate(moved, d)));
  });
  return scaled.result(m, [&](const JacobianBlocks<Real100>& blocks) {
    const int exponent = exponent_of(norm(tail3(d)));
    return exponent <= 40 && confirmed(exponent <= 10, [&]<class T>(T) {
             const JacobianBlocks<T> a = adjoint_of_inverse(cast<T>(d));
             return agree(a.J, cast<T>(blocks.J)) &&
                    agree(a.C, cast<T>(blocks.C), agreement, T(scaled.C_scale()));
           });
  });
}

Jacobian6Result d_integrate_arg1(const Vec7<>& q, const Vec6<>& delta) {
  const Scaled scaled(head3(cast<Real100>(delta)));
  const Vec6<Real100> d = in_units(delta, scaled);
  const Vec7<Real100> q0 = at_origin(q), centre = configuration(closed_integrate(q0, d));
  const Mat6<Real100> m = central_differences([&](const Vec6<Real100>& e) {
    return closed_difference(centre, configuration(closed_integrate(q0, d + e)));
  });
  return scaled.result(m, [&](const JacobianBlocks<Real100>& blocks) {
    return confirm(-d, Form::direct, blocks, scaled.C_scale());
  });
}

Jacobian6Result d_difference_arg0(const Vec7<>& q0, const Vec7<>& q1, Branch branch) {
  return d_difference(q0, q1, branch, 0);
}
Jacobian6Result d_difference_arg1(const Vec7<>& q0, const Vec7<>& q1, Branch branch) {
  return d_difference(q0, q1, branch, 1);
}

}  // namespace liecheck::oracles

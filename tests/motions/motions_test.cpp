// Compares closed forms of motions with integrations of their equations and with conserved quantities.

#include <gtest/gtest.h>

#include <oracles/motions/extrapolation.hpp>
#include <oracles/motions/free_body.hpp>
#include <oracles/motions/lagrange_top.hpp>
#include <oracles/motions/one_coordinate.hpp>
#include <oracles/motions/planar_chain.hpp>
#include <oracles/motions/torque_free.hpp>

namespace {

using namespace liecheck::oracles;
using T = Real100;
using Attitude = AttitudeState<T>;

// With this tolerance reference() agrees to 1e-43 at orders 28 and 32. Closed forms are more accurate.
const T tolerance("1e-46"), close("1e-41");

Mat3<T> diagonal(const Vec3<T>& d) {
  Mat3<T> m = zeros<3, 3, T>();
  for (int i = 0; i < 3; ++i) m(i, i) = d[i];
  return m;
}

/// The larger of the attitude error [rad] and the relative error of the angular velocity.
T distance(const Attitude& a, const Attitude& b) {
  return larger<T>(angle_between(a.Q, b.Q), norm(a.omega - b.omega) / (1 + norm(b.omega)));
}

/// Returns the time derivative of (x y z w, omega) of a body that rotates about a fixed point or its centre
/// of mass: Q' = Q (omega, 0) / 2, I omega' = (I omega) x omega + at_B x R^T force_W. The closed forms solve
/// these equations. The constant force force_W [N] acts at at_B [m] from that point.
struct RigidBodyEquations {
  Mat3<T> inertia, inverse_inertia;  ///< about that point [kg m^2]
  Vec3<T> force_W = zero_vector<3, T>(), at_B = zero_vector<3, T>();

  Vec7<T> operator()(const Vec7<T>& y) const {
    const Quaternion<T> Q{{y[0], y[1], y[2], y[3]}};
    const Vec3<T> w{{y[4], y[5], y[6]}};
    const Quaternion<T> rate = quaternion_product(Q, Quaternion<T>{{w[0], w[1], w[2], T(0)}});
    Vec3<T> torque = cross(inertia * w, w);
    if (squared_norm(force_W) != 0) torque = torque + cross(at_B, rotate(Q, force_W, true));
    const Vec3<T> dw = inverse_inertia * torque;
    return {{rate[0] / 2, rate[1] / 2, rate[2] / 2, rate[3] / 2, dw[0], dw[1], dw[2]}};
  }
};

Vec7<T> numbers_of(const Attitude& s) {
  return {{s.Q[0], s.Q[1], s.Q[2], s.Q[3], s.omega[0], s.omega[1], s.omega[2]}};
}
Attitude state_of(const Vec7<T>& y) {
  return {{{y[0], y[1], y[2], y[3]}}, {{y[4], y[5], y[6]}}};
}

Attitude integrated(const RigidBodyEquations& body, const Attitude& initial, const T& t) {
  const auto r = reference<7, T>(body, numbers_of(initial), t, tolerance);
  EXPECT_LT(r.disagreement, T("1e-43"));
  return state_of(r.y);
}

Quaternion<T> some_attitude() {
  return normalized(Quaternion<T>{{T(1), T(-2), T(3), T(4)}});
}

void check_triaxial(const Vec3<T>& moments, const Vec3<T>& omega, const T& t) {
  const Attitude initial{some_attitude(), omega};
  const Vec3<T> inverse{{1 / moments[0], 1 / moments[1], 1 / moments[2]}};
  const TriaxialBody<T> body(moments, initial);
  EXPECT_LT(distance(body.at(T(0)), initial), T("1e-48"));
  const Attitude found = body.at(t);
  EXPECT_LT(distance(found, integrated({diagonal(moments), diagonal(inverse)}, initial, t)), close);
  const auto momentum = [&](const Attitude& s) { return rotate(s.Q, diagonal(moments) * s.omega); };
  EXPECT_LT(norm(momentum(found) - momentum(initial)), T("1e-48") * norm(momentum(initial)));
  const auto energy = [&](const Attitude& s) { return dot(s.omega, diagonal(moments) * s.omega); };
  EXPECT_LT(abs(energy(found) - energy(initial)), T("1e-48") * energy(initial));
}

TEST(TriaxialBody, SolvesItsEquationsOnBothSidesOfTheSeparatrixInEveryOrderOfAxes) {
  const T small("1e-3");
  check_triaxial({{T(1), T(2), T(3)}}, {{T(1), T(2), T(-1)}}, T(3));
  check_triaxial({{T(2), T(3), T(1)}}, {{T(-2), T("0.3"), T("0.4")}}, T(3));
  check_triaxial({{T(3), T(1), T(2)}}, {{T("0.2"), T(2), small}}, T(3));
  check_triaxial({{T(2), T(1), T("2.5")}}, {{small, T("-1.5"), T(-1)}}, T(-0) + T(2));
  check_triaxial({{T(1), T(2), T(3)}}, {{T(0), T(3), small}}, T(4));
}

TEST(TriaxialBody, FlipsWhenTheRateAboutTheMiddleAxisIsZero) {
  const Attitude initial{some_attitude(), {{T("1e-8"), T(3), T(0)}}};
  const TriaxialBody<T> body({{T(1), T(2), T(3)}}, initial);
  T last(0);
  for (int n = 0; n < 4; ++n) {
    const T t = body.flip_time(n), h("1e-6");
    EXPECT_LT(abs(body.at(t).omega[1]), T("1e-60"));
    EXPECT_LT(body.at(t - h).omega[1] * body.at(t + h).omega[1], 0);
    if (n > 0) {
      EXPECT_LT(abs(t - last - body.period() / 2), T("1e-60"));
    }
    EXPECT_GT(t, last);
    last = t;
  }
}

TEST(TriaxialBody, RefusesEqualMomentsAndPrincipalAxes) {
  const auto make = [](const Vec3<T>& moments, const Vec3<T>& omega) {
    TriaxialBody<T>(moments, Attitude{some_attitude(), omega});
  };
  EXPECT_THROW(make({{T(1), T(1), T(2)}}, {{T(1), T(1), T(1)}}), std::domain_error);
  EXPECT_THROW(make({{T(1), T(2), T(3)}}, {{T(0), T(1), T(0)}}), std::domain_error);
  EXPECT_THROW(make({{T(1), T(2), T(3)}}, {{T(0), T(0), T(1)}}), std::domain_error);
}

TEST(AxisymmetricBody, SolvesItsEquations) {
  for (const T& axial : {T("0.1"), T("1.9"), T(1)}) {
    const Attitude initial{some_attitude(), {{T(1), T(-2), T(3)}}};
    const Vec3<T> moments{{T(1), axial, T(1)}}, inverse{{T(1), 1 / axial, T(1)}};
    const AxisymmetricBody<T> body{T(1), axial, {{T(0), T(1), T(0)}}, initial};
    EXPECT_LT(distance(body.at(T(2)), integrated({diagonal(moments), diagonal(inverse)}, initial, T(2))),
              close);
  }
}

TEST(ConstantTwist, EqualsTheAxisymmetricBodyWithEqualMoments) {
  const Attitude initial{some_attitude(), {{T(1), T(-2), T(3)}}};
  const AxisymmetricBody<T> body{T(1), T(1), {{T(0), T(1), T(0)}}, initial};
  EXPECT_LT(distance(constant_twist(initial, T(5)), body.at(T(5))), T("1e-90"));
}

TEST(FreeBody, FallsAndRotatesAboutItsCentreOfMassWithAnyBodyAxes) {
  const Vec3<T> c{{T("0.1"), T("-0.2"), T("0.3")}}, g{{T(0), T(1), T("-9.81")}};
  const Mat3<T> I{{T(3), T("0.4"), T("-0.2"), T("0.4"), T(2), T("0.1"), T("-0.2"), T("0.1"), T("1.5")}};
  const BodyState<T> initial{
      {{T(1), T(2), T(3)}}, some_attitude(), {{T(1), T(0), T(-1)}}, {{T(1), T(2), T(-3)}}};
  const FreeBody<T> body({T(2), c, I}, initial, g);
  EXPECT_EQ(body.family(), "triaxial torque-free body");
  const BodyState<T> start = body.at(T(0)), end = body.at(T(2));
  EXPECT_LT(distance({start.Q, start.omega}, {initial.Q, initial.omega}), T("1e-45"));
  EXPECT_LT(norm(start.p - initial.p) + norm(start.u - initial.u), T("1e-45"));
  const Attitude turned = integrated({I, inverse(I)}, {initial.Q, initial.omega}, T(2));
  EXPECT_LT(distance({end.Q, end.omega}, turned), close);
  const auto at_C = [&](const BodyState<T>& s) { return s.p + rotate(s.Q, c); };
  const auto v_C = [&](const BodyState<T>& s) { return rotate(s.Q, s.u + cross(s.omega, c)); };
  EXPECT_LT(norm(v_C(end) - v_C(initial) - T(2) * g), T("1e-45"));
  EXPECT_LT(norm(at_C(end) - at_C(initial) - T(2) * v_C(initial) - T(2) * g), T("1e-45"));
  const auto family = [&](const Vec3<T>& moments, const Vec3<T>& omega) {
    return FreeBody<T>({T(1), c, diagonal(moments)}, {initial.p, initial.Q, initial.u, omega}, g).family();
  };
  EXPECT_EQ(family({{T(2), T(1), T(2)}}, {{T(1), T(1), T(1)}}), "axisymmetric torque-free body");
  EXPECT_EQ(family({{T(3), T(1), T(2)}}, {{T(0), T(1), T(0)}}), "constant twist");
  EXPECT_EQ(family({{T(2), T(2), T(2)}}, {{T(3), T(1), T(2)}}), "constant twist");
}

TEST(Pendulum, SolvesItsEquationOscillatingRotatingAndOnTheSeparatrix) {
  const T w("1.5");
  for (const auto& [q, v] : {std::pair<T, T>{T(1), T(0)},
                             {T(-2), T(1)},
                             {T("0.3"), T(4)},
                             {T(7), T("-3.5")},
                             {T(0), 2 * w},
                             {T("3.1"), T(0)},
                             {T("-9.5"), T("0.1")}}) {
    const Pendulum<T> pendulum{w, {q, v}};
    const auto f = [&](const Vec<2, T>& y) { return Vec<2, T>{{y[1], -w * w * sin(y[0])}}; };
    const auto r = reference<2, T>(f, {{q, v}}, T(5), tolerance);
    const CoordinateState<T> found = pendulum.at(T(5));
    EXPECT_LT(abs(found.q - r.y[0]) + abs(found.v - r.y[1]), close) << q << " " << v;
    const auto energy = [&](const T& a, const T& b) -> T { return b * b / 2 - w * w * cos(a); };
    EXPECT_LT(abs(energy(found.q, found.v) - energy(q, v)), T("1e-90"));
  }
}

TEST(DampedSpring, SolvesItsEquationInEveryRegime) {
  for (const T& damping : {T(0), T("0.3"), T(4), T(9)}) {  // none, below critical, critical, above critical
    const DampedSpring<T> spring{T(2), damping, T(2), T("0.5"), T(-3), {T(1), T(2)}};
    const auto f = [&](const Vec<2, T>& y) {
      return Vec<2, T>{{y[1], (T(-3) - damping * y[1] - 2 * (y[0] - T("0.5"))) / 2}};
    };
    const auto r = reference<2, T>(f, {{T(1), T(2)}}, T(3), tolerance);
    const CoordinateState<T> found = spring.at(T(3));
    EXPECT_LT(abs(found.q - r.y[0]) + abs(found.v - r.y[1]), close) << damping;
  }
}

void check_top(const Quaternion<T>& Q, const Vec3<T>& omega) {
  const T transverse("1.2"), axial("0.5"), torque(3);
  const Attitude initial{Q, omega};
  const LagrangeTop<T> top(transverse, axial, torque, initial);
  EXPECT_LT(distance(top.at(T(0)), initial), T("1e-45"));
  const Vec3<T> moments{{transverse, transverse, axial}};
  RigidBodyEquations body{diagonal(moments), diagonal({{1 / transverse, 1 / transverse, 1 / axial}})};
  body.force_W = {{T(0), T(0), -torque}};
  body.at_B = {{T(0), T(0), T(1)}};
  const Attitude found = top.at(T(3));
  EXPECT_LT(distance(found, integrated(body, initial, T(3))), close);
  const T u = rotation_matrix(normalized(found.Q))(2, 2);
  EXPECT_GE(u, top.lowest() - T("1e-45"));
  EXPECT_LE(u, top.highest() + T("1e-45"));
}

TEST(LagrangeTop, SolvesItsEquations) {
  check_top(some_attitude(), {{T(1), T("0.5"), T(7)}});
  check_top(some_attitude(), {{T("-0.2"), T(2), T(-9)}});
  check_top(normalized(Quaternion<T>{{T("0.1"), T(0), T(0), T(1)}}), {{T(0), T(0), T(12)}});  // no precession
  check_top(normalized(Quaternion<T>{{T("1e-6"), T(0), T(0), T(1)}}),
            {{T("1e-6"), T(0), T(20)}});                         // almost a sleeping top
  check_top({{T(0), T(0), T(0), T(1)}}, {{T(0), T(0), T(20)}});  // a sleeping top
}

/// I_t cosine p^2 - I_z omega_z p + m g c = 0 has two rates p of steady precession.
TEST(LagrangeTop, SolvesItsEquationsIfItPrecessesSteadilyAtEitherRate) {
  const T transverse("1.2"), axial("0.5"), torque(3), cosine("0.6"), sine("0.8"), spin(20);
  const T half = axial * spin / 2, larger = half + sqrt(T(half * half - transverse * cosine * torque));
  const Quaternion<T> Q{{T(0), sqrt(T((1 - cosine) / 2)), T(0), sqrt(T((1 + cosine) / 2))}};
  for (const T& rate : {T(torque / larger), T(larger / (transverse * cosine))}) {
    const Attitude initial{Q, {{-sine * rate, T(0), spin}}};
    check_top(initial.Q, initial.omega);
    const LagrangeTop<T> top(transverse, axial, torque, initial);
    EXPECT_LT(top.highest() - top.lowest(), T("1e-45"));
  }
}

/// Kinetic + potential energy [J] of y = (theta, theta').
template <int N>
T energy_of(const PlanarChain<N, T>& chain, const Vec<2 * N, T>& y) {
  const Mat<N, N, T> K = chain.couplings();
  T sum(0), beyond(0);
  for (int i = N - 1; i >= 0; --i) {
    const Link<T>& link = chain.links[static_cast<std::size_t>(i)];
    for (int j = 0; j < N; ++j) sum += K(i, j) * cos(T(y[i] - y[j])) * y[N + i] * y[N + j] / 2;
    sum += chain.gravity * (link.mass * link.centre + link.length * beyond) * sin(y[i]);
    beyond += link.mass;
  }
  return sum;
}

TEST(PlanarChain, KeepsItsEnergyAndOneLinkIsAPendulum) {
  PlanarChain<3, T> chain;
  chain.links = {Link<T>{T(1), T("0.5"), T(1), T("0.1")},
                 {T(2), T("0.4"), T("0.8"), T("0.2")},
                 {T(1), T("0.3"), T("0.6"), T("0.05")}};
  chain.gravity = T("9.81");
  const Vec<6, T> y0{{T("0.1"), T("-0.5"), T(1), T(1), T(-2), T("0.5")}};
  const auto r = reference<6, T>(chain, y0, T("0.5"), tolerance);
  EXPECT_LT(r.disagreement, T("1e-42"));
  EXPECT_LT(abs(energy_of<3>(chain, r.y) - energy_of<3>(chain, y0)), T("1e-41"));
  PlanarChain<1, T> one;
  one.links = {Link<T>{T(2), T("0.5"), T(1), T("0.3")}};
  one.gravity = T("9.81");
  const T right_angle = acos(T(0)), w = sqrt(T(2 * one.gravity * T("0.5") / one.couplings()(0, 0)));
  const auto end = reference<2, T>(one, {{T("0.4") - right_angle, T(1)}}, T(1), tolerance);
  EXPECT_LT(abs(Pendulum<T>{w, {T("0.4"), T(1)}}.at(T(1)).q - right_angle - end.y[0]), close);
}

TEST(Reference, DiffersFromTheClosedFormIfItsEquationsHaveASignError) {
  const Attitude initial{some_attitude(), {{T(1), T(2), T(-1)}}};
  const Vec3<T> moments{{T(1), T(2), T(3)}}, negative{{T(-1), T("-0.5"), T(-1) / 3}};
  const RigidBodyEquations wrong{diagonal(moments), diagonal(negative)};  // I omega' = omega x I omega
  const Attitude off = state_of(extrapolate<7, T>(wrong, numbers_of(initial), T(1), 10, T("1e-20")));
  EXPECT_GT(distance(TriaxialBody<T>(moments, initial).at(T(1)), off), T("0.1"));
}

}  // namespace

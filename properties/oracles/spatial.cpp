#include <oracles/spatial.hpp>

#include <oracles/log.hpp>

namespace liecheck::oracles {
namespace {

template <class T>
PoseOf<T> cast(const Pose& X) {
  return {oracles::cast<T>(X.R), oracles::cast<T>(X.p)};
}
template <class T>
BodyOf<T> cast(const Body& I) {
  return {T(I.mass), oracles::cast<T>(I.c), oracles::cast<T>(I.I_C)};
}
using oracles::cast;

/// agree(a, b). At 100 digits the scale is at least 1e-50 of the terms, as the result may be exactly zero.
template <int N, class T>
bool agree_but_for_zero(const Vec<N, T>& a, const Vec<N, T>& b, const T& terms) {
  static const T zero = pow(T(10), -50);
  return agree(a, b, agreement, std::is_same_v<T, Real100> ? T(zero * terms) : T(0));
}
template <class T>
bool blocks_agree(const Vec6<T>& a, const Vec6<T>& b, const T& linear, const T& angular) {
  return agree_but_for_zero(head3(a), head3(b), linear) && agree_but_for_zero(tail3(a), tail3(b), angular);
}

/// [[R, [p]R], [0, R]]
template <class T>
Mat6<T> motion_matrix(const PoseOf<T>& X) {
  return assemble(X.R, hat(X.p) * X.R, zeros<3, 3, T>(), X.R);
}
/// [[R^T, -R^T [p]], [0, R^T]]
template <class T>
Mat6<T> inverse_motion_matrix(const PoseOf<T>& X) {
  const Mat3<T> Rt = transpose(X.R);
  return assemble(Rt, T(-1) * (Rt * hat(X.p)), zeros<3, 3, T>(), Rt);
}
/// ad_V
template <class T>
Mat6<T> motion_cross_matrix(const Vec6<T>& V) {
  return assemble(hat(tail3(V)), hat(head3(V)), zeros<3, 3, T>(), hat(tail3(V)));
}
/// value(Real100), confirmed by matrix(T) V. terms(T) returns the sizes of the terms that may cancel in the
/// linear part and in the angular part.
template <class Value, class Matrix, class Terms>
SpatialResult spatial_result(Value&& value, Matrix&& matrix, const Vec6<>& V, Terms&& terms) {
  const Vec6<Real100> exact_value = value(Real100());
  const bool resolved = confirmed(true, [&]<class T>(T) {
    const auto [linear, angular] = terms(T());
    return blocks_agree(Vec6<T>(matrix(T()) * cast<T>(V)), cast<T>(exact_value), linear, angular);
  });
  return {cast<Real>(exact_value), resolved};
}

/// The sizes of the linear and the angular terms of a motion (u, w) in another frame, ||u|| + ||p|| ||w|| and
/// ||w||, or of a force (f, n), ||f|| and ||n|| + ||p|| ||f||.
template <class T>
std::pair<T, T> moved_terms(const Pose& X, const Vec6<>& V, bool force) {
  const Vec3<> moved = force ? tail3(V) : head3(V);
  const T other(norm(force ? head3(V) : tail3(V)));
  const T sum = T(norm(moved)) + T(norm(X.p)) * other;
  return force ? std::pair(other, sum) : std::pair(sum, other);
}

}  // namespace

Pose pose_of(const Quaternion<>& Q, const Vec3<>& p) {
  return {cast<Real>(rotation_matrix(normalized(cast<Real100>(Q)))), p};
}

PointResult rotate_point(const Quaternion<>& Q, const Vec3<>& x) {
  const Vec3<Real100> y = rotate(cast<Real100>(Q), cast<Real100>(x));
  const Vec3<Real> second = rotation_matrix(normalized(Q)) * x;
  return {cast<Real>(y), agree(second, cast<Real>(y))};
}

PointResult act_point(const Pose& X, const Vec3<>& x) {
  const auto X100 = cast<Real100>(X);
  const Vec3<Real100> x100 = cast<Real100>(x), y = X100.R * x100 + X100.p;
  const bool resolved = confirmed(true, [&]<class T>(T) {  // [R p; 0 1] (x, 1), column by column
    const Vec3<T> y_t = cast<T>(y), p = cast<T>(X.p);
    Vec3<T> sum = p;
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) sum[i] += T(X.R(i, j)) * T(x[j]);
    return agree_but_for_zero(sum, y_t, T(norm(p) + norm(cast<T>(x))));
  });
  return {cast<Real>(y), resolved};
}

PointResult act_inverse_point(const Pose& X, const Vec3<>& x) {
  const auto X100 = cast<Real100>(X);
  const Vec3<Real100> x100 = cast<Real100>(x), y = transpose(X100.R) * (x100 - X100.p);
  const bool resolved = confirmed(true, [&]<class T>(T) {  // R^T x - R^T p
    const Vec3<T> y_t = cast<T>(y), p = cast<T>(X.p), x_t = cast<T>(x);
    const Mat3<T> Rt = transpose(cast<T>(X.R));
    return agree_but_for_zero(Rt * x_t - Rt * p, y_t, T(norm(p) + norm(x_t)));
  });
  return {cast<Real>(y), resolved};
}

SpatialResult act_motion(const Pose& X, const Vec6<>& V) {
  return spatial_result([&]<class T>(T) { return formulas::act_motion(cast<T>(X), cast<T>(V)); },
                        [&]<class T>(T) { return motion_matrix(cast<T>(X)); }, V,
                        [&]<class T>(T) { return moved_terms<T>(X, V, false); });
}

SpatialResult act_inverse_motion(const Pose& X, const Vec6<>& V) {
  return spatial_result([&]<class T>(T) { return formulas::act_inverse_motion(cast<T>(X), cast<T>(V)); },
                        [&]<class T>(T) { return inverse_motion_matrix(cast<T>(X)); }, V,
                        [&]<class T>(T) { return moved_terms<T>(X, V, false); });
}

SpatialResult act_force(const Pose& X, const Vec6<>& F) {
  return spatial_result([&]<class T>(T) { return formulas::act_force(cast<T>(X), cast<T>(F)); },
                        [&]<class T>(T) { return transpose(inverse_motion_matrix(cast<T>(X))); }, F,
                        [&]<class T>(T) { return moved_terms<T>(X, F, true); });
}

SpatialResult act_inverse_force(const Pose& X, const Vec6<>& F) {
  return spatial_result([&]<class T>(T) { return formulas::act_inverse_force(cast<T>(X), cast<T>(F)); },
                        [&]<class T>(T) { return transpose(motion_matrix(cast<T>(X))); }, F,
                        [&]<class T>(T) { return moved_terms<T>(X, F, true); });
}

SpatialResult cross_motion(const Vec6<>& V, const Vec6<>& W) {
  return spatial_result([&]<class T>(T) { return formulas::cross_motion(cast<T>(V), cast<T>(W)); },
                        [&]<class T>(T) { return motion_cross_matrix(cast<T>(V)); }, W,
                        [&]<class T>(T) {
                          const T u(norm(head3(V))), w(norm(tail3(V))), u_W(norm(head3(W))),
                              w_W(norm(tail3(W)));
                          return std::pair(T(w * u_W + u * w_W), T(w * w_W));
                        });
}

SpatialResult cross_force(const Vec6<>& V, const Vec6<>& F) {
  return spatial_result([&]<class T>(T) { return formulas::cross_force(cast<T>(V), cast<T>(F)); },
                        [&]<class T>(T) { return T(-1) * transpose(motion_cross_matrix(cast<T>(V))); }, F,
                        [&]<class T>(T) {
                          const T u(norm(head3(V))), w(norm(tail3(V))), f(norm(head3(F))), n(norm(tail3(F)));
                          return std::pair(T(w * f), T(w * n + u * f));
                        });
}

namespace {

/// Does `move` equal the congruence of the 6x6 matrices? Precondition: X.R is a rotation.
template <class T, class Move>
bool congruent(const PoseOf<T>& X, const BodyOf<T>& I, bool back, Move&& move) {
  static const T zero = std::is_same_v<T, Real100> ? pow(T(10), -50) : T(0);
  const Mat6<T> Y = back ? motion_matrix(X) : inverse_motion_matrix(X);
  const Mat6<T> a = transpose(Y) * formulas::inertia_matrix(I) * Y, b = formulas::inertia_matrix(move(X, I));
  const T lever = norm(I.c) + norm(X.p), moment = zero * abs(I.mass) * lever;
  const T rotational = moment * lever + zero * norm(I.I_C);
  return agree(block(a, 0, 0), block(b, 0, 0)) && agree(block(a, 0, 1), block(b, 0, 1), agreement, moment) &&
         agree(block(a, 1, 0), block(b, 1, 0), agreement, moment) &&
         agree(block(a, 1, 1), block(b, 1, 1), agreement, rotational);
}

BodyResult inertia_result(const Pose& X, const Body& I, bool back) {
  const auto move = [back]<class T>(const PoseOf<T>& Y, const BodyOf<T>& B) {
    return back ? formulas::act_inverse_inertia(Y, B) : formulas::act_inertia(Y, B);
  };
  const PoseOf<Real100> stored = cast<Real100>(X);
  const BodyOf<Real100> value = move(stored, cast<Real100>(I));
  const NearestQuaternion nearest = nearest_quaternion(stored.R);
  const Mat3<Real100> R = rotation_matrix(nearest.Q);
  const bool resolved = nearest.resolved && confirmed(true, [&]<class T>(T) {
                          return congruent(PoseOf<T>{cast<T>(R), cast<T>(X.p)}, cast<T>(I), back, move);
                        });
  return {{Real(value.mass), cast<Real>(value.c), cast<Real>(value.I_C)}, resolved};
}

}  // namespace

BodyResult act_inertia(const Pose& X, const Body& I) {
  return inertia_result(X, I, false);
}
BodyResult act_inverse_inertia(const Pose& X, const Body& I) {
  return inertia_result(X, I, true);
}

Matrix6Result inertia_matrix(const Body& I) {
  const Mat6<Real100> M = formulas::inertia_matrix(cast<Real100>(I));
  // the second formula: I_O = I_C + m (||c||^2 I - c c^T)
  Mat3<> I_O = I.I_C;
  const Real cc = squared_norm(I.c);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) I_O(i, j) += I.mass * ((i == j ? cc : Real(0)) - I.c[i] * I.c[j]);
  return {cast<Real>(M), agree(I_O, cast<Real>(block(M, 1, 1)))};
}

SpatialResult momentum(const Body& I, const Vec6<>& V) {
  return spatial_result([&]<class T>(T) { return formulas::momentum(cast<T>(I), cast<T>(V)); },
                        [&]<class T>(T) { return formulas::inertia_matrix(cast<T>(I)); }, V,
                        [&]<class T>(T) {
                          const T u(norm(head3(V))), w(norm(tail3(V))), c(norm(I.c)), m = abs(T(I.mass));
                          return std::pair(T(m * (u + c * w)),
                                           T(T(norm(I.I_C)) * w + c * m * (u + c * w)));
                        });
}

ScalarResult kinetic_energy(const Body& I, const Vec6<>& V) {
  using T = Real100;
  const BodyOf<T> B = cast<T>(I);
  const T E = formulas::kinetic_energy(B, cast<T>(V));
  const bool resolved = confirmed(true, [&]<class S>(S) {
    const Vec6<S> V_s = cast<S>(V), h = formulas::inertia_matrix(cast<S>(I)) * V_s;
    const S second = (dot(head3(V_s), head3(h)) + dot(tail3(V_s), tail3(h))) / 2;
    static const S zero = std::is_same_v<S, Real100> ? pow(S(10), -50) : S(0);
    const S speed = norm(head3(V_s)) + S(norm(I.c)) * norm(tail3(V_s));
    const S w2 = squared_norm(tail3(V_s));
    return agree(second, S(E), agreement,
                 S(zero * (abs(S(I.mass)) * speed * speed + S(norm(I.I_C)) * w2)));
  });
  return {Real(E), resolved};
}

ScalarResult power(const Vec6<>& F, const Vec6<>& V) {
  Real100 forward(0), backward(0), terms(0);
  for (int i = 0; i < 6; ++i) {
    const Real100 a = Real100(F[i]) * Real100(V[i]), b = Real100(F[5 - i]) * Real100(V[5 - i]);
    forward += a;
    backward += b;
    terms += abs(a);
  }
  static const Real100 zero = pow(Real100(10), -50);
  return {Real(forward), agree(backward, forward, agreement, Real100(zero * terms))};
}

}  // namespace liecheck::oracles

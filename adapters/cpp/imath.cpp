// Imath: Quat, its axis and angle, and Matrix44, in float and double. A quaternion is (r, v); a matrix multiplies rows
// from the right, so that it is stored as the transposed one. log() and exp() are those of quaternions.

#include <Imath/ImathMatrix.h>
#include <Imath/ImathQuat.h>

#include <liecheck_adapter.hpp>

#include "numbers.hpp"

namespace {

template <class S>
using Vector = Imath::Vec3<S>;
template <class S>
using Quaternion = Imath::Quat<S>;

template <class S>
Vector<S> vector(const S* x) {
  return {x[0], x[1], x[2]};
}
template <class S>
Quaternion<S> quaternion(const S* Q) {
  return {Q[3], Q[0], Q[1], Q[2]};
}
template <class S>
Imath::Matrix44<S> pose(const S* X) {
  return {X[0], X[3], X[6], 0, X[1], X[4], X[7], 0, X[2], X[5], X[8], 0, X[9], X[10], X[11], 1};
}
template <class S>
void put(const Vector<S>& x, S* to) {
  to[0] = x.x, to[1] = x.y, to[2] = x.z;
}
template <class S>
void put(const Quaternion<S>& Q, S* to) {
  put(Q.v, to), to[3] = Q.r;
}
template <class S>
void put(const Imath::Matrix44<S>& M, S* to) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) to[3 * i + j] = M[j][i];
    to[9 + i] = M[3][i];
  }
}

struct Imaths {
  static constexpr const char *name = "imath", *version = IMATH_VERSION_STRING;

  template <class S>
  static void exp3_quaternion(In<S, 3> phi, Out<S, 4> Q) {
    put(Quaternion<S>(0, vector(&phi[0]) / S(2)).exp(), &Q[0]);
  }
  template <class S>
  static void log3_quaternion(In<S, 4> Q, Out<S, 3> phi) {
    put(quaternion(nearer_to_one<S>(Q).data()).log().v * S(2), &phi[0]);
  }
  template <class S>
  static void compose(In<S, 24> x, Out<S, 12> y) {
    put(pose(&x[12]) * pose(&x[0]), &y[0]);
  }
  template <class S>
  static void inverse(In<S, 12> x, Out<S, 12> y) {
    put(pose(&x[0]).inverse(), &y[0]);
  }
  template <class S>
  static void act_point(In<S, 15> x, Out<S, 3> y) {
    put(vector(&x[12]) * pose(&x[0]), &y[0]);
  }
  template <class S>
  static void rotate_point(In<S, 7> x, Out<S, 3> y) {
    put(quaternion(&x[0]).rotateVector(vector(&x[4])), &y[0]);
  }
  template <class S>
  static void normalize(In<S, 4> Q, Out<S, 4> y) {
    put(quaternion(&Q[0]).normalized(), &y[0]);
  }
  template <class S>
  static void slerp(In<S, 9> x, Out<S, 4> y) {
    put(Imath::slerpShortestArc(quaternion(&x[0]), quaternion(&x[4]), x[8]), &y[0]);
  }
  template <class S>
  static void rotation_between(In<S, 6> x, Out<S, 4> y) {
    Quaternion<S> q;
    q.setRotation(vector(&x[0]), vector(&x[3]));
    put(q, &y[0]);
  }
  static const char* source(std::string_view operation) {
    static constexpr Program all[] = {
        {"exp3_quaternion", PROGRAM("Imath/ImathQuat.h",
                                    "using S = {scalar}; Imath::Vec3<S> phi({phi});\n"
                                    "Imath::Quat<S> q = Imath::Quat<S>(0, phi / S(2)).exp();",
                                    "q.v.x, q.v.y, q.v.z, q.r")},
        {"log3_quaternion",
         PROGRAM("Imath/ImathQuat.h",
                 "using S = {scalar}; S Q[] = {{Q}}, s = Q[3] < 0 ? -1 : 1;\n"
                 "auto v = Imath::Quat<S>(s * Q[3], s * Q[0], s * Q[1], s * Q[2]).log().v * S(2);",
                 "v.x, v.y, v.z")},
        {"normalize", PROGRAM("Imath/ImathQuat.h",
                              "using S = {scalar}; S Q[] = {{Q}};\n"
                              "auto q = Imath::Quat<S>(Q[3], Q[0], Q[1], Q[2]).normalized();",
                              "q.v.x, q.v.y, q.v.z, q.r")},
        {"slerp", PROGRAM("Imath/ImathQuat.h",
                          "using S = {scalar}; using Q = Imath::Quat<S>; S a[] = {{Q0}}, b[] = {{Q1}};\n"
                          "Q q0(a[3], a[0], a[1], a[2]), q1(b[3], b[0], b[1], b[2]);\n"
                          "Q q = Imath::slerpShortestArc(q0, q1, S({t}));",
                          "q.v.x, q.v.y, q.v.z, q.r")},
        {"rotation_between", PROGRAM("Imath/ImathQuat.h",
                                     "using S = {scalar}; Imath::Vec3<S> a({a}), b({b});\n"
                                     "Imath::Quat<S> q; q.setRotation(a, b);",
                                     "q.v.x, q.v.y, q.v.z, q.r")},
    };
    return program_for(all, operation);
  }
};

}  // namespace

LIECHECK_ADAPTER(Imaths, exp3_quaternion, log3_quaternion, compose, inverse, act_point, rotate_point,
                 normalize, slerp, rotation_between)

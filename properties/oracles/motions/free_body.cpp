#include <oracles/motions/free_body.hpp>
#include <oracles/motions/torque_free.hpp>

namespace liecheck::oracles {

template <class T>
void principal_axes(Mat3<T> m, Vec3<T>& moments, Mat3<T>& axes) {
  axes = identity<3, T>();
  for (int sweep = 0; sweep < 40; ++sweep)
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      if (m(i, j) == 0) continue;
      const T theta = (m(j, j) - m(i, i)) / (2 * m(i, j));
      const T t = (theta < 0 ? -1 : 1) / (abs(theta) + sqrt(T(theta * theta + 1)));
      const T c = 1 / sqrt(T(t * t + 1)), s = t * c;
      Mat3<T> J = identity<3, T>();
      J(i, i) = J(j, j) = c, J(i, j) = s, J(j, i) = -s;
      m = transpose(J) * m * J;
      m(i, j) = m(j, i) = 0;
      axes = axes * J;
    }
  for (int i = 0; i < 3; ++i) moments[i] = m(i, i);
}

template <class T>
FreeBody<T>::FreeBody(const Body<T>& body, const BodyState<T>& initial, const Vec3<T>& gravity)
    : lever_(body.lever), gravity_(gravity) {
  const Quaternion<T> Q = normalized(initial.Q);
  p_ = initial.p + rotate(Q, lever_);
  v_ = rotate(Q, initial.u + cross(initial.omega, lever_));
  Vec3<T> I;
  principal_axes(body.inertia, I, R_BP_);
  const AttitudeState<T> start{quaternion_product(Q, quaternion_of(R_BP_)), transpose(R_BP_) * initial.omega};
  const Vec3<T>& w = start.omega;
  const auto equal = [&](int i, int j) { return abs(T(I[i] - I[j])) <= T(1e-30) * I[i]; };
  const Vec3<T> L{{I[0] * w[0], I[1] * w[1], I[2] * w[2]}};
  int axial = -1;
  for (int i = 0; i < 3; ++i)
    if (equal((i + 1) % 3, (i + 2) % 3)) axial = i;
  if (norm(cross(L, w)) <= T(1e-45) * norm(L) * norm(w)) {
    family_ = "constant twist";
    attitude_ = [start](const T& t) { return constant_twist(start, t); };
  } else if (axial >= 0) {
    family_ = "axisymmetric torque-free body";
    AxisymmetricBody<T> form{I[(axial + 1) % 3], I[axial], zero_vector<3, T>(), start};
    form.axis[axial] = 1;
    attitude_ = [form](const T& t) { return form.at(t); };
  } else {
    family_ = "triaxial torque-free body";
    attitude_ = [form = TriaxialBody<T>(I, start)](const T& t) { return form.at(t); };
  }
}

template <class T>
BodyState<T> FreeBody<T>::at(const T& t) const {
  const AttitudeState<T> s = attitude_(t);
  BodyState<T> r;
  r.Q = quaternion_product(s.Q, quaternion_of(transpose(R_BP_)));
  r.omega = R_BP_ * s.omega;
  r.p = free_fall(p_, v_, gravity_, t) - rotate(r.Q, lever_);
  r.u = rotate(r.Q, free_fall_velocity(v_, gravity_, t), true) - cross(r.omega, lever_);
  return r;
}

template void principal_axes(Mat3<Real>, Vec3<Real>&, Mat3<Real>&);
template void principal_axes(Mat3<Real100>, Vec3<Real100>&, Mat3<Real100>&);
template class FreeBody<Real>;
template class FreeBody<Real100>;

}  // namespace liecheck::oracles

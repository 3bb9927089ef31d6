#pragma once
// Named initial states that are hard to integrate, for one body on a free-flyer or spherical joint.

#include <Eigen/Eigenvalues>
#include <liecheck/multibody/configuration.hpp>
#include <liecheck/scene/parameters.hpp>

namespace liecheck::scene {

struct StartEntry {
  PartInfo info;
  /// Sets q and v. Throws std::invalid_argument if the start does not fit the robot.
  void (*set)(const Parameters&, const Model<double>&, VectorX<double>& q, VectorX<double>& v);
};

namespace starts_detail {

/// The index in q of joint 1's quaternion, and the index in v of its angular velocity.
struct RotationIndices {
  int q, v;
};
inline RotationIndices rotationIndices(const Model<double>& model, const char* name) {
  if (model.njoints == 2 && std::holds_alternative<FreeFlyer<double>>(model.joints[1])) return {3, 3};
  if (model.njoints == 2 && std::holds_alternative<Spherical<double>>(model.joints[1])) return {0, 0};
  throw std::invalid_argument(std::string("start '") + name +
                              "' needs a robot of one body on a free_flyer or spherical root");
}
/// Principal axes of inertia as columns, in the order of increasing moments. The moments are about the
/// joint's origin or about the centre of mass. The axes are exact if the inertia is diagonal.
inline Matrix3<double> principalAxes(const Model<double>& model, bool about_origin) {
  const Inertia<double>& I = model.inertias[1];
  const Matrix3<double> J = about_origin ? I.inertiaAboutOrigin() : I.inertia();
  if (J.isDiagonal(0)) {
    std::array<int, 3> order{0, 1, 2};
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return J(a, a) < J(b, b); });
    Matrix3<double> axes = Matrix3<double>::Zero();
    for (int i = 0; i < 3; ++i) axes(order[std::size_t(i)], i) = 1;
    return axes;
  }
  return Eigen::SelfAdjointEigenSolver<Matrix3<double>>(J).eigenvectors();
}
template <int AXIS>
void spin(const Parameters& p, const Model<double>& model, VectorX<double>&, VectorX<double>& v) {
  const RotationIndices at = rotationIndices(model, AXIS == 0   ? "minor_spin"
                                                    : AXIS == 1 ? "dzhanibekov"
                                                                : "major_spin");
  const Matrix3<double> axes = principalAxes(model, at.q == 0);
  Vector3<double> omega = Vector3<double>::Zero();
  omega[AXIS] = 1;
  omega[AXIS == 1 ? 0 : 1] = p.number("perturbation");
  const Vector3<double> in_body = p.number("rate") * (axes * omega);
  v.segment<3>(at.v) = in_body;
  if (at.q == 3)  // the centre of mass is at rest
    v.head<3>() = -cross<double>(in_body, model.inertias[1].lever());
}
/// R = R_x(angle).
inline void tilt(VectorX<double>& q, const RotationIndices& at, double angle) {
  q.segment<4>(at.q) << std::sin(angle / 2), 0, 0, std::cos(angle / 2);
}
inline void top(const Parameters& p, const Model<double>& model, const char* name, RotationIndices& at,
                double& I1, double& I3, double& mgl) {
  at = rotationIndices(model, name);
  const Inertia<double>& I = model.inertias[1];
  const Matrix3<double> J = I.inertiaAboutOrigin();
  if (at.q != 0 || !J.isDiagonal(0) || J(0, 0) != J(1, 1) || I.lever()[0] != 0 || I.lever()[1] != 0)
    throw std::invalid_argument(std::string("start '") + name +
                                "' needs a top on a spherical root, symmetric about its z axis");
  I1 = J(0, 0), I3 = J(2, 2), mgl = I.mass() * p.number("gravity") * I.lever()[2];
}
inline void sleeping(const Parameters& p, const Model<double>& model, VectorX<double>& q,
                     VectorX<double>& v) {
  RotationIndices at;
  double I1, I3, mgl;
  top(p, model, "sleeping_top", at, I1, I3, mgl);
  tilt(q, at, p.number("tilt"));
  v.segment<3>(at.v) << 0, 0, p.number("rate");
}
/// Steady precession at the rate s: I1 cos(theta) s^2 - I3 omega_3 s + m g l = 0 (Goldstein 1980, eq. 5-73).
inline void precessing(const Parameters& p, const Model<double>& model, VectorX<double>& q,
                       VectorX<double>& v) {
  RotationIndices at;
  double I1, I3, mgl;
  top(p, model, "precessing_top", at, I1, I3, mgl);
  const double theta = p.number("nutation"), rate = p.number("rate"), b = I3 * rate, a = I1 * std::cos(theta);
  const double root = b * b - 4 * a * mgl;
  if (!(root >= 0) || b == 0)
    throw std::invalid_argument("a top this slow does not precess steadily: rate must be at least " +
                                std::to_string(std::sqrt(4 * std::abs(a * mgl)) / I3) + " rad/s");
  const double sum =
      b + std::copysign(std::sqrt(root), b);  // the root of larger magnitude first: no cancellation
  const double s = p.word("branch") == "slow" || a == 0 ? 2 * mgl / sum : sum / (2 * a);
  tilt(q, at, theta);
  v.segment<3>(at.v) << 0, s * std::sin(theta), rate;
}

}  // namespace starts_detail

inline const std::vector<StartEntry>& startEntries() {
  using namespace starts_detail;
  static const std::vector<Key> spinning = {{"rate", Kind::Number, "rad/s", "1", "spin about the axis"},
                                            {"perturbation", Kind::Number, "1", "0",
                                             "angular velocity about the middle axis (for dzhanibekov: about "
                                             "the axis of the smallest moment), divided by rate"}};
  static const std::vector<StartEntry> all = {
      {{"major_spin", "spin about the axis of the largest moment: stable", "", "", spinning}, spin<2>},
      {{"minor_spin", "spin about the axis of the smallest moment: stable", "", "", spinning}, spin<0>},
      {{"dzhanibekov",
        "spin about the axis of the middle moment: flips after a time that grows as log(1/perturbation)", "",
        "", spinning},
       spin<1>},
      {{"sleeping_top",
        "a top that spins upright or nearly upright",
        "",
        "",
        {{"rate", Kind::Number, "rad/s", nullptr, "spin of the body about its axis"},
         {"tilt", Kind::Number, "rad", "0", "angle from the vertical"},
         {"gravity", Kind::Positive, "m/s^2", "9.81", "magnitude; use that of the effect gravity"}}},
       sleeping},
      {{"precessing_top",
        "steady precession without nutation",
        "",
        "",
        {{"rate", Kind::Number, "rad/s", nullptr, "omega_3: spin of the body about its axis"},
         {"nutation", Kind::Number, "rad", nullptr, "angle from the vertical"},
         {"branch", Kind::Choice, "slow|fast", "slow", "which of the two steady precessions"},
         {"gravity", Kind::Positive, "m/s^2", "9.81", "magnitude; use that of the effect gravity"}}},
       precessing}};
  return all;
}

}  // namespace liecheck::scene

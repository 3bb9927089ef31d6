#pragma once
// The inertia of an ideal fluid at rest that a body accelerates (Kirchhoff 1870; Lamb 1932, art. 124).
//
//   (P, L) = M_a V,  V = (u, omega),  M_a = diag(added), in the axes of the body at its origin
//   f = -P_dot - omega x P,   n = -L_dot - omega x L - u x P
//
// The terms with derivatives are an armature of the six coordinates of the free-flyer: M += M_a. The others do no work,
// so that T + 1/2 V^T M_a V and the impulse R (m u_C + P) are constant if no other force acts.

#include <liecheck/scene/effects/coordinates.hpp>

namespace liecheck::scene {

inline const PartInfo added_mass_info{
    "added_mass",
    "M += diag(m, j),  f = -omega x P,  n = -omega x L - u x P,  (P, L) = diag(m, j) V",
    "conserves: T += 1/2 V^T diag(m, j) V",
    "velocities; the articulated-body algorithm for a lone body",
    {{"joint", Kind::Joints, "", "root_joint", "a free_flyer, whose body moves the fluid"},
     {"masses", Kind::Vector, "kg", "[0, 0, 0]", "m along the axes of the body"},
     {"inertias", Kind::Vector, "kg m^2", "[0, 0, 0]", "j about the axes of the body, at its origin"}}};

template <Scalar S>
class AddedMass final : public Effect<S> {
 public:
  AddedMass(const Parameters& p, const Model<S>& model, const Surroundings&)
      : joint_(std::size_t(model.requireJointId(p.word("joint")))),
        m_(vectorOf<S>(p.numbers("masses"))),
        j_(vectorOf<S>(p.numbers("inertias"))) {
    if (!std::holds_alternative<FreeFlyer<S>>(model.joints[joint_]))
      throw std::invalid_argument("added_mass acts on the body of a free_flyer, and joint '" +
                                  p.word("joint") + "' is none");
    if (m_.minCoeff() < S(0) || j_.minCoeff() < S(0))
      throw std::invalid_argument("added_mass has a mass or an inertia below 0");
  }
  Acts acts() const override { return Acts::OnBodies; }
  Kinematics needs() const override { return Kinematics::Velocities; }
  bool conservative() const override { return true; }
  void prepare(Model<S>& model) const override {
    for (int i = 0; i < 3; ++i) {
      model.armature[model.idx_vs[joint_] + i] += m_[i];
      model.armature[model.idx_vs[joint_] + 3 + i] += j_[i];
    }
  }
  void add(const Now<S>& now, const Load<S>& load) const override {
    const Motion<S> V = now.V[joint_];
    const Vector3<S> u = V.linear(), omega = V.angular(), P = m_.cwiseProduct(u), L = j_.cwiseProduct(omega);
    const Matrix3<S>& R = now.X_WJ[joint_].rotation();
    load.f[joint_] = load.f[joint_] - Force<S>(product<S>(R, cross<S>(omega, P)),
                                               product<S>(R, Vector3<S>(cross<S>(omega, L) + cross<S>(u, P))));
  }

 private:
  std::size_t joint_;
  Vector3<S> m_, j_;
};

}  // namespace liecheck::scene

#pragma once
// Painleve's paradox (Painleve 1895; Genot & Brogliato 1999). A contact that slides with friction has the
// normal acceleration
//
//   n . a = A f_n + B,   A = n^T J M^-1 J^T (n - mu t),
//
// J = Jacobian of the velocity of A relative to B at the contact point. If A < 0, the force grows the faster
// the deeper the bodies press: rigid bodies have no motion with contact (B < 0), or more than one (B > 0).
// The compliant law has exactly one motion, in which the contact jams within about sqrt(m/k) and the bodies
// leap; it depends on the stiffness.

#include <cstdio>
#include <liecheck/algorithms/aba.hpp>
#include <liecheck/scene/effects/effect.hpp>

namespace liecheck::scene {

class PainleveTest {
 public:
  explicit PainleveTest(const Model<double>& model)
      : model_(model), data_(model, model.has_mimics ? Dense::Mass : Dense::None) {
    model_.gravity.setZero();
    zero_ = VectorX<double>::Zero(model.nv);
    f_.assign(std::size_t(model.njoints), Force<double>::Zero());
  }
  /// Names a contact that slides with A < 0 at a state with velocities, or "".
  std::string notice(const Now<double>& now, const Effects<double>& effects) {
    for (const auto& effect : effects)
      for (const Sliding<double>& s : effect->sliding(now))
        if (const double A = slope(now, s); A < 0) return describe(now, s, A);
    return "";
  }

 private:
  using V3 = Vector3<double>;
  /// A [1/kg].
  double slope(const Now<double>& now, const Sliding<double>& s) {
    const VectorX<double> q = Eigen::Map<const VectorX<double>>(now.q.data(), Eigen::Index(now.q.size()));
    for (const auto& [joint, d] : {std::pair(s.joint_A, s.d), std::pair(s.joint_B, V3(-s.d))}) {
      const V3 f = now.X_WJ[joint].rotation().transpose() * d;
      f_[joint] = Force<double>(f, V3(now.X_WJ[joint].actInv(s.p).cross(f)));
    }
    f_[0] = Force<double>::Zero();
    const VectorX<double> a = aba<double>(model_, data_, q, zero_, zero_, f_);
    for (const std::size_t joint : {s.joint_A, s.joint_B}) f_[joint] = Force<double>::Zero();
    forwardKinematics<double>(model_, data_, q, a);  // J a is a velocity
    const auto rises = [&](std::size_t joint) {
      const Motion<double>& V = data_.v()[joint];
      return s.n.dot(now.X_WJ[joint].rotation() *
                     V3(V.linear() + V.angular().cross(now.X_WJ[joint].actInv(s.p))));
    };
    return rises(s.joint_A) - rises(s.joint_B);
  }
  std::string describe(const Now<double>& now, const Sliding<double>& s, double A) const {
    const auto name = [&](std::size_t joint) {
      return joint == 0 ? std::string("the world") : "joint '" + model_.names[joint] + "'";
    };
    char text[400];
    std::snprintf(text, sizeof text,
                  "Painleve's paradox at t = %.4g s: where the body of %s slides on %s at (%.4g, %.4g, %.4g) "
                  "m, a normal "
                  "force of 1 N accelerates the contact inwards with %.3g m/s^2. Rigid bodies would have no "
                  "motion there, "
                  "or several; the motion shown is that of this stiffness",
                  now.t, name(s.joint_A).c_str(), name(s.joint_B).c_str(), s.p[0], s.p[1], s.p[2], -A);
    return text;
  }

  Model<double> model_;
  Data<double> data_;
  VectorX<double> zero_;
  std::vector<Force<double>> f_;
};

}  // namespace liecheck::scene

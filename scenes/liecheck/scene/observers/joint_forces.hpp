#pragma once
// The generalised force of each effect at the coordinates of joints, and the force that each joint transmits.
//
//   tau_e = tau + sum_i J_i^T f_i                            of the forces of effect e alone
//   reaction_j = sum of (I_i a_i + v_i x* I_i v_i - f_i) over the bodies i that joint j carries
//
// The reaction is the force (f, n) that the parent exerts on the child, in the joint's axes at its origin. Its
// component along the motion of the joint is the sum of the generalised forces that act there, such as motor torques,
// minus the inertia of the motor (armature) times its acceleration. Featherstone (2008), table 5.1.

#include <liecheck/algorithms/rnea.hpp>
#include <liecheck/scene/effects/coordinates.hpp>
#include <liecheck/scene/observers/coordinate_names.hpp>
#include <liecheck/scene/observers/effect_forces.hpp>

namespace liecheck::scene {

inline const PartInfo joint_forces_info{
    "joint_forces",
    "tau_e of each effect,  reaction = sum (I a + v x* I v - f) of the bodies that the joint carries",
    "",
    "accelerations and the recursive Newton-Euler algorithm at samples",
    {{"joints", Kind::Joints, "", "all", "which joints"}}};

class JointForcesObserver final : public Observer {
 public:
  JointForcesObserver(const Parameters& p, const Watched& watched)
      : model_(*watched.model), weightless_(model_), data_(model_), forces_(watched) {
    weightless_.gravity.setZero(), weightless_.armature.setZero();
    const auto& names = p.names("joints");
    for (const Coordinate& c : coordinates(model_, names)) at_.push_back(c.v);
    for (std::size_t i = 1; i < model_.joints.size(); ++i)
      if (names[0] == "all" ? !std::holds_alternative<FreeFlyer<double>>(model_.joints[i])
                            : std::ranges::find(names, model_.names[i]) != names.end())
        joints_.push_back(i);
  }
  Kinematics needs() const override { return Kinematics::Accelerations; }
  std::vector<Column> columns() const override {
    std::vector<Column> all;
    const std::vector<VelocityName> coordinates = velocityNames(model_);
    for (std::size_t e = 0; e < forces_.size(); ++e)
      for (const int k : at_)
        all.push_back({"tau." + forces_.name(e) + "." + coordinates[std::size_t(k)].name,
                       coordinates[std::size_t(k)].angular ? "N m" : "N"});
    for (const std::size_t i : joints_)
      for (const char* part : {"fx", "fy", "fz", "nx", "ny", "nz"})
        all.push_back({"reaction." + model_.names[i] + "." + part, *part == 'f' ? "N" : "N m"});
    return all;
  }
  void sample(const Now<double>& now, std::span<double> row) override {
    using Vec = VectorX<double>;
    const auto vector = [](std::span<const double> x) {
      return Vec(Eigen::Map<const Vec>(x.data(), long(x.size())));
    };
    const Vec q = vector(now.q), v = vector(now.v), a = vector(now.a);
    std::vector<Force<double>> all(model_.inertias.size(), Force<double>::Zero());
    std::size_t at = 0;
    for (std::size_t e = 0; e < forces_.size(); ++e) {
      forces_.evaluate(e, now);
      auto f = forces_.f();
      toJointAxes(now, f);
      const Vec against = computeStaticTorque<double>(weightless_, data_, q, f);  // -sum J^T f
      for (const int k : at_) row[at++] = forces_.tau()[std::size_t(k)] - against[k];
      for (std::size_t i = 0; i < all.size(); ++i) all[i] = all[i] + f[i];
    }
    rnea<double>(weightless_, data_, q, v, a, all);
    for (const std::size_t i : joints_)
      for (int k = 0; k < 6; ++k) row[at++] = data_.f()[i].to_vector()[k];
  }

 private:
  const Model<double>& model_;
  Model<double> weightless_;  ///< gravity is one of the forces
  Data<double> data_;
  EffectForces forces_;
  std::vector<int> at_;
  std::vector<std::size_t> joints_;
};

}  // namespace liecheck::scene

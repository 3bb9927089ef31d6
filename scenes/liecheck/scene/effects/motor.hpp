#pragma once
// A motor with a gearbox of ratio N. It follows a command within its torque-speed curve.
//
//   command   c = force(t) + k (q_target - q) + d (v_target - v)
//   curve     tau_m = c, at most T (1 - v/v_0) in [0, T], at least -T (1 + v/v_0) in [-T, 0],
//             T = N stall_torque, v_0 = no_load_speed/N: the full torque brakes, and drives none above v_0
//   gearbox   tau = tau_m - (1 - efficiency) |tau_m| v / sqrt(v^2 + v_s^2)
//   rotor     M += diag(N^2 J), T += 1/2 N^2 J v^2 (Spong, Hutchinson & Vidyasagar 2006, sec. 7.1)
//
// All torques and speeds but those of the curve are at the joint. Friction that does not depend on the load is added
// by joint_friction and joint_damping.

#include <liecheck/scene/effects/pd_law.hpp>

namespace liecheck::scene {

inline const PartInfo motor_info{
    "motor",
    "tau += tau_m - (1 - eta) |tau_m| v/sqrt(v^2 + v_s^2), tau_m = a command within the torque-speed curve; "
    "M += diag(N^2 J)",
    "adds or removes; the gearbox dissipates (1 - eta) |tau_m v|; rotors: T += 1/2 N^2 J v^2",
    "a square root and comparisons for each coordinate",
    {{"joints", Kind::Joints, "", "all", "which joints"},
     {"ratio", Kind::Positive, "1", "1", "N: speed of the motor divided by that of the joint"},
     {"rotor_inertia", Kind::NotNegative, "kg m^2", "0", "J, of the rotor"},
     {"efficiency", Kind::Positive, "1", "1", "eta, of the gearbox, at most 1"},
     {"slip", Kind::Positive, "rad/s|m/s", "0.001", "v_s, at the joint"},
     {"stall_torque", Kind::Positive, "N m", "", "of the motor; without it, the torque has no limit"},
     {"no_load_speed", Kind::Positive, "rad/s", "",
      "of the motor; without it, the limit does not depend on speed"},
     {"force", Kind::Number, "N m|N", "0", "of the command, at the joint"},
     {"stiffness", Kind::NotNegative, "N m/rad|N/m", "0",
      "k; above 0 for joints with a scalar position only"},
     {"damping", Kind::NotNegative, "N m s/rad|N s/m", "0", "d"},
     {"target", Kind::Numbers, "rad|m", "",
      "q_target: one for all coordinates, or one for each; 0 if missing"},
     {"rows", Kind::Table, "rad|m", "",
      "q_target over time instead; v_target is its rate if it is cubic, else 0"},
     {"forces", Kind::Table, "N m|N", "",
      "force over time instead: one for all coordinates, or one for each"},
     interpolation_key}};

template <Scalar S>
class Motor final : public Effect<S> {
 public:
  Motor(const Parameters& p, const Model<S>& model, const Surroundings&)
      : at_(p.number("stiffness") > 0 ? positions(model, p.names("joints"))
                                      : coordinates(model, p.names("joints"))),
        law_(p, "motor", at_.size()),
        forces_(curveOf<S>(p, "forces")),
        force_(S(p.number("force"))),
        loss_(S(1) - S(p.number("efficiency"))),
        slip_(S(p.number("slip")) * S(p.number("slip"))),
        limited_(p.has("stall_torque")),
        slows_(p.has("no_load_speed")) {
    const S N(p.number("ratio"));
    rotor_ = N * N * S(p.number("rotor_inertia"));
    if (loss_ < S(0)) throw std::invalid_argument("motor.efficiency is above 1");
    if (slows_ && !limited_) throw std::invalid_argument("motor.no_load_speed needs 'stall_torque'");
    if (limited_) stall_ = N * S(p.number("stall_torque"));
    if (slows_) no_load_ = S(p.number("no_load_speed")) / N;
    if (forces_.width() > 1 && forces_.width() != at_.size())
      throw std::invalid_argument("motor has " + std::to_string(forces_.width()) + " forces for " +
                                  std::to_string(at_.size()) + " coordinates");
    if (forces_.width() && force_ != S(0))
      throw std::invalid_argument("motor has 'force' and 'forces': keep one");
  }
  Acts acts() const override { return Acts::OnJoints; }
  void prepare(Model<S>& model) const override {
    for (const Coordinate& c : at_) model.armature[c.v] += rotor_;
  }
  std::vector<S> events() const override {
    std::vector<S> all = law_.times();
    all.insert(all.end(), forces_.times().begin(), forces_.times().end());
    return all;
  }
  void add(const Now<S>& now, const Load<S>& load) const override {
    using std::sqrt;
    for (std::size_t i = 0; i < at_.size(); ++i) {
      const S& v = now.v[std::size_t(at_[i].v)];
      S tau = law_(now, i, at_[i].q < 0 ? S(0) : now.q[std::size_t(at_[i].q)], v);
      tau += forces_.width() ? forces_.at(now.t, now.piece, forces_.width() == 1 ? 0 : i).x : force_;
      if (limited_) {
        const S high = limit(now, v), low = -limit(now, S(-v));
        const bool above = now.on(S(tau - high)), below = now.on(S(low - tau));
        tau = above ? high : below ? low : tau;
      }
      if (loss_ > S(0)) tau -= loss_ * (now.on(tau) ? tau : S(-tau)) * v / S(sqrt(v * v + slip_));
      load.tau[std::size_t(at_[i].v)] += tau;
    }
  }

 private:
  /// The largest torque in the direction of the speed v.
  S limit(const Now<S>& now, const S& v) const {
    if (!slows_) return stall_;
    const bool drives = now.on(v), fast = now.on(S(v - no_load_));
    return fast ? S(0) : drives ? S(stall_ * (S(1) - v / no_load_)) : stall_;
  }
  std::vector<Coordinate> at_;
  PdLaw<S> law_;
  Curve<S> forces_;
  S force_, loss_, slip_, rotor_ = S(0), stall_ = S(0), no_load_ = S(0);
  bool limited_, slows_;
};

}  // namespace liecheck::scene

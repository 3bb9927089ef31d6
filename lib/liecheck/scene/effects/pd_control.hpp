#pragma once
// Proportional-derivative control towards a position.

#include <algorithm>
#include <liecheck/scene/effects/coordinates.hpp>

namespace liecheck::scene {

inline const PartInfo pd_control_info{
    "pd",
    "tau += clamp(k (q_target - q) - d v, +- effort limit of the robot)",
    "adds or removes",
    "two products for each coordinate",
    {{"joints", Kind::Joints, "", "all", "which of the joints with a scalar position"},
     {"stiffness", Kind::NotNegative, "N m/rad|N/m", nullptr, "k"},
     {"damping", Kind::NotNegative, "N m s/rad|N s/m", nullptr, "d"},
     {"target", Kind::Numbers, "rad|m", "[0]", "q_target: one for all coordinates, or one for each"}}};

template <Scalar S>
class PdControl final : public Effect<S> {
 public:
  PdControl(const Parameters& p, const Model<S>& model, const Surroundings&)
      : at_(positions(model, p.names("joints"))), k_(S(p.number("stiffness"))), d_(S(p.number("damping"))) {
    const auto& target = p.numbers("target");
    if (target.size() != 1 && target.size() != at_.size())
      throw std::invalid_argument("pd has " + std::to_string(target.size()) + " targets for " +
                                  std::to_string(at_.size()) + " coordinates");
    for (std::size_t i = 0; i < at_.size(); ++i)
      target_.push_back(S(target[target.size() == 1 ? 0 : i])), limit_.push_back(model.effortLimit[at_[i].v]);
  }
  Acts acts() const override { return Acts::OnJoints; }
  void add(const Now<S>& now, const Load<S>& load) const override {
    for (std::size_t i = 0; i < at_.size(); ++i) {
      const std::size_t k = std::size_t(at_[i].v);
      const S tau = k_ * (target_[i] - now.q[std::size_t(at_[i].q)]) - d_ * now.v[k];
      if (finite<S>(limit_[i])) {
        const bool above = now.on(S(tau - limit_[i])), below = now.on(S(-limit_[i] - tau));
        load.tau[k] += above ? limit_[i] : below ? S(-limit_[i]) : tau;
      } else {
        load.tau[k] += tau;
      }
    }
  }

 private:
  std::vector<Coordinate> at_;
  S k_, d_;
  std::vector<S> target_, limit_;
};

}  // namespace liecheck::scene

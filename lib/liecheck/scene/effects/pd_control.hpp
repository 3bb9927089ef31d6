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
      : k_(S(p.number("stiffness"))), d_(S(p.number("damping"))) {
    const auto at = positions(model, p.names("joints"));
    const auto& target = p.numbers("target");
    if (target.size() != 1 && target.size() != at.size())
      throw std::invalid_argument("pd has " + std::to_string(target.size()) + " targets for " +
                                  std::to_string(at.size()) + " coordinates");
    for (std::size_t i = 0; i < at.size(); ++i)
      terms_.push_back({at[i], S(target[target.size() == 1 ? 0 : i]), model.effortLimit[at[i].v]});
    const auto free = std::stable_partition(terms_.begin(), terms_.end(),
                                            [](const Term& j) { return finite<S>(j.limit); });
    limited_ = std::size_t(free - terms_.begin());
  }
  Acts acts() const override { return Acts::OnJoints; }
  void add(const Now<S>& now, const Load<S>& load) const override {
    const auto within = now.next(limited_);
    // Copies in registers, since a store to tau could change what the members and spans refer to.
    const S k = k_, d = d_, *q = now.q.data(), *v = now.v.data();
    S* const tau = load.tau.data();
    const Term* j = terms_.data();
    const std::size_t limited = limited_, all = terms_.size();
    for (std::size_t n = 0; n < limited; ++n, ++j) {
      const S wanted = k * (j->target - q[j->at.q]) - d * v[j->at.v];
      if (within(n, S(j->limit - absolute<S>(wanted)))) [[likely]]
        tau[j->at.v] += wanted;
      else
        tau[j->at.v] += wanted > S(0) ? j->limit : S(-j->limit);
    }
    for (std::size_t n = limited; n < all; ++n, ++j)
      tau[j->at.v] += k * (j->target - q[j->at.q]) - d * v[j->at.v];
  }

 private:
  struct Term {
    Coordinate at;
    S target, limit;
  };
  std::vector<Term> terms_;  ///< those with a limit first
  std::size_t limited_ = 0;
  S k_, d_;
};

}  // namespace liecheck::scene

#pragma once
// Proportional-derivative control towards a position or along a trajectory (pd_law.hpp).

#include <liecheck/scene/effects/pd_law.hpp>

namespace liecheck::scene {

inline const PartInfo pd_control_info{
    "pd",
    "tau += clamp(k (q_target - q) + d (v_target - v), +- effort limit of the robot)",
    "adds or removes",
    "two products for each coordinate; a search in the table if there is one",
    {{"joints", Kind::Joints, "", "all", "which of the joints with a scalar position"},
     {"stiffness", Kind::NotNegative, "N m/rad|N/m", nullptr, "k"},
     {"damping", Kind::NotNegative, "N m s/rad|N s/m", nullptr, "d"},
     {"target", Kind::Numbers, "rad|m", "",
      "q_target: one for all coordinates, or one for each; 0 if missing"},
     {"rows", Kind::Table, "rad|m", "",
      "q_target over time instead; v_target is its rate if it is cubic, else 0"},
     interpolation_key}};

template <Scalar S>
class PdControl final : public Effect<S> {
 public:
  PdControl(const Parameters& p, const Model<S>& model, const Surroundings&)
      : law_(p, "pd", positions(model, p.names("joints")).size()) {
    for (const Coordinate& c : positions(model, p.names("joints")))
      terms_.push_back(
          {c, terms_.size(), law_.constant() ? law_.target(terms_.size()) : S(0), model.effortLimit[c.v]});
    const auto free =
        std::stable_partition(terms_.begin(), terms_.end(), [](const Term& j) { return finite<S>(j.limit); });
    limited_ = std::size_t(free - terms_.begin());
  }
  Acts acts() const override { return Acts::OnJoints; }
  std::vector<S> events() const override { return law_.times(); }
  void add(const Now<S>& now, const Load<S>& load) const override {
    // Copies in registers, since a store to tau could change what the members and spans refer to.
    const S k = law_.stiffness(), d = law_.damping(), *q = now.q.data(), *v = now.v.data();
    if (law_.constant())
      addAll(now, load, [=](const Term& j) { return S(k * (j.target - q[j.at.q]) - d * v[j.at.v]); });
    else
      addAll(now, load, [&](const Term& j) { return law_(now, j.index, q[j.at.q], v[j.at.v]); });
  }

 private:
  struct Term {
    Coordinate at;
    std::size_t index;  ///< of its target
    S target, limit;    ///< target: if it is constant
  };
  template <class F>
  [[gnu::always_inline]] void addAll(const Now<S>& now, const Load<S>& load, F wanted) const {
    const auto within = now.next(limited_);
    S* const tau = load.tau.data();
    const Term* j = terms_.data();
    const std::size_t limited = limited_, all = terms_.size();
    for (std::size_t n = 0; n < limited; ++n, ++j) {
      const S x = wanted(*j);
      if (within(n, S(j->limit - absolute<S>(x)))) [[likely]]
        tau[j->at.v] += x;
      else
        tau[j->at.v] += x > S(0) ? j->limit : S(-j->limit);
    }
    for (std::size_t n = limited; n < all; ++n, ++j) tau[j->at.v] += wanted(*j);
  }

  PdLaw<S> law_;
  std::vector<Term> terms_;  ///< those with a limit first
  std::size_t limited_ = 0;
};

}  // namespace liecheck::scene

#pragma once
// Proportional-derivative law towards constant targets, or towards a trajectory given by a table.
//
//   tau = k (q_target - q) + d (v_target - v),   v_target = d q_target/dt of a cubic table, else 0

#include <liecheck/scene/effects/coordinates.hpp>
#include <liecheck/scene/effects/curve.hpp>

namespace liecheck::scene {

template <Scalar S>
class PdLaw {
 public:
  /// The law for `count` coordinates. Throws std::invalid_argument if the number of targets is another.
  PdLaw(const Parameters& p, const std::string& who, std::size_t count)
      : k_(S(p.number("stiffness"))),
        d_(S(p.number("damping"))),
        curve_(curveOf<S>(p, "rows")),
        feeds_(p.has("rows") && p.word("interpolation") == "cubic") {
    if (p.has("target") && p.has("rows"))
      throw std::invalid_argument(who + " has 'target' and 'rows': keep one");
    const std::vector<double> targets = p.has("target") ? p.numbers("target") : std::vector<double>{0};
    const std::size_t given = curve_.width() ? curve_.width() : targets.size();
    if (given != 1 && given != count)
      throw std::invalid_argument(who + " has " + std::to_string(given) + " targets for " +
                                  std::to_string(count) + " coordinates");
    one_ = given == 1;
    for (const double x : targets) target_.push_back(S(x));
  }
  const std::vector<S>& times() const { return curve_.times(); }

  bool constant() const { return curve_.width() == 0; }
  const S& stiffness() const { return k_; }
  const S& damping() const { return d_; }
  /// The constant target of coordinate i.
  const S& target(std::size_t i) const { return target_[one_ ? 0 : i]; }

  /// tau of coordinate i of the law at (q, v).
  S operator()(const Now<S>& now, std::size_t i, const S& q, const S& v) const {
    const std::size_t k = one_ ? 0 : i;
    if (curve_.width() == 0) return k_ * (target_[k] - q) - d_ * v;
    const auto [x, rate] = curve_.at(now.t, now.piece, k);
    return feeds_ ? S(k_ * (x - q) + d_ * (rate - v)) : S(k_ * (x - q) - d_ * v);
  }

 private:
  S k_, d_;
  Curve<S> curve_;
  bool feeds_, one_ = true;
  std::vector<S> target_;
};

}  // namespace liecheck::scene

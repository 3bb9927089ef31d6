#pragma once
// A force given by a table over time, interpolated linearly. Outside the table it is constant.

#include <algorithm>
#include <liecheck/scene/effects/coordinates.hpp>

namespace liecheck::scene {

inline const PartInfo force_table_info{
    "table",
    "tau += tau_i + (t - t_i)/(t_(i+1) - t_i) (tau_(i+1) - tau_i)",
    "adds or removes: power tau(t) v",
    "a search in the table",
    {{"joints", Kind::Joints, "", "all", "joints with this force"},
     {"times", Kind::Times, "s", nullptr, "t_i, increasing"},
     {"forces", Kind::Numbers, "N m|N", nullptr,
      "tau_i; before the first time and after the last one, the force is constant"}}};

template <Scalar S>
class ForceTable final : public Effect<S> {
 public:
  ForceTable(const Parameters& p, const Model<S>& model, const Surroundings&)
      : at_(coordinates(model, p.names("joints"))) {
    for (const double t : p.numbers("times")) times_.push_back(S(t));
    for (const double f : p.numbers("forces")) forces_.push_back(S(f));
    if (times_.size() != forces_.size())
      throw std::invalid_argument("a table of " + std::to_string(times_.size()) + " times and " +
                                  std::to_string(forces_.size()) + " forces: give one force for each time");
  }
  Acts acts() const override { return Acts::OnJoints; }
  std::vector<S> events() const override { return times_; }
  void add(const Now<S>& now, const Load<S>& load) const override {
    const S force = at(now.t, now.piece);
    for (const Coordinate& c : at_) load.tau[std::size_t(c.v)] += force;
  }

 private:
  /// The force at t by the line of the interval that holds `piece`.
  S at(const S& t, const S& piece) const {
    const auto after = std::upper_bound(times_.begin(), times_.end(), piece);
    if (after == times_.begin()) return forces_.front();
    if (after == times_.end()) return forces_.back();
    const std::size_t i = std::size_t(after - times_.begin());
    return forces_[i - 1] + (t - times_[i - 1]) / (times_[i] - times_[i - 1]) * (forces_[i] - forces_[i - 1]);
  }
  std::vector<Coordinate> at_;
  std::vector<S> times_, forces_;
};

}  // namespace liecheck::scene

#pragma once
// Kinetic, potential and total energy.

#include <liecheck/scene/observers/observer.hpp>

namespace liecheck::scene {

inline const PartInfo energy_info{
    "energy",
    "T = 1/2 sum V^T I V + 1/2 armature v^2,  V = sum of the potentials of effects",
    "",
    "poses and velocities at samples",
    {}};

/// T [J] of a state with velocities.
inline double kineticEnergy(const Model<double>& model, const Now<double>& now) {
  double energy = 0;
  for (std::size_t i = 1; i < model.inertias.size(); ++i) energy += model.inertias[i].kineticEnergy(now.V[i]);
  for (int k = 0; k < model.nv; ++k)
    energy += model.armature[k] * now.v[std::size_t(k)] * now.v[std::size_t(k)] / 2;
  return energy;
}

class EnergyObserver final : public Observer {
 public:
  EnergyObserver(const Parameters&, const Watched& watched) : watched_(watched) {}
  Kinematics needs() const override { return Kinematics::Velocities; }
  std::vector<Column> columns() const override {
    return {{"kinetic", "J"}, {"potential", "J"}, {"energy", "J"}};
  }
  void sample(const Now<double>& now, std::span<double> row) override {
    row[0] = kineticEnergy(*watched_.model, now);
    row[1] = 0;
    for (const auto& e : *watched_.effects) row[1] += e->potential(now);
    row[2] = row[0] + row[1];
    if (!first_) first_ = row[2];
    last_ = row[2], largest_ = std::max(largest_, std::abs(row[2] - *first_));
    ++count_;
    // sums for a least-squares line through E(t), relative to the first sample
    const double t = now.t, e = row[2] - *first_;
    t_ += t, e_ += e, tt_ += t * t, te_ += t * e;
  }
  std::vector<Figure> figures() const override {
    const double n = count_, spread = n * tt_ - t_ * t_;
    return {
        {"energy at the start", "J", first_},
        {"largest change of energy", "J", largest_},
        {"slope of energy", "W", spread > 0 ? std::optional((n * te_ - t_ * e_) / spread) : std::nullopt}};
  }

 private:
  Watched watched_;
  std::optional<double> first_;
  double last_ = 0, largest_ = 0, t_ = 0, e_ = 0, tt_ = 0, te_ = 0;
  long count_ = 0;
};

}  // namespace liecheck::scene

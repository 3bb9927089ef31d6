#pragma once
// The drift of closed loops: the gaps of their pairs of frames and the rates of these gaps.

#include <liecheck/scene/observers/observer.hpp>
#include <liecheck/scene/scene.hpp>

namespace liecheck::scene {

inline const PartInfo loop_gaps_info{
    "loop_gaps",
    "max over pairs of |p_A - p_B|, |d/dt (p_A - p_B)| and |log(R_A R_B^T)| of welds",
    "",
    "poses and velocities at samples",
    {}};

class LoopGapsObserver final : public Observer {
 public:
  LoopGapsObserver(const Parameters&, const Watched& watched) {
    for (const Request& r : watched.scene->effects)
      if (r.name == "closed_loops")
        for (const auto& [a, b] : pairsOf(r.parameters, *watched.model))
          pairs_.push_back({a, b, r.parameters.word("type") == "weld"});
    if (pairs_.empty()) throw std::invalid_argument("loop_gaps needs the effect 'closed_loops' in the scene");
  }
  Kinematics needs() const override { return Kinematics::Velocities; }
  std::vector<Column> columns() const override {
    return {{"loop_gap", "m"}, {"loop_gap_rate", "m/s"}, {"loop_angle", "rad"}};
  }
  void sample(const Now<double>& now, std::span<double> row) override {
    std::ranges::fill(row, 0.0);
    for (const Pair& p : pairs_) {
      const Gap<double> gap(now, p.a, p.b);
      row[0] = std::max(row[0], gap.r.head<3>().norm());
      row[1] = std::max(row[1], gap.rate.head<3>().norm());
      if (p.weld) row[2] = std::max(row[2], gap.r.tail<3>().norm());
    }
    for (std::size_t k = 0; k < 3; ++k) largest_[k] = std::max(largest_[k], row[k]);
  }
  std::vector<Figure> figures() const override {
    std::vector<Figure> all = {{"largest gap of a loop", "m", largest_[0]},
                               {"largest rate of a gap", "m/s", largest_[1]}};
    if (std::ranges::any_of(pairs_, &Pair::weld))
      all.push_back({"largest angle of a weld", "rad", largest_[2]});
    return all;
  }

 private:
  struct Pair {
    Spot<double> a, b;
    bool weld;
  };
  std::vector<Pair> pairs_;
  std::array<double, 3> largest_{};
};

}  // namespace liecheck::scene

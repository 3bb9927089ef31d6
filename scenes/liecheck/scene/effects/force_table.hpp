#pragma once
// Forces given by a table over time (curve.hpp). Outside the table they are constant.

#include <liecheck/scene/effects/coordinates.hpp>
#include <liecheck/scene/effects/curve.hpp>

namespace liecheck::scene {

inline const PartInfo force_table_info{
    "table",
    "tau += tau_i + (t - t_i)/(t_(i+1) - t_i) (tau_(i+1) - tau_i), or a cubic",
    "adds or removes: power tau(t) v",
    "a search in the table",
    {{"joints", Kind::Joints, "", "all", "joints with this force"},
     {"times", Kind::Times, "s", "", "t_i, in order; a time twice is a jump"},
     {"forces", Kind::Numbers, "N m|N", "",
      "tau_i; before the first time and after the last one, the force is constant"},
     {"rows", Kind::Table, "N m|N", "",
      "instead of times and forces: one force for all coordinates, or one for each"},
     interpolation_key}};

template <Scalar S>
class ForceTable final : public Effect<S> {
 public:
  ForceTable(const Parameters& p, const Model<S>& model, const Surroundings&)
      : at_(coordinates(model, p.names("joints"))), curve_(curve(p)) {
    if (curve_.width() != 1 && curve_.width() != at_.size())
      throw std::invalid_argument("a table with " + std::to_string(curve_.width()) + " forces for " +
                                  std::to_string(at_.size()) + " coordinates");
  }
  Acts acts() const override { return Acts::OnJoints; }
  std::vector<S> events() const override { return curve_.times(); }
  void add(const Now<S>& now, const Load<S>& load) const override {
    for (std::size_t i = 0; i < at_.size(); ++i)
      load.tau[std::size_t(at_[i].v)] += curve_.at(now.t, now.piece, curve_.width() == 1 ? 0 : i).x;
  }

 private:
  static Curve<S> curve(const Parameters& p) {
    const bool rows = p.has("rows");
    if (rows ? p.has("times") || p.has("forces") : !p.has("times") || !p.has("forces"))
      throw std::invalid_argument("a table needs 'rows', or 'times' and 'forces'");
    if (rows) return curveOf<S>(p, "rows");
    const auto &times = p.numbers("times"), &forces = p.numbers("forces");
    if (times.size() != forces.size())
      throw std::invalid_argument("a table of " + std::to_string(times.size()) + " times and " +
                                  std::to_string(forces.size()) + " forces: give one force for each time");
    Value table{{}, {}, 2};
    for (std::size_t i = 0; i < times.size(); ++i)
      table.numbers.push_back(times[i]), table.numbers.push_back(forces[i]);
    return {table, p.has("interpolation") && p.word("interpolation") == "cubic"};
  }
  std::vector<Coordinate> at_;
  Curve<S> curve_;
};

}  // namespace liecheck::scene

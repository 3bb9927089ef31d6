#pragma once
// A force and a moment at a frame's origin in a time interval: a constant, and a table over time (curve.hpp).

#include <liecheck/scene/effects/coordinates.hpp>
#include <liecheck/scene/effects/curve.hpp>

namespace liecheck::scene {

inline const PartInfo wrench_info{
    "wrench",
    "(f, n) at the frame's origin, from <= t < until",
    "adds or removes: power f . u + n . omega",
    "a force on one body; poses if axes is world",
    {{"frame", Kind::Frame, "", nullptr, "where it acts"},
     {"force", Kind::Vector, "N", "[0, 0, 0]", "f"},
     {"moment", Kind::Vector, "N m", "[0, 0, 0]", "n about the frame's origin"},
     {"rows", Kind::Table, "N|N m", "",
      "f over time, or (f, n): 3 or 6 numbers, which are added to force and moment"},
     interpolation_key,
     {"axes", Kind::Choice, "frame|world", "frame", "the axes of f and n"},
     {"from", Kind::Number, "s", "", "start time; without it, the force acts from the beginning"},
     {"until", Kind::Number, "s", "", "end time; without it, the force never ends"}}};

template <Scalar S>
class Wrench final : public Effect<S> {
 public:
  Wrench(const Parameters& p, const Model<S>& model, const Surroundings&)
      : spot_(model, p.word("frame")),
        f_(vectorOf<S>(p.numbers("force"))),
        n_(vectorOf<S>(p.numbers("moment"))),
        curve_(curveOf<S>(p, "rows")),
        world_(p.word("axes") == "world"),
        from_(p.number("from", -std::numeric_limits<double>::infinity())),
        until_(p.number("until", std::numeric_limits<double>::infinity())) {
    if (!(from_ < until_)) throw std::invalid_argument("the wrench's 'until' is not after its 'from'");
    if (curve_.width() != 0 && curve_.width() != 3 && curve_.width() != 6)
      throw std::invalid_argument("a row of the wrench has a time and " + std::to_string(curve_.width()) +
                                  " numbers: give 3 of a force, or 6 of a force and a moment");
  }
  Acts acts() const override { return Acts::OnBodies; }
  Kinematics needs() const override { return Kinematics::Poses; }
  std::vector<S> events() const override {
    std::vector<S> all = curve_.times();
    all.push_back(S(from_)), all.push_back(S(until_));
    return all;
  }
  void add(const Now<S>& now, const Load<S>& load) const override {
    if (now.piece < S(from_) || !(now.piece < S(until_))) return;
    Vector3<S> f = f_, n = n_;
    for (std::size_t k = 0; k < curve_.width(); ++k)
      (k < 3 ? f : n)[int(k % 3)] += curve_.at(now.t, now.piece, k).x;
    if (world_)
      spot_.addWorld(now, load, f, n);
    else
      spot_.add(now, load, Force<S>(f, n));
  }
  bool addConstant(const Vector3<S>& centre, BodyTerms<S>& terms) const override {
    if (finite<S>(S(from_)) || finite<S>(S(until_)) || curve_.width() > 0) return false;
    if (!world_) return spot_.addConstant(centre, Force<S>(f_, n_), terms);
    if (!n_.isZero(S(0)) || spot_.X_JF.translation() != centre) return false;
    terms.force_W += f_;
    return true;
  }

 private:
  Spot<S> spot_;
  Vector3<S> f_, n_;
  Curve<S> curve_;
  bool world_;
  double from_, until_;
};

}  // namespace liecheck::scene

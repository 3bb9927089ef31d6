#pragma once
// A thruster: a force along a direction fixed in its frame, and the reaction moment of its propeller.

#include <liecheck/scene/effects/coordinates.hpp>

namespace liecheck::scene {

inline const PartInfo thruster_info{
    "thruster",
    "f = T e,  n = k T e,  from <= t < until",
    "adds: power T (e . u + k e . omega)",
    "a force on one body",
    {{"frame", Kind::Frame, "", nullptr, "where it is mounted"},
     {"thrust", Kind::Number, "N", nullptr, "T"},
     {"direction", Kind::Direction, "1", "[0, 0, 1]", "e, in the frame; any length but 0"},
     {"moment_ratio", Kind::Number, "m", "0", "k: moment divided by thrust, > 0 for a moment along e"},
     {"from", Kind::Number, "s", "", "start time; without it, the force acts from the beginning"},
     {"until", Kind::Number, "s", "", "end time; without it, the force never ends"}}};

template <Scalar S>
class Thruster final : public Effect<S> {
 public:
  Thruster(const Parameters& p, const Model<S>& model, const Surroundings&)
      : spot_(model, p.word("frame")),
        from_(p.number("from", -std::numeric_limits<double>::infinity())),
        until_(p.number("until", std::numeric_limits<double>::infinity())) {
    if (!(from_ < until_)) throw std::invalid_argument("the thruster's 'until' is not after its 'from'");
    const Vector3<S> e = Axis<S>(vectorOf<S>(p.numbers("direction"))).to_vector();
    const S thrust(p.number("thrust"));
    F_ = Force<S>(Vector3<S>(thrust * e), Vector3<S>(S(p.number("moment_ratio")) * thrust * e));
  }
  Acts acts() const override { return Acts::OnBodies; }
  Kinematics needs() const override { return Kinematics::Poses; }
  std::vector<S> events() const override { return {S(from_), S(until_)}; }
  void add(const Now<S>& now, const Load<S>& load) const override {
    if (!(now.piece < S(from_)) && now.piece < S(until_)) spot_.add(now, load, F_);
  }
  bool addConstant(const Vector3<S>& centre, BodyTerms<S>& terms) const override {
    return !finite<S>(S(from_)) && !finite<S>(S(until_)) && spot_.addConstant(centre, F_, terms);
  }

 private:
  Spot<S> spot_;
  Force<S> F_;
  double from_, until_;
};

}  // namespace liecheck::scene

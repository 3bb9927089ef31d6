#pragma once
// A force and a moment at a frame's origin, constant in a time interval.

#include <liecheck/scene/effects/coordinates.hpp>

namespace liecheck::scene {

inline const PartInfo wrench_info{
    "wrench",
    "(f, n) at the frame's origin, from <= t < until",
    "adds or removes: power f . u + n . omega",
    "a force on one body; poses if axes is world",
    {{"frame", Kind::Frame, "", nullptr, "where it acts"},
     {"force", Kind::Vector, "N", "[0, 0, 0]", "f"},
     {"moment", Kind::Vector, "N m", "[0, 0, 0]", "n about the frame's origin"},
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
        world_(p.word("axes") == "world"),
        from_(p.number("from", -std::numeric_limits<double>::infinity())),
        until_(p.number("until", std::numeric_limits<double>::infinity())) {
    if (!(from_ < until_)) throw std::invalid_argument("the wrench's 'until' is not after its 'from'");
  }
  Acts acts() const override { return Acts::OnBodies; }
  Kinematics needs() const override { return Kinematics::Poses; }
  std::vector<S> events() const override { return {S(from_), S(until_)}; }
  void add(const Now<S>& now, const Load<S>& load) const override {
    if (now.piece < S(from_) || !(now.piece < S(until_))) return;
    if (world_)
      spot_.addWorld(now, load, f_, n_);
    else
      spot_.add(now, load, Force<S>(f_, n_));
  }
  bool addConstant(const Vector3<S>& centre, BodyTerms<S>& terms) const override {
    if (finite<S>(S(from_)) || finite<S>(S(until_))) return false;
    if (!world_) return spot_.addConstant(centre, Force<S>(f_, n_), terms);
    if (!n_.isZero(S(0)) || spot_.X_JF.translation() != centre) return false;
    terms.force_W += f_;
    return true;
  }

 private:
  Spot<S> spot_;
  Vector3<S> f_, n_;
  bool world_;
  double from_, until_;
};

}  // namespace liecheck::scene

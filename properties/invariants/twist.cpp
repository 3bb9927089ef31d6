// The angle by which a rotation turns about a given axis is compared with the exact one of the stored numbers.

#include <generators/rotations.hpp>
#include <invariants/common.hpp>
#include <operations/argument_kinds.hpp>
#include <oracles/orientations.hpp>

namespace liecheck::properties {
namespace {

class Twist final : public SlowLaw<Twist> {
 public:
  static constexpr const auto& measured = op::twist_angle;
  static constexpr Statement stated{
      .name = "twist",
      .law = "the twist of a rotation about an axis has the angle 2 atan2(v . axis, w)",
      .equation = "Q = swing twist, twist = (axis sin(angle/2), cos(angle/2)), |angle| <= pi",
      .source = "Dobrowolski 2015, eq. 18",
      .outputs = {measured[block::angle]},
      .fields = {{"Q", Kind::quaternion, 4, "1"}, {"axis", Kind::direction, 3, "1"}}};

  /// Often a turn about the axis itself, as of a joint.
  template <class S>
  std::vector<S> draw(Source& source) const {
    const auto Q = unit_quaternion<S>(source);
    Vec<S, 3> axis = direction<S>(source);
    using std::sqrt;
    const S n = Q.template head<3>().norm();
    if (source.chance(1, 4) && n > S(sqrt(std::numeric_limits<S>::min()))) axis = Q.template head<3>() / n;
    return Joined<S>{Q, taken<S>(source, axis)};
  }
  std::string draw_for(const Subject& subject) override {
    taken_ = subject.takes.axes;
    return text_of(axis_kinds, "axes", taken_);
  }
  std::vector<Field> fields() const override {
    std::vector<Field> all = SlowLaw::fields();
    if (!(taken_ & 7)) all.back().without = 1;
    if (!(taken_ & 8)) all.back().without = ~1u;
    return all;
  }
  bool valid(const std::vector<double>& input) const override {
    return Property::valid(input) && (input[4] != 0 || input[5] != 0 || input[6] != 0);
  }
  void in(const Subject& subject, const std::vector<double>& input, Recorder& r) const {
    if (!subject.operations[measured]) return;
    constexpr Output angle = measured[block::angle];
    Reader read(input);
    const Vec<double, 4> Q = read.take<4>();
    const Vec<double, 3> axis = read.take<3>();
    const oracles::TwistAngle exact =
        oracles::twist_angle(oracles::exact_vector<4>(Q), oracles::exact_vector<3>(axis));
    const Vec<double, 1> computed(subject.operations[measured](Q, axis));
    if (!exact.determined && oracles::all_finite(computed)) return r.outcome(angle, 0, Outcome::ill_posed);
    judged_value(r, {angle}, 0, computed, exact.resolved, [&] {
      const Real got = oracles::exact<Real>(computed[0]);
      // Within 8 eps of pi, rounding may choose the other sign. The range of ordinary code is a choice.
      const bool either = exact.pi_minus_angle <= Real(8 * scalar().epsilon) || r.ordinary(angle);
      const Real turn = 2 * (abs(exact.angle) + exact.pi_minus_angle),
                 other = exact.angle < 0 ? Real(exact.angle + turn) : Real(exact.angle - turn);
      const double error = oracles::scalar_error(r.scalar(), got, exact.angle, exact.scale),
                   beyond = oracles::scalar_error(r.scalar(), got, other, exact.scale);
      if (!either && beyond < 64 && error > 1e3) return r.outcome(angle, 0, Outcome::wrong_branch);
      r.record(angle, 0, either ? std::min(error, beyond) : error);
    });
  }

 private:
  std::uint32_t taken_ = axis_kinds.every();

  /// The axis, or one that the subject takes.
  template <class S>
  Vec<S, 3> taken(Source& source, const Vec<S, 3>& axis) const {
    const std::array drawn{double(axis[0]), double(axis[1]), double(axis[2])};
    if (taken_ >> axis_kinds.kind(drawn) & 1) return axis;
    std::vector<Vec<S, 3>> others;
    for (int k = 0; k < axis_kinds.count; ++k)
      if (taken_ >> k & 1) {
        const std::vector<double> x = axis_kinds.example(k);
        others.push_back(Vec<S, 3>(S(x[0]), S(x[1]), S(x[2])));
      }
    return others[source.below(others.size())];
  }
};

const RegisteredProperty<Twist> registered_twist;

}  // namespace
}  // namespace liecheck::properties

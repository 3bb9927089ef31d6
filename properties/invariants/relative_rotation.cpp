// The relative angle and the interpolation of two rotations are compared with the exact functions of the stored
// quaternions.

#include <generators/rotations.hpp>
#include <invariants/branch.hpp>
#include <operations/argument_kinds.hpp>
#include <oracles/orientations.hpp>

namespace liecheck::properties {
namespace {

class RelativeRotation final : public SlowLaw<RelativeRotation> {
 public:
  static constexpr Statement stated{
      .name = "relative_rotation",
      .law =
          "two rotations have one relative angle in [0, pi], and slerp divides the shorter arc between them",
      .equation = "theta = |log(Q0* Q1)|; slerp(Q0, Q1, t) = Q0 exp(t log(Q0* Q1))",
      .source = "Shoemake 1985, section 3.3; Sola 2017 (arXiv 1711.02508), eq. 78",
      .outputs = {op::relative_angle[block::angle], op::slerp[block::rotation],
                  op::slerp[block::norm_defect]},
      .fields = {{"Q0", Kind::quaternion, 4, "1"},
                 {"Q1", Kind::quaternion, 4, "1", Reach::beside},
                 {"t", Kind::fraction, 1, "1"}}};

  template <class S>
  std::vector<S> draw(Source& source) const {
    const auto Q0 = unit_quaternion<S>(source), Q1 = quaternion_near<S>(source, Q0);
    std::vector<S> x = Joined<S>{Q0, Q1};
    x.push_back(taken(source, fraction_up_to_1<S>(source)));
    return x;
  }
  std::string draw_for(const Subject& subject) override {
    taken_ = subject.takes.fractions;
    return text_of(fraction_kinds, "fractions", taken_);
  }
  std::vector<Field> fields() const override {
    std::vector<Field> all = SlowLaw::fields();
    const auto lacks = [&](int kind) { return ~taken_ >> kind & 1; };
    all.back().without = lacks(0) | lacks(2) << 1 | lacks(1) << 2 | (lacks(3) ? 7u << 3 : 0);
    return all;
  }

  void in(const Subject& subject, const std::vector<double>& input, Recorder& r) const {
    const auto& o = subject.operations;
    Reader read(input);
    const Vec<double, 4> Q0 = read.take<4>(), Q1 = read.take<4>();
    const double t = read.take<1>()[0];
    const auto a = oracles::exact_vector<4>(Q0), b = oracles::exact_vector<4>(Q1);
    const oracles::RelativeAngle exact = oracles::relative_angle(a, b);
    const std::size_t band = exact.pi_minus_theta < Real(1e-40) ? Bands::of(r.scalar()).at_pi()
                                                                : Bands::of(r.scalar()).classify(exact.theta);
    if (o[op::relative_angle]) {
      constexpr Output angle = op::relative_angle[block::angle];
      const Vec<double, 1> computed(o[op::relative_angle](Q0, Q1));
      judged_value(r, {angle}, band, computed, exact.resolved, [&] {
        const Real allowed = r.ordinary(angle) ? cost_of_defects(r.scalar(), a, b) : Real(0);
        r.record(
            angle, band,
            oracles::scalar_error(r.scalar(), nearer(oracles::exact<Real>(computed[0]), exact.theta, allowed),
                                  exact.theta, exact.terms));
      });
    }
    if (o[op::slerp])
      record_slerp(r, band, o[op::slerp](Q0, Q1, t), oracles::slerp(a, b, oracles::exact<Real>(t)));
  }

 private:
  std::uint32_t taken_ = fraction_kinds.every();

  /// t, or one that the subject takes.
  template <class S>
  S taken(Source& source, const S& t) const {
    const double drawn = static_cast<double>(t);
    if (taken_ >> fraction_kinds.kind({&drawn, 1}) & 1) return t;
    std::vector<S> others;
    for (int k = 0; k < fraction_kinds.count; ++k)
      if (taken_ >> k & 1) others.push_back(static_cast<S>(fraction_kinds.example(k)[0]));
    return others[source.below(others.size())];
  }
  static void record_slerp(Recorder& r, std::size_t band, const Vec<double, 4>& computed,
                           const oracles::Slerp& exact) {
    constexpr Output rotation = op::slerp[block::rotation], defect = op::slerp[block::norm_defect];
    judged_value(r, {rotation, defect}, band, computed, exact.resolved, [&] {
      const auto Q = oracles::exact_vector<4>(computed);
      double error = oracles::rotation_error(r.scalar(), Q, exact.Q);
      // Within 4 eps of pi, the rounding of Q0* Q1 may choose the other arc.
      const double other = oracles::rotation_error(r.scalar(), Q, exact.other);
      if (exact.pi_minus_theta <= Real(4 * r.scalar().epsilon)) error = std::min(error, other);
      if (error > 1e3 && other < 64)
        r.outcome(rotation, band, Outcome::wrong_branch);
      else
        r.record(rotation, band, error);
      r.record(defect, band, oracles::norm_defect(r.scalar(), Q));
    });
  }
};

const RegisteredProperty<RelativeRotation> registered_relative_rotation;

}  // namespace
}  // namespace liecheck::properties

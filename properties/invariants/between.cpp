// What lies between two poses, and between two directions.

#include <generators/rotations.hpp>
#include <invariants/common.hpp>
#include <oracles/means.hpp>

namespace liecheck::properties {
namespace {

class Interpolation final : public SlowLaw<Interpolation> {
 public:
  static constexpr Output rotation = op::interpolate[block::rotation],
                          translation = op::interpolate[block::translation],
                          defect = op::interpolate[block::norm_defect];
  static constexpr Statement stated{.name = "interpolation",
                                    .law = "between two poses lies the screw motion from one to the other",
                                    .equation = "T(t) = T0 exp(t log(T0^-1 T1)), 0 <= t <= 1",
                                    .source = "Sola, Deray & Atchuthan 2018, eqs. 25-28",
                                    .outputs = {rotation, translation, defect},
                                    .fields = {{"p0", Kind::vector, 3, "m"},
                                               {"Q0", Kind::quaternion, 4, "1"},
                                               {"p1", Kind::vector, 3, "m"},
                                               {"Q1", Kind::quaternion, 4, "1", Reach::beside},
                                               {"t", Kind::fraction, 1, "1"}}};

  template <class S>
  std::vector<S> draw(Source& source) const {
    const int binades = std::numeric_limits<S>::max_exponent / 8;
    const auto p0 = vector3<S>(source, binades);
    const auto Q0 = unit_quaternion<S>(source);
    const auto p1 = source.chance(1, 3) ? vector3<S>(source, binades) : beside<S>(source, p0);
    std::vector<S> x = Joined<S>{p0, Q0, p1, quaternion_near<S>(source, Q0)};
    x.push_back(fraction_up_to_1<S>(source));
    return x;
  }
  void in(const Subject& subject, const std::vector<double>& input, Recorder& r) const {
    if (!subject.operations[op::interpolate]) return;
    using namespace oracles;
    Reader read(input);
    const properties::Vec<double, 7> q0 = read.take<7>(), q1 = read.take<7>();
    const double t = read.take<1>()[0];
    const properties::Vec<double, 7> computed = subject.operations[op::interpolate](q0, q1, t);
    const Vec7<> a = exact_vector<7>(q0), b = exact_vector<7>(q1);
    const Interpolated exact = oracles::interpolate(a, b, oracles::exact<Real>(t));
    const std::size_t band = exact.pi_minus_theta < Real(1e-40)
                                 ? Bands::of(r.scalar()).at_pi()
                                 : Bands::of(r.scalar()).classify(Real(pi() - exact.pi_minus_theta));
    judged_value(r, {rotation, translation, defect}, band, computed, exact.resolved, [&] {
      const Quaternion<> Q = exact_vector<4>(computed.tail<4>());
      const Vec3<> p = exact_vector<3>(computed);
      const Real scale = larger(Real(norm(head3(a))), Real(norm(head3(b))));
      const auto errors = [&](const IntegrateResult& pose) {
        return std::pair(rotation_error(r.scalar(), Q, pose.Q), vector_error(r.scalar(), p, pose.p, scale));
      };
      auto error = errors(exact.pose);
      // Within 4 eps of pi, the rounding of Q0* Q1 may choose the other arc.
      if (exact.pi_minus_theta <= Real(4 * r.scalar().epsilon))
        if (const auto other = errors(exact.other); other.first < error.first) error = other;
      r.record(rotation, band, error.first);
      r.record(translation, band, error.second);
      r.record(defect, band, norm_defect(r.scalar(), Q));
    });
  }

 private:
  static Real pi() { return acos(Real(-1)); }
  template <class S>
  static Vec<S, 3> beside(Source& source, const Vec<S, 3>& p) {
    using std::sqrt;
    const Vec<S, 3> n = direction<S>(source);
    return p + S(sqrt(p.squaredNorm())) * binade_uniform<S>(source, -std::numeric_limits<S>::digits, 2) * n;
  }
};

class Directions final : public SlowLaw<Directions> {
 public:
  static constexpr Output angle = op::angle_between[block::angle],
                          direction_of = op::slerp_directions[block::direction],
                          length = op::slerp_directions[block::norm_defect];
  static constexpr Statement stated{
      .name = "directions",
      .law = "two directions have one angle, and the arc between them is divided in proportion to it",
      .equation = "theta = atan2(|a x b|, a . b); x = (sin((1 - t) theta) a + sin(t theta) b)/sin theta",
      .source = "Kahan 2006, How futile are mindless assessments; Shoemake 1985, section 3.3",
      .outputs = {angle, direction_of, length},
      .fields = {{"a", Kind::direction, 3, "1"},
                 {"b", Kind::direction, 3, "1", Reach::beside},
                 {"t", Kind::fraction, 1, "1"}}};

  template <class S>
  std::vector<S> draw(Source& source) const {
    const auto a = direction<S>(source);
    std::vector<S> x = Joined<S>{a, direction_beside<S>(source, a)};
    x.push_back(fraction_up_to_1<S>(source));
    return x;
  }
  bool valid(const std::vector<double>& input) const override {
    return Property::valid(input) && unit_direction_at(scalar(), input, 0) &&
           unit_direction_at(scalar(), input, 3);
  }
  void in(const Subject& subject, const std::vector<double>& input, Recorder& r) const {
    using namespace oracles;
    const auto& o = subject.operations;
    Reader read(input);
    const properties::Vec<double, 3> a = read.take<3>(), b = read.take<3>();
    const double t = read.take<1>()[0];
    const Vec3<> x = exact_vector<3>(a), y = exact_vector<3>(b);
    const Between exact = oracles::angle_between(x, y);
    const std::size_t band = exact.opposed < Real(1e-40) ? Bands::of(r.scalar()).at_pi()
                                                         : Bands::of(r.scalar()).classify(exact.theta);
    if (o[op::angle_between]) {
      const properties::Vec<double, 1> computed(o[op::angle_between](a, b));
      judged_value(r, {angle}, band, computed, exact.resolved, [&] {
        const Real allowed = r.ordinary(angle) ? cost_of_defects<3>(r.scalar(), x, y) : Real(0);
        r.record(angle, band,
                 scalar_error(r.scalar(), nearer(oracles::exact<Real>(computed[0]), exact.theta, allowed),
                              exact.theta, exact.terms));
      });
    }
    if (!o[op::slerp_directions]) return;
    const properties::Vec<double, 3> computed = o[op::slerp_directions](a, b, t);
    const auto between = oracles::slerp_directions(x, y, oracles::exact<Real>(t));
    // Of opposite directions any arc is right, and near them rounding turns it.
    if (exact.opposed <= Real(64 * r.scalar().epsilon) && all_finite(computed)) {
      for (const Output& out : {direction_of, length}) r.outcome(out, band, Outcome::ill_posed);
      return;
    }
    judged_value(r, {direction_of, length}, band, computed, between.resolved, [&] {
      const Vec3<> got = exact_vector<3>(computed);
      const Real size = norm(got);
      const auto kappa = [&] { return std::max(1.0, static_cast<double>(Real(2 / exact.opposed))); };
      r.record(direction_of, band,
               size > 0 ? in_eps(r.scalar(), Real(norm(Vec3<>(Real(1 / size) * got - between.value))))
                        : std::numeric_limits<double>::infinity(),
               kappa);
      r.record(length, band, in_eps(r.scalar(), Real(abs(Real(size - 1)))), kappa);
    });
  }
};

const RegisteredProperty<Interpolation> registered_interpolation;
const RegisteredProperty<Directions> registered_directions;

}  // namespace
}  // namespace liecheck::properties

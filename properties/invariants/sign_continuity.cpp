// Along a path the quaternion does not jump to its opposite.

#include <generators/rotations.hpp>
#include <invariants/increments.hpp>

namespace liecheck::properties {
namespace {

constexpr int steps = 8;

class SignContinuity final : public Law<SignContinuity> {
 public:
  static constexpr Statement stated{
      .name = "sign_continuity",
      .law = "integrate returns the one of Q and -Q that is nearer to its input",
      .equation = "Q_{k+1} . Q_k >= 0 for q_{k+1} = integrate(q_k, d)",
      .source = "Pinocchio 3.8, SpecialEuclideanOperation::integrate",
      .outputs = {op::integrate[block::sign]},
      .fields = {{"p0", Kind::vector, 3, "m"},
                 {"Q0", Kind::quaternion, 4, "1"},
                 {"rho", Kind::vector, 3, "m"},
                 {"phi", Kind::rotation_vector, 3, "rad", Reach::full}}};
  template <class S>
  std::vector<S> draw(Source& source) const {
    return Joined<S>{vector3<S>(source, 8), unit_quaternion<S>(source), vector3<S>(source, 8),
                     rotation_vector<S>(source, AngleRange::unbounded)};
  }
  template <class Real>
  void in(const Subject& subject, const std::vector<double>& input, Recorder& r) const {
    using namespace oracles;
    Reader read(input);
    Vec<double, 7> q = read.take<7>();
    const Vec<double, 6> d = read.take<6>();
    const std::size_t band = band_of_angle(r.scalar(), tail3(exact_vector<6, Real>(d)));
    for (int k = 0; k < steps; ++k) {
      const Vec<double, 7> next = subject.operations[op::integrate](q, d);
      record_sign<Real>(r, op::integrate[block::sign], band, q.tail<4>(), next.tail<4>());
      if (!all_finite(next)) return;
      q = next;
    }
  }
};

const RegisteredProperty<SignContinuity> registered_sign_continuity;

}  // namespace
}  // namespace liecheck::properties

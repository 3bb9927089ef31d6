// The smallest rotation from one direction to another is checked by what defines it: it turns a into b, and its axis is
// perpendicular to a. The second condition also holds for opposite directions, where any such axis is right.

#include <generators/rotations.hpp>
#include <invariants/common.hpp>

namespace liecheck::properties {
namespace {

class MinimalRotation final : public SlowLaw<MinimalRotation> {
 public:
  static constexpr const auto& measured = op::rotation_between;
  static constexpr Statement stated{
      .name = "minimal_rotation",
      .law = "the smallest rotation from a to b turns a into b about an axis perpendicular to a",
      .equation = "R(Q) a/|a| = b/|b|, Qxyz . a = 0, |Q| = 1",
      .source = "Sola 2017 (arXiv 1711.02508), eqs. 99-101",
      .outputs = {measured[block::direction], measured[block::twist], measured[block::norm_defect]},
      .fields = {{"a", Kind::direction, 3, "1"}, {"b", Kind::direction, 3, "1", Reach::beside}}};

  template <class S>
  std::vector<S> draw(Source& source) const {
    const auto a = direction<S>(source);
    return Joined<S>{a, direction_beside<S>(source, a)};
  }
  bool valid(const std::vector<double>& input) const override {
    if (!Property::valid(input)) return false;
    return unit_direction_at(scalar(), input, 0) && unit_direction_at(scalar(), input, 3);
  }
  void in(const Subject& subject, const std::vector<double>& input, Recorder& r) const {
    if (!subject.operations[measured]) return;
    using namespace oracles;
    constexpr Output direction = measured[block::direction], twist = measured[block::twist],
                     defect = measured[block::norm_defect];
    Reader read(input);
    const Vec<double, 3> a = read.take<3>(), b = read.take<3>();
    const Vec3<> x = exact_vector<3>(a), y = exact_vector<3>(b);
    const Vec3<> from = Real(1 / norm(x)) * x, to = Real(1 / norm(y)) * y;
    const Real plus = norm(from + to), angle = 2 * atan2(norm(to - from), plus);
    const std::size_t band =
        plus < Real(1e-45) ? Bands::of(r.scalar()).at_pi() : Bands::of(r.scalar()).classify(angle);
    const Vec<double, 4> computed = subject.operations[measured](a, b);
    judged_value(r, {direction, twist, defect}, band, computed, true, [&] {
      const Quaternion<> Q = exact_vector<4>(computed);
      const Real length = norm(Q);
      const bool rotates =
          length > 0;  // Q = 0 turns a into no direction: its distance is that of the opposite one
      r.record(direction, band, in_eps(r.scalar(), rotates ? Real(norm(rotate(Q, from) - to)) : Real(2)));
      r.record(twist, band,
               in_eps(r.scalar(), rotates ? Real(2 * abs(dot(head3(Q), from)) / length) : Real(0)));
      r.record(defect, band, norm_defect(r.scalar(), Q));
    });
  }
};

const RegisteredProperty<MinimalRotation> registered_minimal_rotation;

}  // namespace
}  // namespace liecheck::properties

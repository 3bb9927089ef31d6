// Gibbs and modified Rodrigues parameters of a rotation, both ways. They are proportional to the axis, so that errors are
// relative to their length.

#include <generators/rotations.hpp>
#include <invariants/common.hpp>
#include <oracles/representations.hpp>

namespace liecheck::properties {
namespace {

class RotationParameters final : public Law<RotationParameters> {
 public:
  static constexpr Output to_gibbs = op::gibbs_from_quaternion[block::parameters],
                          to_mrp = op::mrp_from_quaternion[block::parameters];
  static constexpr TwoOutputs of_gibbs = rotation_and_norm(op::quaternion_from_gibbs),
                              of_mrp = rotation_and_norm(op::quaternion_from_mrp);
  static constexpr Statement stated{
      .name = "rotation_parameters",
      .law = "Gibbs and modified Rodrigues parameters are tangents of a half and a quarter of the angle",
      .equation = "g = tan(theta/2) n = v/w; s = tan(theta/4) n = v/(1 + w), |s| <= 1 with w >= 0",
      .source = "Shuster 1993, A survey of attitude representations",
      .outputs = {to_gibbs, to_mrp, of_gibbs[0], of_gibbs[1], of_mrp[0], of_mrp[1]},
      .fields = {{"Q", Kind::quaternion, 4, "1", Reach::any},
                 {"gibbs", Kind::vector, 3, "1", Reach::any},
                 {"mrp", Kind::vector, 3, "1", Reach::any}}};

  template <class S>
  std::vector<S> draw(Source& source) const {
    auto Q = unit_quaternion<S>(source);
    if (Q[3] * Q[3] > std::numeric_limits<S>::epsilon()) Q /= S(std::sqrt(Q.squaredNorm()));
    constexpr int digits = std::numeric_limits<S>::digits;
    const auto parameters = [&] {  // of a small, a moderate or a large turn
      const std::uint64_t kind = source.below(16);
      const int low = kind == 0 ? std::numeric_limits<S>::min_exponent / 2 : -digits - 8;
      const S size = kind == 1   ? S(0)
                     : kind <= 3 ? S(S(1) + source.symmetric<S>() / S(16))
                                 : binade_uniform<S>(source, low, kind < 10 ? 1 : digits);
      return Vec<S, 3>(size * direction<S>(source));
    };
    const Vec<S, 3> g = parameters(), s = parameters();
    return Joined<S>{Q, g, s};
  }
  /// Gibbs parameters have a pole at pi. Squares are finite.
  bool valid(const std::vector<double>& input) const override {
    if (!Property::valid(input)) return false;
    const double most = std::ldexp(1, scalar().max_exponent / 2 - 4);
    const double v = std::max({std::fabs(input[0]), std::fabs(input[1]), std::fabs(input[2])});
    return (input[3] == 0 || v / std::fabs(input[3]) < most) &&
           std::all_of(input.begin() + 4, input.end(), [&](double x) { return std::fabs(x) < most; });
  }

  template <class Real>
  void in(const Subject& subject, const std::vector<double>& input, Recorder& r) const {
    using namespace oracles;
    const auto& o = subject.operations;
    Reader read(input);
    const properties::Vec<double, 4> Q = read.take<4>();
    const properties::Vec<double, 3> g = read.take<3>(), s = read.take<3>();
    const auto q = exact_vector<4, Real>(Q);
    const std::size_t band = band_of_rotation(r.scalar(), q);
    if (o[op::gibbs_from_quaternion] && Q[3] == 0)
      r.outcome(to_gibbs, band, Outcome::ill_posed);
    else if (o[op::gibbs_from_quaternion])
      record(r, to_gibbs, band, o[op::gibbs_from_quaternion](Q), oracles::gibbs(q));
    if (o[op::mrp_from_quaternion])
      record(r, to_mrp, band, o[op::mrp_from_quaternion](Q), modified_rodrigues(q), true);
    if (o[op::quaternion_from_gibbs])
      record_rotation(r, of_gibbs, 0, o[op::quaternion_from_gibbs](g), from_gibbs(exact_vector<3, Real>(g)));
    if (o[op::quaternion_from_mrp])
      record_rotation(r, of_mrp, 0, o[op::quaternion_from_mrp](s),
                      from_modified_rodrigues(exact_vector<3, Real>(s)));
  }

 private:
  /// Ordinary code may return the shadow -s/|s|^2 of modified Rodrigues parameters, v/(|Q| + w) with w < 0, where rounding
  /// costs (1 + |s|^2)/2 times as much. Within 8 eps of pi, |s| = 1, either sign is right.
  template <class Real>
  static void record(Recorder& r, const Output& output, std::size_t band, const Vec<double, 3>& computed,
                     const oracles::Resolved<oracles::Vec3<Real>>& exact, bool has_shadow = false) {
    judged_value(r, {output}, band, computed, exact.resolved, [&] {
      const auto s = oracles::exact_vector<3, Real>(computed);
      if (has_shadow && dot(s, exact.value) < Real(0)) {
        const Real square = squared_norm(exact.value);
        const bool at_pi = Real(1) - square < Real(8 * r.scalar().epsilon);
        if (at_pi || r.ordinary(output)) {
          const oracles::Vec3<Real> shadow = Real(Real(-1) / square) * exact.value;
          return r.record(output, band,
                          oracles::vector_error(r.scalar(), s, shadow,
                                                Real(norm(shadow) * (Real(1) + Real(1) / square) / Real(2))));
        }
      }
      r.record(output, band, oracles::vector_error(r.scalar(), s, exact.value));
    });
  }
};

const RegisteredProperty<RotationParameters> registered_rotation_parameters;

}  // namespace
}  // namespace liecheck::properties

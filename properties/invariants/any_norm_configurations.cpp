// integrate, difference and its derivative take configurations with quaternions of any norm (any_norm.cpp).

#include <generators/rotations.hpp>
#include <invariants/any_norm.hpp>
#include <invariants/increments.hpp>

namespace liecheck::properties {
namespace {

class AnyNormConfigurations final : public Law<AnyNormConfigurations> {
 public:
  static constexpr Statement stated{
      .name = "any_norm_configurations",
      .law =
          "a configuration with a quaternion of any norm is that with the unit quaternion of its direction",
      .equation = "f((p, s Q)) = f((p, Q)) for every s > 0",
      .source = "Sola 2017 (arXiv 1711.02508), section 2",
      .outputs = {op::integrate_any_norm[block::rotation], op::integrate_any_norm[block::translation],
                  op::integrate_any_norm[block::norm_defect], op::integrate_any_norm[block::sign],
                  op::difference_any_norm[block::rotation_vector], op::difference_any_norm[block::linear],
                  op::d_difference_any_norm[block::jacobian], op::d_difference_any_norm[block::coupling]},
      .fields = {{"p0", Kind::vector, 3, "m", Reach::full},
                 {"Q0", Kind::any_quaternion, 4, "1"},
                 {"p1", Kind::vector, 3, "m", Reach::beside},
                 {"Q1", Kind::any_quaternion, 4, "1", Reach::beside},
                 {"rho", Kind::vector, 3, "m", Reach::full},
                 {"phi", Kind::rotation_vector, 3, "rad", Reach::full}}};

  template <class S>
  std::vector<S> draw(Source& source) const {
    const auto p0 = vector3<S>(source);
    const auto Q0 = unit_quaternion<S>(source), Q1 = quaternion_near<S>(source, Q0);
    const S norm = quaternion_norm<S>(source);
    const S other = source.chance(1, 2) ? norm : quaternion_norm<S>(source);
    return Joined<S>{p0,
                     Vec<S, 4>(norm * Q0),
                     point_near<S>(source, p0),
                     Vec<S, 4>(other * Q1),
                     vector3<S>(source),
                     rotation_vector<S>(source, AngleRange::unbounded)};
  }

  template <class Real>
  void in(const Subject& subject, const std::vector<double>& input, Recorder& r) const {
    const auto& o = subject.operations;
    Reader read(input);
    const Vec<double, 7> q0 = read.take<7>(), q1 = read.take<7>();
    const Vec<double, 6> d = read.take<6>();
    const Vec<double, 7> unit0 = scaled(r.scalar(), q0);
    const auto x0 = oracles::exact_vector<7, Real>(unit0),
               x1 = oracles::exact_vector<7, Real>(scaled(r.scalar(), q1));
    if (o[op::integrate_any_norm]) {
      const Vec<double, 7> computed = o[op::integrate_any_norm](q0, d);
      const auto xd = oracles::exact_vector<6, Real>(d);
      const std::size_t band = band_of_angle(r.scalar(), tail3(xd));
      constexpr const auto& integrate = op::integrate_any_norm;
      record_integrate(
          r, {integrate[block::rotation], integrate[block::translation], integrate[block::norm_defect]}, band,
          computed, x0, xd);
      record_sign<Real>(r, integrate[block::sign], band, unit0.tail<4>(), computed.tail<4>());
    }
    if (o[op::difference_any_norm] || o[op::d_difference_any_norm])
      record_difference<Real>(o, q0, q1, x0, x1, r);
  }

 private:
  static Vec<double, 7> scaled(const oracles::Scalar& scalar, Vec<double, 7> q) {
    q.tail<4>() = at_unit_scale(scalar, q.tail<4>());
    return q;
  }
  template <class Real>
  static void record_difference(const Operations& o, const Vec<double, 7>& q0, const Vec<double, 7>& q1,
                                const oracles::Vec7<Real>& x0, const oracles::Vec7<Real>& x1, Recorder& r) {
    const auto exact = oracles::difference(x0, x1);
    const std::size_t band = band_of_difference(r.scalar(), x0, x1, exact);
    if (o[op::difference_any_norm])
      properties::record_difference(
          r, {op::difference_any_norm[block::rotation_vector], op::difference_any_norm[block::linear]}, band,
          o[op::difference_any_norm](q0, q1), exact, x0, x1);
    if (!o[op::d_difference_any_norm]) return;
    const Mat<double, 6> J = o[op::d_difference_any_norm](q0, q1);
    // The antisymmetric part of J_r^-1 is [phi] / 2, on the side of pi that was chosen.
    auto at = exact.value();
    if (at_either_side(r.scalar(), exact) && oracles::all_finite(J))
      at = at_side_of(r.scalar(), vee(oracles::block(oracles::exact_matrix<6, 6, Real>(J), 0, 0)), exact)
               .value();
    auto inverse = oracles::right_jacobian_se3_inverse(at);
    inverse.resolved = inverse.resolved && exact.resolved;
    record_by_difference(r, jacobian_outputs(op::d_difference_any_norm), band, J, inverse, x0, x1);
  }
};

const RegisteredProperty<AnyNormConfigurations> registered_any_norm_configurations;

}  // namespace
}  // namespace liecheck::properties

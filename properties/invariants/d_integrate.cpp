// dIntegrate and dDifference, compared with finite differences of their definitions at high precision.

#include <generators/rotations.hpp>
#include <invariants/increments.hpp>
#include <optional>

namespace liecheck::properties {
namespace {

class DIntegrate final : public Law<DIntegrate> {
 public:
  static constexpr Statement stated{
      .name = "d_integrate",
      .law =
          "dIntegrate and dDifference are the derivatives of integrate and difference in the tangent spaces",
      .equation = "ARG0 = Ad(exp(-d)), ARG1 = J_r(d); dDifference ARG0 = -J_l^-1(d), ARG1 = J_r^-1(d)",
      .source = "Sola, Deray & Atchuthan 2018, eqs. 79-85; central differences at 100 digits",
      .outputs = {op::d_integrate_arg0[block::jacobian], op::d_integrate_arg0[block::coupling],
                  op::d_integrate_arg1[block::jacobian], op::d_integrate_arg1[block::coupling],
                  op::d_difference_arg0[block::jacobian], op::d_difference_arg0[block::coupling],
                  op::d_difference_arg1[block::jacobian], op::d_difference_arg1[block::coupling]},
      .fields = {{"p0", Kind::vector, 3, "m", Reach::full},
                 {"Q0", Kind::quaternion, 4, "1"},
                 {"p1", Kind::vector, 3, "m", Reach::beside},
                 {"Q1", Kind::quaternion, 4, "1", Reach::beside},
                 {"rho", Kind::vector, 3, "m", Reach::full},
                 {"phi", Kind::rotation_vector, 3, "rad", Reach::full}}};
  template <class S>
  std::vector<S> draw(Source& source) const {
    const auto p0 = vector3<S>(source);
    const auto Q0 = unit_quaternion<S>(source);
    return Joined<S>{p0,
                     Q0,
                     point_near<S>(source, p0),
                     quaternion_near<S>(source, Q0),
                     vector3<S>(source),
                     rotation_vector<S>(source, AngleRange::unbounded)};
  }
  template <class Real>
  void in(const Subject& subject, const std::vector<double>& input, Recorder& r) const {
    using namespace oracles;
    const auto& o = subject.operations;
    Reader read(input);
    const Vec<double, 7> q0 = read.take<7>(), q1 = read.take<7>();
    const Vec<double, 6> d = read.take<6>();
    const auto x0 = exact_vector<7, Real>(q0), x1 = exact_vector<7, Real>(q1);
    const auto xd = exact_vector<6, Real>(d);
    if (o[op::d_integrate_arg0])
      record_d_integrate_arg0(r, jacobian_outputs(op::d_integrate_arg0), x0, xd,
                              o[op::d_integrate_arg0](q0, d));
    if (o[op::d_integrate_arg1])
      record_d_integrate_arg1(r, jacobian_outputs(op::d_integrate_arg1), x0, xd,
                              o[op::d_integrate_arg1](q0, d));
    if (!o[op::d_difference_arg0] && !o[op::d_difference_arg1]) return;
    const auto exact = oracles::difference(x0, x1);
    std::optional<oracles::Jacobian6Value<Real>> inverse;
    const std::size_t band = band_of_difference(r.scalar(), x0, x1, exact);
    // In ball arithmetic, arg0 and arg1 share one logarithm and one inverse Jacobian, because the blocks of
    // J_r^-1 are the transposed blocks of J_l^-1.
    const auto of_difference = [&](bool arg1,
                                   const Mat<double, 6>& computed) -> oracles::Jacobian6Value<Real> {
      using namespace oracles;
      const auto minus = [](const Jacobian6Value<Real>& J) -> Jacobian6Value<Real> {
        return {Real(-1) * J.J, Real(-1) * J.C, J.resolved};
      };
      if (at_either_side(r.scalar(), exact)) {
        // The antisymmetric part of -J_l^-1 and of J_r^-1 is [phi] / 2, on the side of pi that was chosen.
        const auto axis =
            all_finite(computed) ? vee(oracles::block(exact_matrix<6, 6, Real>(computed), 0, 0)) : exact.phi;
        const LogValue<Real> at = at_side_of(r.scalar(), axis, exact);
        return arg1 ? right_jacobian_se3_inverse(at.value()) : minus(left_jacobian_se3_inverse(at.value()));
      } else if constexpr (BallNumber<Real>) {
        if (!inverse) inverse = left_jacobian_se3_inverse(exact.value());
        return arg1 ? transposed(*inverse) : minus(*inverse);
      } else {
        return arg1 ? oracles::d_difference_arg1(x0, x1) : oracles::d_difference_arg0(x0, x1);
      }
    };
    const auto record = [&](const auto& operation, const TwoOutputs& outputs, bool arg1) {
      if (!operation) return;
      const Mat<double, 6> computed = operation(q0, q1);
      record_by_difference(r, outputs, band, computed, of_difference(arg1, computed), x0, x1);
    };
    record(o[op::d_difference_arg0], jacobian_outputs(op::d_difference_arg0), false);
    record(o[op::d_difference_arg1], jacobian_outputs(op::d_difference_arg1), true);
  }
};

const RegisteredProperty<DIntegrate> registered_d_integrate;

}  // namespace
}  // namespace liecheck::properties

// dIntegrate and dDifference, compared with finite differences of their definitions at high precision.

#include <generators/rotations.hpp>
#include <invariants/branch.hpp>
#include <liecheck/scalar/scalar.hpp>
#include <optional>
#include <oracles/ball_oracles.hpp>
#include <oracles/integrate.hpp>

namespace liecheck::properties {
namespace {

template <class S>
class DIntegrate final : public Law<DIntegrate, S> {
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
      .fields = {{"p0", Kind::vector, 3, "m"},
                 {"Q0", Kind::quaternion, 4, "1"},
                 {"p1", Kind::vector, 3, "m"},
                 {"Q1", Kind::quaternion, 4, "1", Reach::beside},
                 {"rho", Kind::vector, 3, "m"},
                 {"phi", Kind::rotation_vector, 3, "rad"}}};
  std::vector<S> generate(Source& source) const override {
    const int scale = std::numeric_limits<S>::max_exponent / 8;
    const auto p0 = vector3<S>(source, scale);
    const auto Q0 = unit_quaternion<S>(source);
    return Joined<S>{p0,
                     Q0,
                     vector3<S>(source, scale),
                     quaternion_near<S>(source, Q0),
                     vector3<S>(source, scale),
                     rotation_vector<S>(source, AngleRange::to_pi)};
  }
  bool valid(const std::vector<S>& x) const override {
    // theta is at most pi, up to a few ulp. Beyond pi, exp_oracle and jacobian_oracle measure the matrices.
    using std::sqrt;
    return Property<S>::valid(x) && norm_defect_at<S>(x, 3) <= 8 && norm_defect_at<S>(x, 10) <= 8 &&
           sqrt(x[17] * x[17] + x[18] * x[18] + x[19] * x[19]) <= pi<S>() * (S(1) + S(4) * eps<S>());
  }
  template <class Real>
  void in(const Subject<S>& subject, const std::vector<S>& input, Recorder& r) const {
    using namespace oracles;
    const auto& o = subject.operations;
    Reader<S> read(input);
    const Vec<S, 7> q0 = read.template take<7>(), q1 = read.template take<7>();
    const Vec<S, 6> d = read.template take<6>();
    const auto x0 = exact_vector<7, Real>(q0), x1 = exact_vector<7, Real>(q1);
    const auto xd = exact_vector<6, Real>(d);
    std::size_t band = band_of_angle<S>(tail3(xd));
    // The float nearest to pi is beyond pi. At this angle, kappa is 1 within a few per cent.
    const bool beyond = Bands::of<S>()[band].region == Region::beyond_pi;
    const Real rho = norm(head3(xd));
    if (o[op::d_integrate_arg0])
      record_jacobian6<S>(r, jacobian_outputs(op::d_integrate_arg0), band, o[op::d_integrate_arg0](q0, d),
                          oracles::d_integrate_arg0(x0, xd), rho, beyond);
    if (o[op::d_integrate_arg1])
      record_jacobian6<S>(r, jacobian_outputs(op::d_integrate_arg1), band, o[op::d_integrate_arg1](q0, d),
                          oracles::d_integrate_arg1(x0, xd), rho, beyond);
    if (!o[op::d_difference_arg0] && !o[op::d_difference_arg1]) return;
    const auto exact = oracles::difference(x0, x1);
    std::optional<oracles::Jacobian6Value<Real>> inverse;
    band = band_of_difference<S>(x0, x1, exact);
    // In ball arithmetic, arg0 and arg1 share one logarithm and one inverse Jacobian, because the blocks of
    // J_r^-1 are the transposed blocks of J_l^-1.
    const auto of_difference = [&](bool arg1, const Mat<S, 6>& computed) -> oracles::Jacobian6Value<Real> {
      using namespace oracles;
      const auto minus = [](const Jacobian6Value<Real>& J) -> Jacobian6Value<Real> {
        return {Real(-1) * J.J, Real(-1) * J.C, J.resolved};
      };
      if constexpr (BallNumber<Real>) {
        if (at_either_side<S>(exact)) throw Undecided();
        if (!inverse) inverse = left_jacobian_se3_inverse(stack(exact.rho, exact.phi));
        return arg1 ? transposed(*inverse) : minus(*inverse);
      } else if (at_either_side<S>(exact)) {
        // The antisymmetric part of -J_l^-1 and of J_r^-1 is [phi] / 2, on the side of pi that was chosen.
        const auto axis =
            all_finite(computed) ? vee(oracles::block(exact_matrix<6, 6, Real>(computed), 0, 0)) : exact.phi;
        const LogValue<Real> at = at_side_of<S>(axis, exact);
        return arg1 ? right_jacobian_se3_inverse(at.value()) : minus(left_jacobian_se3_inverse(at.value()));
      } else {
        return arg1 ? oracles::d_difference_arg1(x0, x1) : oracles::d_difference_arg0(x0, x1);
      }
    };
    const auto record = [&](auto operation, const TwoOutputs& outputs, bool arg1) {
      if (!operation) return;
      const Mat<S, 6> computed = operation(q0, q1);
      record_jacobian6<S>(r, outputs, band, computed, of_difference(arg1, computed), Real(0), false);
    };
    record(o[op::d_difference_arg0], jacobian_outputs(op::d_difference_arg0), false);
    record(o[op::d_difference_arg1], jacobian_outputs(op::d_difference_arg1), true);
  }
};

const RegisteredProperty<DIntegrate> registered;

}  // namespace
}  // namespace liecheck::properties

// The left and right J and J^-1 of SO(3) and SE(3) are each compared with the oracle. The law does not check
// the product J J^-1, in which the errors of both could cancel.

#include <generators/rotations.hpp>
#include <invariants/common.hpp>
#include <optional>
#include <oracles/ball_oracles.hpp>
#include <oracles/closed_forms.hpp>

namespace liecheck::properties {
namespace {

class JacobianOracle final : public Law<JacobianOracle> {
 public:
  static constexpr Statement stated{
      .name = "jacobian_oracle",
      .law = "the Jacobians of exp and their inverses are exact",
      .equation = "J_l = phi_1(ad xi), J_r = phi_1(-ad xi), phi_1(A) = sum_k A^k/(k+1)!",
      .source = "Chirikjian 2011, section 10.5; Higham 2008, section 10.7.4",
      .outputs = {op::left_jacobian3[block::jacobian], op::right_jacobian3[block::jacobian],
                  op::left_jacobian3_inverse[block::jacobian], op::right_jacobian3_inverse[block::jacobian],
                  op::left_jacobian6[block::jacobian], op::left_jacobian6[block::coupling],
                  op::right_jacobian6[block::jacobian], op::right_jacobian6[block::coupling],
                  op::left_jacobian6_inverse[block::jacobian], op::left_jacobian6_inverse[block::coupling],
                  op::right_jacobian6_inverse[block::jacobian], op::right_jacobian6_inverse[block::coupling]},
      .fields = {{"rho", Kind::vector, 3, "m", Reach::full},
                 {"phi", Kind::rotation_vector, 3, "rad", Reach::full}}};
  template <class S>
  std::vector<S> draw(Source& source) const {
    return Joined<S>{vector3<S>(source), rotation_vector<S>(source, AngleRange::unbounded)};
  }
  template <class Real>
  void in(const Subject& subject, const std::vector<double>& input, Recorder& r) const {
    using namespace oracles;
    const auto& o = subject.operations;
    const Vec<double, 6> xi = Reader(input).take<6>();
    const Vec<double, 3> phi = xi.tail<3>();
    const auto x = exact_vector<6, Real>(xi);
    const Jacobians<Real> exact(x);
    const Real theta = norm(tail3(x)), rho = norm(head3(x));
    const std::size_t band = band_of_angle(r.scalar(), tail3(x));
    const bool beyond = Bands::of(r.scalar())[band].region == Region::beyond_pi;

    // The right Jacobian is the left one at -xi, so its blocks have the same kappa.
    const auto flat = [](const JacobianBlocks<Real>& b) { return to_list(b.J, b.C); };
    const auto stored = [&] { return to_list(x); };
    const auto direct = sensitivity<Real>(
        [&](const std::vector<Real>& v) { return flat(closed_left_jacobian(from_list<6>(v))); }, stored,
        {{0, 9}, {9, 9}});
    const auto inverted = sensitivity<Real>(
        [&](const std::vector<Real>& v) { return flat(closed_left_jacobian_inverse(from_list<6>(v))); },
        stored, {{0, 9}, {9, 9}});
    // The inverse has poles at theta = 2 pi k. Between two poles, its norm has an extremum with derivative
    // zero. But one rounding error of a large theta may exceed the distance between two poles. So kappa is at
    // least theta divided by the distance to the nearest pole (Demmel 1987).
    std::optional<double> to_pole;
    const auto kappa = [&](bool inverse, bool coupling, const Real& denominator) {
      const std::size_t block = coupling ? 1 : 0;
      if (!inverse) return direct.kappa(block, denominator);
      const double componentwise = inverted.kappa(block, denominator);
      if (!to_pole) {
        const oracles::Real t = oracles::exact<oracles::Real>(theta),
                            turn = 2 * boost::math::constants::pi<oracles::Real>();
        const oracles::Real k = round(oracles::Real(t / turn));
        const oracles::Real distance = abs(oracles::Real(t - (k > 1 ? k : oracles::Real(1)) * turn));
        to_pole = static_cast<double>(oracles::Real(t / distance));
      }
      return std::max(componentwise, *to_pole);
    };
    const auto size = [&](const Jacobian6Value<Real>& exact, bool coupling) {
      if (!coupling) return norm(exact.J);
      const Real n = norm(exact.J), own = norm(exact.C), least = rho * smaller(n, Real(1));
      return beyond ? larger(own, least) : own;
    };
    const auto three = [&](const auto& operation, const Output& output, const Jacobian6Value<Real>& exact,
                           bool inverse) {
      if (!operation) return;
      const Mat<double, 3> J = operation(phi);
      judged_value(r, {output}, band, J, exact.resolved, [&] {
        r.record(output, band, vector_error(r.scalar(), exact_matrix<3, 3, Real>(J), exact.J),
                 [&] { return kappa(inverse, false, size(exact, false)); });
      });
    };
    const auto six = [&](const auto& operation, const TwoOutputs& outputs, const Jacobian6Value<Real>& exact,
                         bool inverse) {
      if (!operation) return;
      record_jacobian6(
          r, outputs, band, operation(xi), exact, rho, beyond,
          [&] { return kappa(inverse, false, size(exact, false)); },
          [&] { return kappa(inverse, true, size(exact, true)); });
    };
    three(o[op::left_jacobian3], op::left_jacobian3[block::jacobian], exact.left, false);
    three(o[op::right_jacobian3], op::right_jacobian3[block::jacobian], exact.right, false);
    three(o[op::left_jacobian3_inverse], op::left_jacobian3_inverse[block::jacobian], exact.left_inverse,
          true);
    three(o[op::right_jacobian3_inverse], op::right_jacobian3_inverse[block::jacobian], exact.right_inverse,
          true);
    six(o[op::left_jacobian6], jacobian_outputs(op::left_jacobian6), exact.left, false);
    six(o[op::right_jacobian6], jacobian_outputs(op::right_jacobian6), exact.right, false);
    six(o[op::left_jacobian6_inverse], jacobian_outputs(op::left_jacobian6_inverse), exact.left_inverse,
        true);
    six(o[op::right_jacobian6_inverse], jacobian_outputs(op::right_jacobian6_inverse), exact.right_inverse,
        true);
  }
};

const RegisteredProperty<JacobianOracle> registered_jacobian_oracle;

}  // namespace
}  // namespace liecheck::properties

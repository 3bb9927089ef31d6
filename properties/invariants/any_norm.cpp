// The operations that take a quaternion of any norm, from near underflow to near overflow, are compared with the
// exact functions of Q/|Q|. A factor 2^k does not change Q/|Q|, so the oracles take 2^k Q, whose norm is about 1.

#include <generators/rotations.hpp>
#include <invariants/increments.hpp>
#include <oracles/normalisation.hpp>

namespace liecheck::properties {
namespace {

template <class S>
class AnyNorm final : public Law<AnyNorm, S> {
 public:
  static constexpr Statement stated{
      .name = "any_norm",
      .law = "a quaternion of any norm is the rotation of the unit quaternion with its direction",
      .equation = "f(s Q) = f(Q) for every s > 0; normalize(Q) = Q/|Q|",
      .source = "Sola 2017 (arXiv 1711.02508), section 2",
      .outputs = {op::normalize[block::quaternion], op::normalize[block::norm_defect],
                  op::quaternion_matrix[block::entry], op::rotate_point_any_norm[block::point],
                  op::log3_any_norm[block::rotation_vector], op::integrate_any_norm[block::rotation],
                  op::integrate_any_norm[block::translation], op::integrate_any_norm[block::norm_defect],
                  op::integrate_any_norm[block::sign], op::difference_any_norm[block::rotation_vector],
                  op::difference_any_norm[block::linear], op::d_difference_any_norm[block::jacobian],
                  op::d_difference_any_norm[block::coupling]},
      .fields = {{"p", Kind::vector, 3, "m", Reach::full},
                 {"p0", Kind::vector, 3, "m", Reach::full},
                 {"Q0", Kind::any_quaternion, 4, "1"},
                 {"p1", Kind::vector, 3, "m", Reach::beside},
                 {"Q1", Kind::any_quaternion, 4, "1", Reach::beside},
                 {"rho", Kind::vector, 3, "m", Reach::full},
                 {"phi", Kind::rotation_vector, 3, "rad", Reach::full}}};

  std::vector<S> generate(Source& source) const override {
    const auto p = vector3<S>(source), p0 = vector3<S>(source);
    const auto Q0 = unit_quaternion<S>(source), Q1 = quaternion_near<S>(source, Q0);
    const S norm = quaternion_norm<S>(source);
    const S other = source.chance(1, 2) ? norm : quaternion_norm<S>(source);
    return Joined<S>{p,
                     p0,
                     Vec<S, 4>(norm * Q0),
                     point_near<S>(source, p0),
                     Vec<S, 4>(other * Q1),
                     vector3<S>(source),
                     rotation_vector<S>(source, AngleRange::unbounded)};
  }
  bool valid(const std::vector<S>& input) const override {
    const auto zero = [&](std::size_t first) {
      return std::all_of(input.begin() + static_cast<long>(first),
                         input.begin() + static_cast<long>(first + 4), [](const S& x) { return x == S(0); });
    };
    return Property<S>::valid(input) && !zero(6) && !zero(13);
  }

  template <class Real>
  void in(const Subject<S>& subject, const std::vector<S>& input, Recorder& r) const {
    const auto& o = subject.operations;
    Reader<S> read(input);
    const Vec<S, 3> p = read.template take<3>();
    const Vec<S, 7> q0 = read.template take<7>(), q1 = read.template take<7>();
    const Vec<S, 6> d = read.template take<6>();
    const Vec<S, 4> Q = q0.template tail<4>();
    const auto x0 = oracles::exact_vector<7, Real>(at_unit_scale(q0)),
               x1 = oracles::exact_vector<7, Real>(at_unit_scale(q1));
    const auto Qx = quaternion_of(x0);
    if (o[op::normalize]) record_normalize(r, o[op::normalize](Q), Qx);
    if (o[op::quaternion_matrix]) record_matrix(r, o[op::quaternion_matrix](Q), Qx);
    if (o[op::rotate_point_any_norm]) {
      const auto px = oracles::exact_vector<3, Real>(p);
      const auto exact = oracles::rotate_point(Qx, px);
      const Vec<S, 3> computed = o[op::rotate_point_any_norm](Q, p);
      judged_value(r, {op::rotate_point_any_norm[block::point]}, 0, computed, exact.resolved, [&] {
        r.record(op::rotate_point_any_norm[block::point], 0,
                 oracles::vector_error<S>(oracles::exact_vector<3, Real>(computed), exact.value));
      });
    }
    if (o[op::log3_any_norm]) {
      const auto exact = oracles::log_so3(Qx);
      Vec<S, 6> xi;
      xi << Vec<S, 3>::Zero(), o[op::log3_any_norm](Q);
      record_log<S>(r, {op::log3_any_norm[block::rotation_vector]}, band_of_log<S>(exact), xi, exact,
                    Side::decided);
    }
    if (o[op::integrate_any_norm]) {
      const Vec<S, 7> computed = o[op::integrate_any_norm](q0, d);
      const auto xd = oracles::exact_vector<6, Real>(d);
      const std::size_t band = band_of_angle<S>(tail3(xd));
      constexpr const auto& integrate = op::integrate_any_norm;
      record_integrate<S>(
          r, {integrate[block::rotation], integrate[block::translation], integrate[block::norm_defect]}, band,
          computed, x0, xd);
      record_sign<Real, S>(r, integrate[block::sign], band, at_unit_scale(q0).template tail<4>(),
                           computed.template tail<4>());
    }
    if (o[op::difference_any_norm] || o[op::d_difference_any_norm])
      record_difference<Real>(o, q0, q1, x0, x1, r);
  }

 private:
  /// q with 2^k Q in place of Q, whose largest number is in [1/2, 1). Digits below the smallest number are lost,
  /// which is far below every error that a law measures.
  static Vec<S, 7> at_unit_scale(Vec<S, 7> q) {
    using std::frexp, std::ldexp;
    int exponent = 0;
    static_cast<void>(frexp(S(q.template tail<4>().cwiseAbs().maxCoeff()), &exponent));
    for (int i = 3; i < 7; ++i) q[i] = S(ldexp(q[i], -exponent));
    return q;
  }

  template <class Real>
  static void record_normalize(Recorder& r, const Vec<S, 4>& computed, const oracles::Quaternion<Real>& Q) {
    constexpr Output quaternion = op::normalize[block::quaternion],
                     defect = op::normalize[block::norm_defect];
    const auto exact = oracles::normalize(Q);
    judged_value(r, {quaternion, defect}, 0, computed, exact.resolved, [&] {
      const auto unit = oracles::exact_vector<4, Real>(computed);
      r.record(quaternion, 0, oracles::vector_error<S>(unit, exact.value));
      r.record(defect, 0, oracles::norm_defect<S>(unit));
    });
  }
  template <class Real>
  static void record_matrix(Recorder& r, const Mat<S, 3>& computed, const oracles::Quaternion<Real>& Q) {
    constexpr Output entry = op::quaternion_matrix[block::entry];
    const auto exact = oracles::quaternion_matrix(Q);
    judged_value(r, {entry}, 0, computed, exact.resolved, [&] {
      const auto E = oracles::exact_matrix<3, 3, Real>(computed) - exact.value;
      double error = 0;
      for (const Real& x : E.x) error = std::max(error, oracles::in_eps<S>(Real(abs(x))));
      r.record(entry, 0, error);
    });
  }
  template <class Real>
  static void record_difference(const Operations<S>& o, const Vec<S, 7>& q0, const Vec<S, 7>& q1,
                                const oracles::Vec7<Real>& x0, const oracles::Vec7<Real>& x1, Recorder& r) {
    const auto exact = oracles::difference(x0, x1);
    const std::size_t band = band_of_difference<S>(x0, x1, exact);
    if (o[op::difference_any_norm])
      record_log<S>(r,
                    {op::difference_any_norm[block::rotation_vector], op::difference_any_norm[block::linear]},
                    band, o[op::difference_any_norm](q0, q1), exact, Side::either, exact.separation);
    if (!o[op::d_difference_any_norm]) return;
    const Mat<S, 6> J = o[op::d_difference_any_norm](q0, q1);
    // The antisymmetric part of J_r^-1 is [phi] / 2, on the side of pi that was chosen.
    auto at = exact.value();
    if (at_either_side<S>(exact) && oracles::all_finite(J))
      at = at_side_of<S>(vee(oracles::block(oracles::exact_matrix<6, 6, Real>(J), 0, 0)), exact).value();
    auto inverse = oracles::right_jacobian_se3_inverse(at);
    inverse.resolved = inverse.resolved && exact.resolved;
    record_jacobian6<S>(r, jacobian_outputs(op::d_difference_any_norm), band, J, inverse, Real(0), false);
  }
};

const RegisteredProperty<AnyNorm> registered;

}  // namespace
}  // namespace liecheck::properties

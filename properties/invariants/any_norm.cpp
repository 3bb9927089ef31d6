// The operations that take a quaternion of any norm, from near underflow to near overflow, are compared with the
// exact functions of Q/|Q|: this law has those of rotations, any_norm_configurations.cpp those of poses.

#include <generators/rotations.hpp>
#include <invariants/any_norm.hpp>
#include <invariants/branch.hpp>
#include <oracles/normalisation.hpp>

namespace liecheck::properties {
namespace {

class AnyNorm final : public Law<AnyNorm> {
 public:
  static constexpr Statement stated{
      .name = "any_norm",
      .law = "a quaternion of any norm is the rotation of the unit quaternion with its direction",
      .equation = "f(s Q) = f(Q) for every s > 0; normalize(Q) = Q/|Q|",
      .source = "Sola 2017 (arXiv 1711.02508), section 2",
      .outputs = {op::normalize[block::quaternion], op::normalize[block::norm_defect],
                  op::matrix_from_quaternion_any_norm[block::entry], op::rotate_point_any_norm[block::point],
                  op::log3_any_norm[block::rotation_vector]},
      .fields = {{"Q", Kind::any_quaternion, 4, "1"}, {"p", Kind::vector, 3, "m", Reach::full}}};

  template <class S>
  std::vector<S> draw(Source& source) const {
    const auto Q = unit_quaternion<S>(source);
    return Joined<S>{Vec<S, 4>(quaternion_norm<S>(source) * Q), vector3<S>(source)};
  }

  template <class Real>
  void in(const Subject& subject, const std::vector<double>& input, Recorder& r) const {
    const auto& o = subject.operations;
    Reader read(input);
    const Vec<double, 4> Q = read.take<4>();
    const Vec<double, 3> p = read.take<3>();
    const auto Qx = oracles::exact_vector<4, Real>(at_unit_scale(r.scalar(), Q));
    if (o[op::normalize]) record_normalize(r, o[op::normalize](Q), Qx);
    if (o[op::matrix_from_quaternion_any_norm]) record_matrix(r, o[op::matrix_from_quaternion_any_norm](Q), Qx);
    if (o[op::rotate_point_any_norm]) {
      const auto px = oracles::exact_vector<3, Real>(p);
      const auto exact = oracles::rotate_point(Qx, px);
      const Vec<double, 3> computed = o[op::rotate_point_any_norm](Q, p);
      judged_value(r, {op::rotate_point_any_norm[block::point]}, 0, computed, exact.resolved, [&] {
        r.record(op::rotate_point_any_norm[block::point], 0,
                 oracles::vector_error(r.scalar(), oracles::exact_vector<3, Real>(computed), exact.value));
      });
    }
    if (!o[op::log3_any_norm]) return;
    const auto exact = oracles::log_so3(Qx);
    Vec<double, 6> xi;
    xi << Vec<double, 3>::Zero(), o[op::log3_any_norm](Q);
    constexpr Output output = op::log3_any_norm[block::rotation_vector];
    const std::size_t band = band_of_log(r.scalar(), exact);
    record_log(r, {output}, band, xi, exact, side_of(r, output, band));
  }

 private:
  template <class Real>
  static void record_normalize(Recorder& r, const Vec<double, 4>& computed,
                               const oracles::Quaternion<Real>& Q) {
    constexpr Output quaternion = op::normalize[block::quaternion],
                     defect = op::normalize[block::norm_defect];
    const auto exact = oracles::normalize(Q);
    judged_value(r, {quaternion, defect}, 0, computed, exact.resolved, [&] {
      const auto unit = oracles::exact_vector<4, Real>(computed);
      r.record(quaternion, 0,
               oracles::vector_error(r.scalar(), unit, nearer_sign(r, quaternion, unit, exact.value)));
      r.record(defect, 0, oracles::norm_defect(r.scalar(), unit));
    });
  }
  template <class Real>
  static void record_matrix(Recorder& r, const Mat<double, 3>& computed, const oracles::Quaternion<Real>& Q) {
    constexpr Output entry = op::matrix_from_quaternion_any_norm[block::entry];
    const auto exact = oracles::matrix_from_quaternion(Q);
    judged_value(r, {entry}, 0, computed, exact.resolved, [&] {
      const auto E = oracles::exact_matrix<3, 3, Real>(computed) - exact.value;
      double error = 0;
      for (const Real& x : E.x) error = std::max(error, oracles::in_eps(r.scalar(), Real(abs(x))));
      r.record(entry, 0, error);
    });
  }
};

const RegisteredProperty<AnyNorm> registered_any_norm;

}  // namespace
}  // namespace liecheck::properties

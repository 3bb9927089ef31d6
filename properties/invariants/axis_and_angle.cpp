// Axis and angle of a rotation, both ways. The pair is compared by its product, the rotation vector: an angle of
// 2 pi - theta about the opposite axis is the same turn.

#include <generators/rotations.hpp>
#include <invariants/branch.hpp>
#include <oracles/exp.hpp>
#include <oracles/log.hpp>

namespace liecheck::properties {
namespace {

class AxisAndAngle final : public SlowLaw<AxisAndAngle> {
 public:
  static constexpr TwoOutputs of_quaternion{op::axis_angle_from_quaternion[block::rotation_vector],
                                            op::axis_angle_from_quaternion[block::norm_defect]},
      of_matrix{op::axis_angle_from_matrix[block::rotation_vector],
                op::axis_angle_from_matrix[block::norm_defect]},
      to_quaternion = rotation_and_norm(op::quaternion_from_axis_angle),
      to_matrix = rotation_and_defect(op::matrix_from_axis_angle);
  static constexpr Statement stated{
      .name = "axis_and_angle",
      .law = "a rotation turns by its angle about its axis",
      .equation = "Q = +-(sin(theta/2) n, cos(theta/2)), R = exp(theta [n]), 0 <= theta <= pi, |n| = 1",
      .source = "Shuster 1993, A survey of attitude representations",
      .outputs = {of_quaternion[0], of_quaternion[1], of_matrix[0], of_matrix[1], to_quaternion[0],
                  to_quaternion[1], to_matrix[0], to_matrix[1]},
      .fields = {{"Q", Kind::quaternion, 4, "1"},
                 {"R", Kind::rotation_matrix, 9, "1"},
                 {"axis", Kind::direction, 3, "1"},
                 {"angle", Kind::angle, 1, "rad", Reach::any}}};

  template <class S>
  std::vector<S> draw(Source& source) const {
    const auto Q = unit_quaternion<S>(source);
    std::vector<S> x = Joined<S>{Q, rotation_matrix<S>(Q), direction<S>(source)};
    const S turn = angle<S>(source, AngleRange::to_pi);
    x.push_back(source.chance(1, 2) ? turn : S(-turn));
    return x;
  }
  bool valid(const std::vector<double>& input) const override {
    return Property::valid(input) && unit_direction_at(scalar(), input, 13);
  }
  void in(const Subject& subject, const std::vector<double>& input, Recorder& r) const {
    const auto& o = subject.operations;
    Reader read(input);
    const Vec<double, 4> Q = read.take<4>();
    const Mat<double, 3> R = read.take_matrix();
    const Vec<double, 3> axis = read.take<3>();
    const double turn = read.take<1>()[0];
    if (o[op::axis_angle_from_quaternion]) {
      const auto exact = oracles::log_so3(oracles::exact_vector<4>(Q));
      const std::size_t band = band_of_log(r.scalar(), exact);
      record_pair(r, of_quaternion, band, o[op::axis_angle_from_quaternion](Q), exact,
                  side_of(r, of_quaternion[0], band));
    }
    if (o[op::axis_angle_from_matrix]) {
      const auto exact =
          oracles::log_se3_matrix(oracles::exact_matrix<3, 3>(R), oracles::zero_vector<3, Real>());
      record_pair(r, of_matrix, band_of_log(r.scalar(), exact), o[op::axis_angle_from_matrix](R), exact,
                  Side::either);
    }
    if (!o[op::quaternion_from_axis_angle] && !o[op::matrix_from_axis_angle]) return;
    const auto n = oracles::exact_vector<3>(axis);
    const Real theta = oracles::exact<Real>(turn);
    const auto e = oracles::exp_so3(Real(theta / norm(n)) * n);
    const oracles::Resolved<oracles::Quaternion<>> exact{e.Q, e.resolved};
    const std::size_t band = Bands::of(r.scalar()).classify(Real(abs(theta)));
    if (o[op::quaternion_from_axis_angle])
      record_rotation(r, to_quaternion, band, o[op::quaternion_from_axis_angle](axis, turn), exact);
    if (o[op::matrix_from_axis_angle])
      record_rotation(r, to_matrix, band, o[op::matrix_from_axis_angle](axis, turn), exact);
  }

 private:
  /// Ordinary code may return 2 pi - theta about the opposite axis, and any axis with the angle 0.
  static void record_pair(Recorder& r, const TwoOutputs& outputs, std::size_t band,
                          const Vec<double, 4>& computed, const oracles::LogResult& value, Side side) {
    judged_value(r, {outputs[0], outputs[1]}, band, computed, value.resolved, [&] {
      using namespace oracles;
      const Vec3<> axis = exact_vector<3>(computed);
      const Real turn = exact<Real>(computed[3]), length = norm(axis);
      const Vec3<> phi = length == 0 ? Vec3<>(zero_vector<3, Real>()) : Vec3<>(Real(turn / length) * axis);
      const LogResult exact = [&] {
        LogResult e = value;
        if (side == Side::either) static_cast<LogValue<Real>&>(e) = at_side_of(r.scalar(), phi, value);
        return e;
      }();
      double error = std::min(vector_error(r.scalar(), phi, exact.phi),
                              exact.at_pi ? vector_error(r.scalar(), phi, tail3(exact.other))
                                          : std::numeric_limits<double>::infinity());
      const bool ordinary = r.ordinary(outputs[0]);
      if (ordinary && exact.theta > 0) {
        const Vec3<> longer = Real(-(exact.theta + 2 * exact.pi_minus_theta) / exact.theta) * exact.phi;
        error = std::min(error, vector_error(r.scalar(), phi, longer));
      } else if (ordinary) {
        const Real full = 2 * (exact.theta + exact.pi_minus_theta);
        error = std::min(error, in_eps(r.scalar(), abs(Real(abs(turn) / full - 1))));
      }
      r.record(outputs[0], band, error);
      r.record(outputs[1], band, ordinary && turn == 0 ? 0 : in_eps(r.scalar(), abs(Real(length - 1))));
    });
  }
};

const RegisteredProperty<AxisAndAngle> registered_axis_and_angle;

}  // namespace
}  // namespace liecheck::properties

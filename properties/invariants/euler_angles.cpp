// Euler angles in all 24 orders. The rotation of given angles is compared with the exact product. The angles of a
// rotation are judged by the rotation that they give back, and by their ranges: at gimbal lock many triples are right.

#include <generators/rotations.hpp>
#include <invariants/common.hpp>
#include <numeric>
#include <operations/argument_kinds.hpp>
#include <oracles/orientations.hpp>

namespace liecheck::properties {
namespace {

class EulerAngles final : public SlowLaw<EulerAngles> {
 public:
  static constexpr Statement stated{
      .name = "euler_angles",
      .law = "Euler angles in any order are the product of three rotations about axes, and are found from it",
      .equation = "R = R_i(a) R_j(b) R_k(c) for rotating axes, R_k(c) R_j(b) R_i(a) for static axes",
      .source = "Diebel 2006, sections 5.6 and 8",
      .outputs = {op::euler_to_quaternion[block::rotation], op::euler_to_quaternion[block::norm_defect],
                  op::euler_to_matrix[block::rotation], op::euler_to_matrix[block::orthogonality_defect],
                  op::euler_from_quaternion[block::rotation], op::euler_from_quaternion[block::range],
                  op::euler_from_matrix[block::rotation], op::euler_from_matrix[block::range]},
      .fields = {{"order", Kind::choice, 1, "1"},
                 {"angles", Kind::angle, 3, "rad"},
                 {"Q", Kind::quaternion, 4, "1", Reach::any},
                 {"R", Kind::rotation_matrix, 9, "1", Reach::any}}};

  template <class S>
  std::vector<S> draw(Source& source) const {
    const int number = orders_[source.below(orders_.size())];
    Vec<S, 3> angles;
    for (int i = 0; i < 3; ++i) angles[i] = angle_of<S>(source);
    const Vec<S, 4> Q =
        source.chance(1, 4) ? unit_quaternion<S>(source) : near_lock<S>(source, oracles::Order(number));
    std::vector<S> x{S(number)};
    append(x, angles), append(x, Q), append(x, rotation_matrix<S>(Q));
    return x;
  }
  std::string draw_for(const Subject& subject) override {
    orders_.clear();
    for (int order = 0; order < 24; ++order)
      if (subject.takes.orders >> order & 1) orders_.push_back(order);
    return text_of(order_kinds, "orders", subject.takes.orders);
  }
  bool valid(const std::vector<double>& input) const override {
    return Property::valid(input) && input[0] == std::floor(input[0]) && input[0] >= 0 && input[0] < 24;
  }
  void in(const Subject& subject, const std::vector<double>& input, Recorder& r) const {
    const auto& o = subject.operations;
    Reader read(input);
    const double order = read.take<1>()[0];
    const Vec<double, 3> angles = read.take<3>();
    const Vec<double, 4> Q = read.take<4>();
    const Mat<double, 3> R = read.take_matrix();
    const oracles::Order exact_order(static_cast<int>(order));
    if (o[op::euler_to_quaternion] || o[op::euler_to_matrix]) {
      const auto exact = oracles::euler(exact_order, oracles::exact_vector<3>(angles));
      if (o[op::euler_to_quaternion]) {
        constexpr Output rotation = op::euler_to_quaternion[block::rotation],
                         defect = op::euler_to_quaternion[block::norm_defect];
        unless_refused(r, {rotation, defect}, [&] {
          const Vec<double, 4> computed = o[op::euler_to_quaternion](order, angles);
          judged_value(r, {rotation, defect}, 0, computed, exact.resolved, [&] {
            r.record(rotation, 0,
                     oracles::rotation_error(r.scalar(), oracles::exact_vector<4>(computed), exact.value));
            r.record(defect, 0, oracles::norm_defect(r.scalar(), oracles::exact_vector<4>(computed)));
          });
        });
      }
      if (o[op::euler_to_matrix]) {
        constexpr Output rotation = op::euler_to_matrix[block::rotation],
                         defect = op::euler_to_matrix[block::orthogonality_defect];
        unless_refused(r, {rotation, defect}, [&] {
          const Mat<double, 3> computed = o[op::euler_to_matrix](order, angles);
          judged_value(r, {rotation, defect}, 0, computed, exact.resolved, [&] {
            const auto errors =
                oracles::matrix_errors(r.scalar(), oracles::exact_matrix<3, 3>(computed), exact.value);
            r.record(rotation, 0, errors.rotation);
            r.record(defect, 0, errors.defect);
          });
        });
      }
    }
    if (o[op::euler_from_quaternion]) {
      constexpr TwoOutputs outputs{op::euler_from_quaternion[block::rotation],
                                   op::euler_from_quaternion[block::range]};
      unless_refused(r, outputs, [&] {
        record_angles(r, outputs, exact_order, o[op::euler_from_quaternion](order, Q),
                      oracles::normalized(oracles::exact_vector<4>(Q)), true);
      });
    }
    if (!o[op::euler_from_matrix]) return;
    constexpr TwoOutputs outputs{op::euler_from_matrix[block::rotation], op::euler_from_matrix[block::range]};
    unless_refused(r, outputs, [&] {
      const Vec<double, 3> computed = o[op::euler_from_matrix](order, R);
      const auto nearest = oracles::nearest_quaternion(oracles::exact_matrix<3, 3, oracles::Real100>(R));
      record_angles(r, outputs, exact_order, computed, oracles::cast<Real>(nearest.Q), nearest.resolved);
    });
  }

 private:
  std::vector<int> orders_ = [] {
    std::vector<int> all(24);
    std::iota(all.begin(), all.end(), 0);
    return all;
  }();
  /// Orders that an adapter refuses at every probe are outside its domain. What it refuses in another order, such as angles
  /// near gimbal lock, is a rotation that it must answer. A range other than the one that it states is a wrong branch.
  template <class F>
  static void unless_refused(Recorder& r, const TwoOutputs& outputs, F measured) {
    try {
      measured();
    } catch (const CallFailed& e) {
      if (e.outcome != Outcome::refused && e.outcome != Outcome::outside_domain &&
          e.outcome != Outcome::wrong_branch)
        throw;
      for (const Output& output : outputs) r.outcome(output, 0, e.outcome);
    }
  }
  /// A multiple of pi/2, within 4 ulp of one, near one, small, or any.
  template <class S>
  static S angle_of(Source& source) {
    const S pi = boost::math::constants::pi<S>(), quarter = pi / S(2),
            at = S(source.between(-2, 2)) * quarter;
    const S near = binade_uniform<S>(source, -std::numeric_limits<S>::digits - 8, -10);
    S x;
    switch (source.below(8)) {
      case 0:
        x = at;
        break;
      case 1:
        x = step_ulps(at, source.between(-4, 4));
        break;
      case 2:
      case 3:
        x = source.chance(1, 2) ? S(at + near) : S(at - near);
        break;
      case 4:
        return source.chance(1, 2) ? near : S(-near);
      default:
        x = pi * source.symmetric<S>();
    }
    return std::clamp(x, S(-pi), pi);
  }
  /// A product of three turns about the axes, whose middle one is at gimbal lock or near it, without any sine.
  template <class S>
  static Vec<S, 4> near_lock(Source& source, const oracles::Order& order) {
    using std::sqrt;
    Vec<S, 4> Q = Vec<S, 4>::Unit(3);
    for (int n = 0; n < 3; ++n) {
      S s = source.symmetric<S>(), c = source.symmetric<S>();
      if (!(s * s + c * c > S(1) / S(64))) c = S(1);
      if (n == 1) {  // half of pi/2, 0 or pi
        const bool proper = order.axes[0] == order.axes[2];
        const S near = source.chance(1, 4)
                           ? S(0)
                           : S(source.symmetric<S>() *
                               binade_uniform<S>(source, -std::numeric_limits<S>::digits - 4, -1));
        const S sign = source.chance(1, 2) ? S(1) : S(-1);
        s = proper ? near : S(sign * (S(1) + near)), c = S(1);
        if (proper && source.chance(1, 2)) std::swap(s, c);
      }
      Vec<S, 4> turn = Vec<S, 4>::Zero();
      const S length = S(sqrt(S(s * s + c * c)));
      turn[order.axes[static_cast<std::size_t>(n)]] = s / length, turn[3] = c / length;
      Q = order.rotating ? quaternion_product<S>(Q, turn) : quaternion_product<S>(turn, Q);
    }
    return Q / S(sqrt(Q.squaredNorm()));
  }
  static void record_angles(Recorder& r, const TwoOutputs& outputs, const oracles::Order& order,
                            const Vec<double, 3>& angles, const oracles::Quaternion<>& Q, bool resolved) {
    oracles::Resolved<oracles::Quaternion<>> back;
    if (oracles::all_finite(angles)) back = oracles::euler(order, oracles::exact_vector<3>(angles));
    judged_value(r, {outputs[0], outputs[1]}, 0, angles, resolved && back.resolved, [&] {
      r.record(outputs[0], 0, oracles::rotation_error(r.scalar(), back.value, Q));
      const bool proper = order.axes[0] == order.axes[2];
      const oracles::Scalar& s = r.scalar();
      const double half = s.pi / 2;
      const auto beyond = [&s](double x, double low, double high) {  // with the roundings of the scalar
        return std::max({0.0, s.rounded(x - high), s.rounded(low - x)});
      };
      const double most = std::max({beyond(angles[0], -s.pi, s.pi), beyond(angles[2], -s.pi, s.pi),
                                    beyond(angles[1], proper ? 0 : -half, proper ? s.pi : half)});
      // The range of ordinary code is a choice: conventions/choices.hpp.
      r.record(outputs[1], 0, !r.ordinary(outputs[1]) && most > 2 * s.epsilon * s.pi ? most / s.epsilon : 0);
    });
  }
};

const RegisteredProperty<EulerAngles> registered_euler_angles;

}  // namespace
}  // namespace liecheck::properties

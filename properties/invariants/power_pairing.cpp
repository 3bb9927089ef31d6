// Power does not depend on the frame, because motions and forces are dual. The law computes the power
// F_A^T V_A of the subject's results exactly. It also compares each operation with its oracle, because errors
// of V_A and F_A may cancel in the power.

#include <invariants/common.hpp>

#include <boost/multiprecision/eigen.hpp>
#include <generators/rotations.hpp>

namespace liecheck::properties {
namespace {

class PowerPairing final : public Law<PowerPairing> {
 public:
  static constexpr bool needs_kappa = true;  ///< nearly every case needs it
  static constexpr Statement stated{
      .name = "power_pairing",
      .law = "power is the same in every frame",
      .equation =
          "F_A^T V_A = F_B^T V_B, V_A = X V_B, F_A = X^-T F_B; scale |f| (|u| + |p||w|) + (|n| + |p||f|) "
          "|w|",
      .source = "Featherstone 2008, eq. 2.7, sections 2.8, 2.9, table 2.2",
      .outputs = {op::act_motion[block::linear], op::act_motion[block::angular],
                  op::act_inverse_motion[block::linear], op::act_inverse_motion[block::angular],
                  op::act_force[block::linear], op::act_force[block::angular],
                  op::act_inverse_force[block::linear], op::act_inverse_force[block::angular],
                  op::cross_motion[block::linear], op::cross_motion[block::angular],
                  op::cross_force[block::linear], op::cross_force[block::angular], op::power[block::power],
                  op::rotate_point[block::point]},
      .fields = {{"R", Kind::rotation_matrix, 9, "1"},
                 {"p", Kind::vector, 3, "m"},
                 {"u", Kind::vector, 3, "m/s"},
                 {"omega", Kind::vector, 3, "rad/s"},
                 {"f", Kind::vector, 3, "N"},
                 {"n", Kind::vector, 3, "N m"},
                 {"u_W", Kind::vector, 3, "m/s"},
                 {"omega_W", Kind::vector, 3, "rad/s"},
                 {"Q", Kind::quaternion, 4, "1"}},
      .formed = {{&op::power, {&op::act_motion, &op::act_force}}}};

  template <class S>
  std::vector<S> draw(Source& source) const {
    std::vector<S> input;
    const Vec<S, 4> Q = unit_quaternion<S>(source);
    append(input, rotation_matrix<S>(Q));
    const std::uint64_t extreme = source.below(32);
    for (int i = 0; i < 7; ++i)  // p u w f n u_W w_W
      append(input, vector3<S>(source, extreme <= 1 ? 2 : std::numeric_limits<S>::max_exponent / 8));
    append(input, Q);
    // Units in which velocities, or lengths, are tiny or their squares overflow, but no product of the law.
    // Lengths are not subnormal: their last digit is then larger than eps, and a velocity multiplies it.
    if (extreme <= 1) {
      const int most = largest_exponent<S>;
      const int e = source.between(extreme == 0 ? least_exponent<S> : -most, most),
                inverse = std::min(-e, most);
      if (extreme == 0)
        scale(input, {{12, 6, e}, {18, 12, inverse}});
      else
        scale(input, {{9, 3, e}, {15, 3, inverse}, {21, 3, e}, {27, 3, e}});
    }
    return input;
  }
  bool valid(const std::vector<double>& input) const override {
    if (!oracles::all_finite(input)) return false;
    Reader reader(input);
    const auto R = oracles::exact_matrix<3, 3, Real>(reader.take_matrix());
    const auto length = [&reader] { return Real(norm(oracles::exact_vector<3, Real>(reader.take<3>()))); };
    const Real p = length(), u = length(), w = length(), f = length(), n = length(), u_W = length(),
               w_W = length(), a = u + p * w, b = n + p * f;
    // Every product of the law, and every number, is finite.
    const Real largest = oracles::two_to<Real>(scalar().max_exponent - 8);
    for (const Real& product :
         {a, b, Real(f * a + b * w), Real(w * (u_W + w_W + f + n) + u * (w_W + f)), Real(u_W + w_W)})
      if (product > largest) return false;
    const auto Q = oracles::exact_vector<4, Real>(reader.take<4>());
    const Real slack = 32 * scalar().epsilon;
    return oracles::orthogonality_distance(R) <= slack && determinant(R, cofactors(R)) > 0 &&
           oracles::norm_distance(Q) <= slack;
  }

  template <class Real>
  void in(const Subject& subject, const std::vector<double>& input, Recorder& recorder) const {
    const auto& o = subject.operations;
    Reader reader(input);
    const Pose<double> X = reader.take_pose();
    const Vec<double, 6> V = reader.take<6>(), F = reader.take<6>(), W = reader.take<6>();
    const Vec<double, 4> Q = reader.take<4>();
    const auto X_e = exact_pose<Real>(X);
    const auto V_e = oracles::exact_vector<6, Real>(V), F_e = oracles::exact_vector<6, Real>(F),
               W_e = oracles::exact_vector<6, Real>(W);

    namespace formulas = oracles::formulas;
    using Vector6 = oracles::Vec6<Real>;
    using Numbers = std::vector<Real>;
    using Pose_e = oracles::PoseOf<Real>;
    using Result = oracles::Resolved<Vector6>;
    const auto act = [&](const auto& operation, const TwoOutputs& blocks, const Vec<double, 6>& v,
                         const Vector6& v_e, Result (*oracle)(const Pose_e&, const Vector6&), bool of_force) {
      if (!operation) return;
      const Vec<double, 6> computed = operation(X, v);
      const Result exact = oracle(X_e, v_e);
      // The position is a lever arm of the angular velocity in a motion, and of the force in a wrench.
      // Below `least`, a rotated vector loses digits before it is multiplied by p.
      const Real least(recorder.scalar().least_denominator());
      const Real linear = norm(head3(v_e)), angular = norm(tail3(v_e)), p = norm(X_e.p);
      record_sum(recorder, blocks[0], Vec<double, 3>(computed.head<3>()), head3(exact.value), exact.resolved,
                 of_force ? linear : Real(linear + p * (angular + least)));
      record_sum(recorder, blocks[1], Vec<double, 3>(computed.tail<3>()), tail3(exact.value), exact.resolved,
                 of_force ? Real(angular + p * (linear + least)) : angular);
    };
    act(o[op::act_motion], linear_angular(op::act_motion), V, V_e, oracles::act_motion, false);
    act(o[op::act_inverse_motion], linear_angular(op::act_inverse_motion), V, V_e,
        oracles::act_inverse_motion, false);
    act(o[op::act_force], linear_angular(op::act_force), F, F_e, oracles::act_force, true);
    act(o[op::act_inverse_force], linear_angular(op::act_inverse_force), F, F_e, oracles::act_inverse_force,
        true);

    const auto cross = [&](const auto& operation, const TwoOutputs& blocks, const Vec<double, 6>& v,
                           const Vector6& v_e, Result (*oracle)(const Vector6&, const Vector6&),
                           Vector6 (*formula)(const Vector6&, const Vector6&)) {
      if (!operation) return;
      const Vec<double, 6> computed = operation(V, v);
      const Result exact = oracle(V_e, v_e);
      const auto of = [formula](const Numbers& x) {
        return to_list(formula(from_list<6>(x), from_list<6>(x, 6)));
      };
      const auto x = [&] { return to_list(V_e, v_e); };
      record_vector(recorder, blocks[0], Vec<double, 3>(computed.head<3>()), head3(exact.value),
                    exact.resolved, of, x, 2);
      record_vector(recorder, blocks[1], Vec<double, 3>(computed.tail<3>()), tail3(exact.value),
                    exact.resolved, of, x, 2, 3);
    };
    cross(o[op::cross_motion], linear_angular(op::cross_motion), W, W_e, oracles::cross_motion,
          formulas::cross_motion);
    cross(o[op::cross_force], linear_angular(op::cross_force), F, F_e, oracles::cross_force,
          formulas::cross_force);

    if (o[op::act_motion] && o[op::act_force]) {
      const Vec<double, 6> V_A = o[op::act_motion](X, V), F_A = o[op::act_force](X, F);
      measure_power(recorder, X_e, V_e, F_e, V_A, F_A);
    }
    if (o[op::rotate_point]) {
      const auto Q_e = oracles::exact_vector<4, Real>(Q);
      const auto exact = oracles::rotate_point(Q_e, X_e.p);
      record_vector(
          recorder, op::rotate_point[block::point], Vec<double, 3>(o[op::rotate_point](Q, X.p)), exact.value,
          exact.resolved,
          [](const Numbers& x) { return to_list(oracles::rotate(from_list<4>(x), from_list<3>(x, 4))); },
          [&] { return to_list(Q_e, X_e.p); }, 1);
    }
  }

 private:
  template <class Real>
  static void measure_power(Recorder& recorder, const oracles::PoseOf<Real>& X,
                            const oracles::Vec6<Real>& V_B, const oracles::Vec6<Real>& F_B,
                            const Vec<double, 6>& V_A, const Vec<double, 6>& F_A) {
    constexpr Output output = op::power[block::power];
    if (!oracles::all_finite(V_A) || !oracles::all_finite(F_A))
      return recorder.outcome(output, 0, Outcome::not_finite);
    const auto A = oracles::power(oracles::exact_vector<6, Real>(F_A), oracles::exact_vector<6, Real>(V_A));
    const auto B = oracles::power(F_B, V_B);
    if (!A.resolved || !B.resolved) return recorder.outcome(output, 0, Outcome::unresolved);
    // A smaller number is rounded to eps times the smallest normal number.
    const Real normal = oracles::two_to<Real>(recorder.scalar().min_exponent - 1);
    const Real p = norm(X.p), u = norm(head3(V_B)) + normal, w = norm(tail3(V_B)) + normal,
               f = norm(head3(F_B)) + normal, n = norm(tail3(F_B)) + normal;
    const Real scale = f * (u + p * w) + (n + p * f) * w;
    recorder.record(output, 0, oracles::scalar_error(recorder.scalar(), A.value, B.value, scale),
                    [] { return 1.0; });
  }
};

const RegisteredProperty<PowerPairing> registered_power_pairing;

}  // namespace
}  // namespace liecheck::properties

// Power does not depend on the frame: motions and forces are dual. The power F_A^T V_A of the subject's
// results is computed exactly. Each operation is also compared with its oracle, because errors of V_A and F_A
// may cancel in the power.

#include <invariants/common.hpp>

#include <algorithm>
#include <boost/multiprecision/eigen.hpp>
#include <generators/rotations.hpp>

namespace liecheck::properties {
namespace {

/// Reads the pose from a formula's arguments (R, p, then V or F).
template <class T>
oracles::PoseOf<T> pose(const std::vector<T>& x) {
  oracles::PoseOf<T> X;
  std::copy_n(x.begin(), 9, X.R.x.begin());
  std::copy_n(x.begin() + 9, 3, X.p.x.begin());
  return X;
}
template <class T>
oracles::Vec6<T> six(const std::vector<T>& x, std::size_t first) {
  oracles::Vec6<T> v;
  std::copy_n(x.begin() + static_cast<std::ptrdiff_t>(first), 6, v.x.begin());
  return v;
}
template <class T, class... V>
std::vector<T> numbers(const V&... v) {
  std::vector<T> x;
  (x.insert(x.end(), v.x.begin(), v.x.end()), ...);
  return x;
}

template <class S>
class PowerPairing final : public Law<PowerPairing, S> {
 public:
  static constexpr bool needs_kappa = true;  ///< in nearly every case
  std::string name() const override { return "power_pairing"; }
  std::string law() const override { return "power is the same in every frame"; }
  std::string equation() const override {
    return "F_A^T V_A = F_B^T V_B, V_A = X V_B, F_A = X^-T F_B; scale |f| (|u| + |p||w|) + (|n| + |p||f|) "
           "|w|";
  }
  std::string source() const override { return "Featherstone 2008, eq. 2.7, sections 2.8, 2.9, table 2.2"; }

  std::vector<Output> outputs() const override {
    return {op::act_motion[block::linear],
            op::act_motion[block::angular],
            op::act_inverse_motion[block::linear],
            op::act_inverse_motion[block::angular],
            op::act_force[block::linear],
            op::act_force[block::angular],
            op::act_inverse_force[block::linear],
            op::act_inverse_force[block::angular],
            op::cross_motion[block::linear],
            op::cross_motion[block::angular],
            op::cross_force[block::linear],
            op::cross_force[block::angular],
            op::power[block::power],
            op::rotate_point[block::point]};
  }
  std::vector<Field> fields() const override {
    return {{"R", Kind::rotation_matrix, 9, "1"}, {"p", Kind::vector, 3, "m"},
            {"u", Kind::vector, 3, "m/s"},        {"omega", Kind::vector, 3, "rad/s"},
            {"f", Kind::vector, 3, "N"},          {"n", Kind::vector, 3, "N m"},
            {"u_W", Kind::vector, 3, "m/s"},      {"omega_W", Kind::vector, 3, "rad/s"},
            {"Q", Kind::quaternion, 4, "1"}};
  }
  bool offered(const Subject<S>& subject) const override {
    const auto& o = subject.operations;
    return o[op::act_motion] || o[op::act_inverse_motion] || o[op::act_force] || o[op::act_inverse_force] ||
           o[op::cross_motion] || o[op::cross_force] || o[op::rotate_point];
  }
  std::vector<S> generate(Source& source) const override {
    std::vector<S> input;
    const Vec<S, 4> Q = unit_quaternion<S>(source);
    append(input, rotation_matrix<S>(Q));
    for (int i = 0; i < 7; ++i) append(input, vector3<S>(source, binades));  // p u w f n u_W w_W
    append(input, Q);
    return input;
  }
  bool valid(const std::vector<S>& input) const override {
    using std::abs, std::ldexp;
    if (!Property<S>::valid(input)) return false;
    const S largest = S(ldexp(S(1), binades + 2));
    for (const S& x : input)
      if (S(abs(x)) > largest) return false;
    Reader<S> reader(input);
    const auto R = oracles::exact_matrix<3, 3, Real>(reader.take_matrix());
    reader.template take<21>();
    const auto Q = oracles::exact_vector<4, Real>(reader.template take<4>());
    const Real slack = 32 * oracles::epsilon<S>();
    return oracles::orthogonality_distance(R) <= slack && determinant(R, cofactors(R)) > 0 &&
           oracles::norm_distance(Q) <= slack;
  }

  template <class Real>
  void in(const Subject<S>& subject, const std::vector<S>& input, Recorder& recorder) const {
    const auto& o = subject.operations;
    Reader<S> reader(input);
    Pose<S> X;
    X.R = reader.take_matrix();
    X.p = reader.template take<3>();
    const Vec<S, 6> V = reader.template take<6>(), F = reader.template take<6>(),
                    W = reader.template take<6>();
    const Vec<S, 4> Q = reader.template take<4>();

    using Vector6 = oracles::Vec6<Real>;
    using Transform = oracles::PoseOf<Real>;
    const Transform X_e{oracles::exact_matrix<3, 3, Real>(X.R), oracles::exact_vector<3, Real>(X.p)};
    const auto V_e = oracles::exact_vector<6, Real>(V), F_e = oracles::exact_vector<6, Real>(F),
               W_e = oracles::exact_vector<6, Real>(W);

    const auto act = [&](const auto& operation, const Output& linear, const Output& angular,
                         const Vec<S, 6>& v, const Vector6& v_e, auto oracle, auto formula) {
      if (!o[operation]) return;
      compare(
          recorder, linear, angular, Vec<S, 6>(o[operation](X, v)), [&] { return oracle(X_e, v_e); },
          [&](const std::vector<Real>& x) { return numbers<Real>(formula(pose(x), six(x, 12))); },
          [&] { return numbers<Real>(X_e.R, X_e.p, v_e); });
    };
    act(
        op::act_motion, op::act_motion[block::linear], op::act_motion[block::angular], V, V_e,
        [](const Transform& Y, const Vector6& v) { return oracles::act_motion(Y, v); },
        [](const Transform& Y, const Vector6& v) { return oracles::formulas::act_motion(Y, v); });
    act(
        op::act_inverse_motion, op::act_inverse_motion[block::linear], op::act_inverse_motion[block::angular],
        V, V_e, [](const Transform& Y, const Vector6& v) { return oracles::act_inverse_motion(Y, v); },
        [](const Transform& Y, const Vector6& v) { return oracles::formulas::act_inverse_motion(Y, v); });
    act(
        op::act_force, op::act_force[block::linear], op::act_force[block::angular], F, F_e,
        [](const Transform& Y, const Vector6& v) { return oracles::act_force(Y, v); },
        [](const Transform& Y, const Vector6& v) { return oracles::formulas::act_force(Y, v); });
    act(
        op::act_inverse_force, op::act_inverse_force[block::linear], op::act_inverse_force[block::angular], F,
        F_e, [](const Transform& Y, const Vector6& v) { return oracles::act_inverse_force(Y, v); },
        [](const Transform& Y, const Vector6& v) { return oracles::formulas::act_inverse_force(Y, v); });
    if (o[op::cross_motion])
      compare(
          recorder, op::cross_motion[block::linear], op::cross_motion[block::angular],
          Vec<S, 6>(o[op::cross_motion](V, W)), [&] { return oracles::cross_motion(V_e, W_e); },
          [](const std::vector<Real>& x) {
            return numbers<Real>(oracles::formulas::cross_motion(six(x, 0), six(x, 6)));
          },
          [&] { return numbers<Real>(V_e, W_e); });
    if (o[op::cross_force])
      compare(
          recorder, op::cross_force[block::linear], op::cross_force[block::angular],
          Vec<S, 6>(o[op::cross_force](V, F)), [&] { return oracles::cross_force(V_e, F_e); },
          [](const std::vector<Real>& x) {
            return numbers<Real>(oracles::formulas::cross_force(six(x, 0), six(x, 6)));
          },
          [&] { return numbers<Real>(V_e, F_e); });

    if (o[op::act_motion] && o[op::act_force]) {
      const Vec<S, 6> V_A = o[op::act_motion](X, V), F_A = o[op::act_force](X, F);
      measure_power(recorder, X_e, V_e, F_e, V_A, F_A);
    }
    if (o[op::rotate_point]) measure_rotation(recorder, Q, o[op::rotate_point](Q, X.p), X_e.p);
  }

 private:
  static constexpr int binades = std::numeric_limits<S>::max_exponent / 8;

  template <class Real>
  static double kappa(const oracles::FunctionOf<Real>& formula, const std::vector<Real>& x, int first,
                      const oracles::Vec3<Real>& exact) {
    return std::max(1.0, kappa_of<Real>(formula, x, first, 3,
                                        oracles::larger(norm(exact), oracles::least_denominator<S, Real>())));
  }

  /// Records both blocks of a vector.
  template <class Oracle, class Formula, class Numbers>
  static void compare(Recorder& recorder, const Output& linear, const Output& angular,
                      const Vec<S, 6>& computed, Oracle&& oracle, const Formula& formula, Numbers&& x) {
    const bool finite[2] = {oracles::all_finite(Vec<S, 3>(computed.template head<3>())),
                            oracles::all_finite(Vec<S, 3>(computed.template tail<3>()))};
    const auto exact = oracle();
    using Real = std::decay_t<decltype(exact.value[0])>;
    for (int block = 0; block < 2; ++block) {
      const Output& output = block == 0 ? linear : angular;
      if (!finite[block]) {
        recorder.outcome(output, 0, Outcome::not_finite);
      } else if (!exact.resolved) {
        recorder.outcome(output, 0, Outcome::unresolved);
      } else {
        const oracles::Vec3<Real> value = block == 0 ? head3(exact.value) : tail3(exact.value);
        const Vec<S, 3> part = computed.template segment<3>(3 * block);
        recorder.record(output, 0, oracles::vector_error<S>(oracles::exact_vector<3, Real>(part), value),
                        [&] { return kappa<Real>(formula, x(), 3 * block, value); });
      }
    }
  }

  template <class Real>
  static void measure_rotation(Recorder& recorder, const Vec<S, 4>& Q, const Vec<S, 3>& y,
                               const oracles::Vec3<Real>& x) {
    constexpr Output output = op::rotate_point[block::point];
    if (!oracles::all_finite(y)) return recorder.outcome(output, 0, Outcome::not_finite);
    const auto Q_e = oracles::exact_vector<4, Real>(Q);
    const oracles::Resolved<oracles::Vec3<Real>> exact = oracles::rotate_point(Q_e, x);
    if (!exact.resolved) return recorder.outcome(output, 0, Outcome::unresolved);
    const double error = oracles::vector_error<S>(oracles::exact_vector<3, Real>(y), exact.value);
    recorder.record(output, 0, error, [&] {
      const auto formula = [](const std::vector<Real>& v) {
        return numbers<Real>(oracles::rotate(oracles::Quaternion<Real>{{v[0], v[1], v[2], v[3]}},
                                             oracles::Vec3<Real>{{v[4], v[5], v[6]}}));
      };
      return kappa<Real>(formula, numbers<Real>(Q_e, x), 0, exact.value);
    });
  }

  template <class Real>
  static void measure_power(Recorder& recorder, const oracles::PoseOf<Real>& X,
                            const oracles::Vec6<Real>& V_B, const oracles::Vec6<Real>& F_B,
                            const Vec<S, 6>& V_A, const Vec<S, 6>& F_A) {
    constexpr Output output = op::power[block::power];
    if (!oracles::all_finite(V_A) || !oracles::all_finite(F_A))
      return recorder.outcome(output, 0, Outcome::not_finite);
    const auto A = oracles::power(oracles::exact_vector<6, Real>(F_A), oracles::exact_vector<6, Real>(V_A));
    const auto B = oracles::power(F_B, V_B);
    if (!A.resolved || !B.resolved) return recorder.outcome(output, 0, Outcome::unresolved);
    const Real p = norm(X.p), u = norm(head3(V_B)), w = norm(tail3(V_B)), f = norm(head3(F_B)),
               n = norm(tail3(F_B));
    const Real scale = f * (u + p * w) + (n + p * f) * w;
    recorder.record(output, 0, oracles::scalar_error<S>(A.value, B.value, scale), [] { return 1.0; });
  }
};

const RegisteredProperty<PowerPairing> registered;

}  // namespace
}  // namespace liecheck::properties

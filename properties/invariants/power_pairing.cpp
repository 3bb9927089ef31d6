// Power does not depend on the frame: motions and forces are dual. The pairing is measured on the subject's own
// V_A and F_A, in exact arithmetic; each operation also against its oracle, since a pairing alone is kept by
// every pair of errors that cancel.

#include <invariants/property.hpp>

#include <algorithm>
#include <boost/multiprecision/eigen.hpp>
#include <generators/rotations.hpp>
#include <oracles/condition.hpp>
#include <oracles/error.hpp>
#include <oracles/spatial.hpp>

namespace liecheck::properties {
namespace {

using oracles::Real;
using Vector3 = oracles::Vec3<>;

/// The numbers x of one operation as its formula takes them.
Vector3 part(const std::vector<Real>& x, std::size_t first) {
  return {{x[first], x[first + 1], x[first + 2]}};
}
oracles::Mat3<> rotation(const std::vector<Real>& x) {
  oracles::Mat3<> R;
  std::copy_n(x.begin(), 9, R.x.begin());
  return R;
}
std::vector<Real> join(const Vector3& a, const Vector3& b) {
  return {a[0], a[1], a[2], b[0], b[1], b[2]};
}
template <class... V>
std::vector<Real> numbers(const V&... v) {
  std::vector<Real> x;
  (x.insert(x.end(), v.x.begin(), v.x.end()), ...);
  return x;
}

// The formulas at 50 digits, for condition numbers. A pose is x[0 ... 11], V or F x[12 ... 17].
std::vector<Real> motion_formula(const std::vector<Real>& x) {
  const auto R = rotation(x);
  const Vector3 w = R * part(x, 15);
  return join(R * part(x, 12) + cross(part(x, 9), w), w);
}
std::vector<Real> inverse_motion_formula(const std::vector<Real>& x) {
  const auto Rt = transpose(rotation(x));
  return join(Rt * (part(x, 12) - cross(part(x, 9), part(x, 15))), Rt * part(x, 15));
}
std::vector<Real> force_formula(const std::vector<Real>& x) {
  const auto R = rotation(x);
  const Vector3 f = R * part(x, 12);
  return join(f, R * part(x, 15) + cross(part(x, 9), f));
}
std::vector<Real> inverse_force_formula(const std::vector<Real>& x) {
  const auto Rt = transpose(rotation(x));
  return join(Rt * part(x, 12), Rt * (part(x, 15) - cross(part(x, 9), part(x, 12))));
}
std::vector<Real> cross_motion_formula(const std::vector<Real>& x) {
  const Vector3 u = part(x, 0), w = part(x, 3), u_W = part(x, 6), w_W = part(x, 9);
  return join(cross(w, u_W) + cross(u, w_W), cross(w, w_W));
}
std::vector<Real> cross_force_formula(const std::vector<Real>& x) {
  const Vector3 u = part(x, 0), w = part(x, 3), f = part(x, 6), n = part(x, 9);
  return join(cross(w, f), cross(w, n) + cross(u, f));
}

template <class S>
class PowerPairing : public Property<S> {
 public:
  std::string name() const override { return "power_pairing"; }
  std::string law() const override { return "power is the same in every frame"; }
  std::string equation() const override {
    return "F_A^T V_A = F_B^T V_B, V_A = X V_B, F_A = X^-T F_B; scale |f| (|u| + |p||w|) + (|n| + |p||f|) "
           "|w|";
  }
  std::string source() const override { return "Featherstone 2008, eq. 2.7, sections 2.8, 2.9, table 2.2"; }

  std::vector<Output> outputs() const override {
    std::vector<Output> all;
    for (const char* operation : {"act_motion", "act_inverse_motion", "act_force", "act_inverse_force",
                                  "cross_motion", "cross_force"}) {
      all.push_back({operation, "linear"});
      all.push_back({operation, "angular"});
    }
    all.push_back({"power", "power"});
    all.push_back({"rotate_point", "point"});
    return all;
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
    return o.act_motion || o.act_inverse_motion || o.act_force || o.act_inverse_force || o.cross_motion ||
           o.cross_force || o.rotate_point;
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
    const auto R = oracles::exact_matrix<3, 3>(reader.take_matrix());
    reader.template take<21>();
    const auto Q = oracles::exact_vector<4>(reader.template take<4>());
    const Real slack = 32 * oracles::epsilon<S>();
    return oracles::orthogonality_distance(R) <= slack && determinant(R, cofactors(R)) > 0 &&
           oracles::norm_distance(Q) <= slack;
  }

  void measure(const Subject<S>& subject, const std::vector<S>& input, Recorder& recorder) const override {
    const auto& o = subject.operations;
    Reader<S> reader(input);
    Pose<S> X;
    X.R = reader.take_matrix();
    X.p = reader.template take<3>();
    const Vec<S, 6> V = reader.template take<6>(), F = reader.template take<6>(),
                    W = reader.template take<6>();
    const Vec<S, 4> Q = reader.template take<4>();

    const oracles::Pose X_e{oracles::exact_matrix<3, 3>(X.R), oracles::exact_vector<3>(X.p)};
    const auto V_e = oracles::exact_vector<6>(V), F_e = oracles::exact_vector<6>(F),
               W_e = oracles::exact_vector<6>(W);

    const auto act = [&](int output, auto* operation, const Vec<S, 6>& v, const oracles::Vec6<>& v_e,
                         auto oracle, auto formula) {
      if (!operation) return;
      compare(
          recorder, output, Vec<S, 6>(operation(X, v)), [&] { return oracle(X_e, v_e); }, formula,
          [&] { return numbers(X_e.R, X_e.p, v_e); });
    };
    act(0, o.act_motion, V, V_e, oracles::act_motion, motion_formula);
    act(2, o.act_inverse_motion, V, V_e, oracles::act_inverse_motion, inverse_motion_formula);
    act(4, o.act_force, F, F_e, oracles::act_force, force_formula);
    act(6, o.act_inverse_force, F, F_e, oracles::act_inverse_force, inverse_force_formula);
    if (o.cross_motion)
      compare(
          recorder, 8, Vec<S, 6>(o.cross_motion(V, W)), [&] { return oracles::cross_motion(V_e, W_e); },
          cross_motion_formula, [&] { return numbers(V_e, W_e); });
    if (o.cross_force)
      compare(
          recorder, 10, Vec<S, 6>(o.cross_force(V, F)), [&] { return oracles::cross_force(V_e, F_e); },
          cross_force_formula, [&] { return numbers(V_e, F_e); });

    if (o.act_motion && o.act_force) {
      const Vec<S, 6> V_A = o.act_motion(X, V), F_A = o.act_force(X, F);
      measure_power(recorder, X_e, V_e, F_e, V_A, F_A);
    }
    if (o.rotate_point) {
      const Vec<S, 3> y = o.rotate_point(Q, X.p);
      if (!oracles::all_finite(y)) return recorder.outcome(13, 0, Outcome::not_finite);
      const auto Q_e = oracles::exact_vector<4>(Q);
      const oracles::PointResult exact = oracles::rotate_point(Q_e, X_e.p);
      if (!exact.resolved) return recorder.outcome(13, 0, Outcome::unresolved);
      recorder.record(13, 0, oracles::vector_error<S>(oracles::exact_vector<3>(y), exact.value), [&] {
        const auto formula = [](const std::vector<Real>& x) {
          return numbers(oracles::rotate(oracles::Quaternion<>{{x[0], x[1], x[2], x[3]}}, part(x, 4)));
        };
        return kappa(formula, numbers(Q_e, X_e.p), 0, exact.value);
      });
    }
  }

 private:
  static constexpr int binades = std::numeric_limits<S>::max_exponent / 8;

  static double kappa(const oracles::Function& formula, const std::vector<Real>& x, int first,
                      const Vector3& exact) {
    const Real size = std::max(Real(norm(exact)), oracles::smallest_denominator<S>());
    return std::max(1.0, oracles::condition(formula, x, {{first, 3, size}}).front());
  }

  /// The linear block is `output`, the angular one the next.
  template <class Oracle, class Numbers>
  static void compare(Recorder& recorder, int output, const Vec<S, 6>& computed, Oracle&& oracle,
                      const oracles::Function& formula, Numbers&& x) {
    const bool finite[2] = {oracles::all_finite(Vec<S, 3>(computed.template head<3>())),
                            oracles::all_finite(Vec<S, 3>(computed.template tail<3>()))};
    const oracles::SpatialResult exact = oracle();
    for (int block = 0; block < 2; ++block) {
      if (!finite[block]) {
        recorder.outcome(output + block, 0, Outcome::not_finite);
      } else if (!exact.resolved) {
        recorder.outcome(output + block, 0, Outcome::unresolved);
      } else {
        const Vector3 value = block == 0 ? head3(exact.value) : tail3(exact.value);
        const Vec<S, 3> part = computed.template segment<3>(3 * block);
        recorder.record(output + block, 0, oracles::vector_error<S>(oracles::exact_vector<3>(part), value),
                        [&] { return kappa(formula, x(), 3 * block, value); });
      }
    }
  }

  static void measure_power(Recorder& recorder, const oracles::Pose& X, const oracles::Vec6<>& V_B,
                            const oracles::Vec6<>& F_B, const Vec<S, 6>& V_A, const Vec<S, 6>& F_A) {
    constexpr int output = 12;
    if (!oracles::all_finite(V_A) || !oracles::all_finite(F_A))
      return recorder.outcome(output, 0, Outcome::not_finite);
    const auto A = oracles::power(oracles::exact_vector<6>(F_A), oracles::exact_vector<6>(V_A));
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

// Extended poses of SE_2(3), and the preintegration of inertial measurements as two articles define it.

#include <generators/rotations.hpp>
#include <invariants/branch.hpp>
#include <oracles/navigation.hpp>
#include <oracles/representations.hpp>

namespace liecheck::properties {
namespace {

/// The R, p and v of an extended pose, and the rho, nu, phi of its tangent.
Mat<double, 3> rotation_in(const double* x) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(x);
}
Vec<double, 3> three_in(const double* x) {
  return Vec<double, 3>::Map(x);
}

class ExtendedPoses final : public Law<ExtendedPoses> {
 public:
  static constexpr TwoOutputs exp_rotation = rotation_and_defect(op::se23_exp),
                              exp_parts{op::se23_exp[block::translation], op::se23_exp[block::velocity]},
                              log_parts{op::se23_log[block::linear], op::se23_log[block::velocity]},
                              left = jacobian_outputs(op::se23_left_jacobian),
                              right = jacobian_outputs(op::se23_right_jacobian),
                              adjoint = jacobian_outputs(op::se23_adjoint);
  static constexpr Output log_rotation = op::se23_log[block::rotation_vector];
  static constexpr Statement stated{
      .name = "extended_poses",
      .law = "position and velocity of an extended pose are two translations with one rotation",
      .equation = "exp(rho, nu, phi) = (exp [phi], J_l rho, J_l nu); log is its inverse, |phi| <= pi",
      .source = "Brossard et al. 2022, Associating uncertainty to extended poses, eqs. 9-21",
      .outputs = {exp_rotation[0], exp_rotation[1], exp_parts[0], exp_parts[1], log_rotation, log_parts[0],
                  log_parts[1], left[0], left[1], right[0], right[1], adjoint[0], adjoint[1]},
      .fields = {{"R", Kind::rotation_matrix, 9, "1"},
                 {"p", Kind::vector, 3, "m"},
                 {"v", Kind::vector, 3, "m/s"},
                 {"rho", Kind::vector, 3, "m"},
                 {"nu", Kind::vector, 3, "m/s"},
                 {"phi", Kind::rotation_vector, 3, "rad"}}};

  template <class S>
  std::vector<S> draw(Source& source) const {
    const auto Q = unit_quaternion<S>(source);
    std::vector<S> x = Joined<S>{rotation_matrix<S>(Q)};
    for (int i = 0; i < 4; ++i) append(x, vector3<S>(source, std::numeric_limits<S>::max_exponent / 8));
    append(x, rotation_vector<S>(source, AngleRange::to_pi));
    return x;
  }
  /// exp and its Jacobians are judged where log is their inverse.
  bool valid(const std::vector<double>& input) const override {
    return Property::valid(input) &&
           std::hypot(input[21], input[22], input[23]) <= 3.141593;  // the float next to pi is more than pi
  }

  template <class Real>
  void in(const Subject& subject, const std::vector<double>& input, Recorder& r) const {
    using namespace oracles;
    const auto& o = subject.operations;
    const properties::Vec<double, 15> X = properties::Vec<double, 15>::Map(input.data());
    const properties::Vec<double, 9> xi = properties::Vec<double, 9>::Map(input.data() + 15);
    const auto three = [](const double* x) { return exact_vector<3, Real>(x); };
    const Vec3<Real> rho = three(&xi[0]), nu = three(&xi[3]), phi = three(&xi[6]);
    const std::size_t band = band_of_angle(r.scalar(), phi);
    if (o[op::se23_exp]) {
      const properties::Vec<double, 15> T = o[op::se23_exp](xi);
      const auto first = exp_se3(stack(rho, phi)), second = exp_se3(stack(nu, phi));
      record_rotation(r, exp_rotation, band, rotation_in(&T[0]),
                      Resolved<Quaternion<Real>>{first.Q, first.resolved});
      record_three(r, exp_parts[0], band, three_in(&T[9]), first.p, first.resolved);
      record_three(r, exp_parts[1], band, three_in(&T[12]), second.p, second.resolved);
    }
    if (o[op::se23_log]) {
      const properties::Vec<double, 9> computed = o[op::se23_log](X);
      const auto R = exact_matrix<3, 3, Real>(rotation_in(&X[0]));
      const auto first = log_se3_matrix(R, three(&X[9])), second = log_se3_matrix(R, three(&X[12]));
      const std::size_t at = band_of_log(r.scalar(), first);
      const auto both = [&](int from) {
        return (properties::Vec<double, 6>() << three_in(&computed[from]), three_in(&computed[6])).finished();
      };
      record_log(r, {log_rotation, log_parts[0]}, at, both(0), first, Side::either);
      // Its rotation is recorded once: the second call records that of the velocity alone.
      Once once(r, log_parts[1]);
      record_log(once, {log_rotation, log_parts[1]}, at, both(3), second, Side::either);
    }
    if (o[op::se23_left_jacobian])
      record_blocks(r, left, band, o[op::se23_left_jacobian](xi), left_jacobian_se3(stack(rho, phi)),
                    left_jacobian_se3(stack(nu, phi)));
    if (o[op::se23_right_jacobian])
      record_blocks(r, right, band, o[op::se23_right_jacobian](xi), right_jacobian_se3(stack(rho, phi)),
                    right_jacobian_se3(stack(nu, phi)));
    if (o[op::se23_adjoint]) {
      const auto R = exact_matrix<3, 3, Real>(rotation_in(&X[0]));
      record_blocks(r, adjoint, 0, o[op::se23_adjoint](X),
                    Jacobian6Value<Real>{R, hat(three(&X[9])) * R, true},
                    Jacobian6Value<Real>{R, hat(three(&X[12])) * R, true});
    }
  }

 private:
  /// Passes on what is recorded of one output.
  class Once final : public Recorder {
   public:
    Once(Recorder& to, const Output& output) : Recorder(to.scalar()), to_(to), output_(output) {}
    void record(const Output& output, std::size_t band, double error, Kappa kappa) override {
      if (output.block == output_.block) to_.record(output, band, error, kappa);
    }
    void outcome(const Output& output, std::size_t band, Outcome outcome) override {
      if (output.block == output_.block) to_.outcome(output, band, outcome);
    }
    double limit(const Output& output, std::size_t band) const override { return to_.limit(output, band); }
    bool ordinary(const Output& output) const override { return to_.ordinary(output); }

   private:
    Recorder& to_;
    const Output& output_;
  };

  template <class Real>
  static void record_three(Recorder& r, const Output& output, std::size_t band,
                           const Vec<double, 3>& computed, const oracles::Vec3<Real>& exact, bool resolved) {
    judged_value(r, {output}, band, computed, resolved, [&] {
      r.record(output, band,
               oracles::vector_error(r.scalar(), oracles::exact_vector<3, Real>(computed), exact));
    });
  }
  /// Of [[J, 0, A], [0, J, B], [0, 0, J]].
  template <class Real>
  static void record_blocks(Recorder& r, const TwoOutputs& outputs, std::size_t band, const Mat<double, 9>& J,
                            const oracles::Jacobian6Value<Real>& first,
                            const oracles::Jacobian6Value<Real>& second) {
    judged_value(r, {outputs[0], outputs[1]}, band, J, first.resolved && second.resolved, [&] {
      const auto error = [&](int i, int j, const oracles::Mat3<Real>& exact) {
        const Mat<double, 3> own = J.block<3, 3>(3 * i, 3 * j);
        return oracles::vector_error(r.scalar(), oracles::exact_matrix<3, 3, Real>(own), exact);
      };
      const auto zero = [&](int i, int j) { return J.block<3, 3>(3 * i, 3 * j).isZero(0); };
      const bool zeros = zero(0, 1) && zero(1, 0) && zero(2, 0) && zero(2, 1);
      r.record(outputs[0], band,
               zeros ? std::max({error(0, 0, first.J), error(1, 1, first.J), error(2, 2, first.J)})
                     : std::numeric_limits<double>::infinity());
      r.record(outputs[1], band, std::max(error(0, 2, first.C), error(1, 2, second.C)));
    });
  }
};

class Preintegration final : public SlowLaw<Preintegration> {
 public:
  static constexpr TwoOutputs forster_rotation = rotation_and_defect(op::preintegrate_forster),
                              brossard_rotation = rotation_and_defect(op::preintegrate_brossard),
                              forster_parts{op::preintegrate_forster[block::translation],
                                            op::preintegrate_forster[block::velocity]},
                              brossard_parts{op::preintegrate_brossard[block::translation],
                                             op::preintegrate_brossard[block::velocity]};
  using ThreeOutputs = std::array<Output, 3>;
  static constexpr ThreeOutputs forster_biases{op::forster_bias_jacobians[block::rotation],
                                               op::forster_bias_jacobians[block::translation],
                                               op::forster_bias_jacobians[block::velocity]},
      brossard_biases{op::brossard_bias_jacobians[block::rotation],
                      op::brossard_bias_jacobians[block::translation],
                      op::brossard_bias_jacobians[block::velocity]};
  static constexpr Statement stated{
      .name = "preintegration",
      .law =
          "inertial measurements add up to an increment of rotation, position and velocity, with its "
          "derivatives by "
          "the biases",
      .equation =
          "Forster: dp += dv dt + dR a dt^2/2, dv += dR a dt, dR <- dR exp(omega dt); Brossard: the exact "
          "motion",
      .source = "Forster et al. 2017, eqs. 35 and 63-70; Brossard et al. 2022, eqs. 28-33",
      .outputs = {forster_rotation[0], forster_rotation[1], forster_parts[0], forster_parts[1],
                  brossard_rotation[0], brossard_rotation[1], brossard_parts[0], brossard_parts[1],
                  forster_biases[0], forster_biases[1], forster_biases[2], brossard_biases[0],
                  brossard_biases[1], brossard_biases[2]},
      .fields = {{"gyro", Kind::vector, 9, "rad/s", Reach::any},
                 {"accelerometer", Kind::vector, 9, "m/s^2", Reach::any},
                 {"dt", Kind::positive, 1, "s", Reach::any}}};

  /// Turns of a measurement between 1e-9 and 2 rad, sometimes none, or about one axis.
  template <class S>
  std::vector<S> draw(Source& source) const {
    const S dt = source.chance(1, 3) ? S(1) / S(128) : binade_uniform<S>(source, -12, 0);
    std::vector<S> x;
    const auto axis = direction<S>(source);
    const bool one_axis = source.chance(1, 4), small = source.chance(1, 3);
    for (int i = 0; i < 3; ++i) {
      const S turn =
          source.chance(1, 16) ? S(0) : binade_uniform<S>(source, small ? -30 : -6, small ? -6 : 1);
      append(x, Vec<S, 3>(turn / dt * (one_axis ? axis : direction<S>(source))));
    }
    for (int i = 0; i < 3; ++i) {
      const Vec<S, 3> n = direction<S>(source);
      append(x, Vec<S, 3>((source.chance(1, 16) ? S(0) : binade_uniform<S>(source, -8, 5)) * n));
    }
    x.push_back(dt);
    return x;
  }
  bool valid(const std::vector<double>& input) const override {
    if (!Property::valid(input) || !(input[18] > 0x1p-20) || !(input[18] < 0x1p6)) return false;
    for (std::size_t i = 0; i < 9; i += 3)
      if (!(std::hypot(input[i], input[i + 1], input[i + 2]) * input[18] <= 3) ||
          !(std::hypot(input[9 + i], input[10 + i], input[11 + i]) < 0x1p40))
        return false;
    return true;
  }
  void in(const Subject& subject, const std::vector<double>& input, Recorder& r) const {
    const auto& o = subject.operations;
    const Vec<double, 9> gyro = Vec<double, 9>::Map(input.data()),
                         force = Vec<double, 9>::Map(input.data() + 9);
    const double dt = input[18];
    oracles::Samples omega, a;
    Real size(0);
    for (std::size_t i = 0; i < 3; ++i) {
      omega[i] = oracles::exact_vector<3>(input.data() + 3 * i);
      a[i] = oracles::exact_vector<3>(input.data() + 9 + 3 * i);
      size += norm(a[i]);
    }
    const Real t = oracles::exact<Real>(dt);
    const auto judge = [&](bool brossard, const auto& increment, const auto& biases,
                           const TwoOutputs& rotation, const TwoOutputs& motion,
                           const ThreeOutputs& by_biases) {
      if (!increment && !biases) return;
      const oracles::Preintegrated exact = oracles::preintegrated(omega, a, t, brossard);
      if (increment) {
        const Vec<double, 15> x = increment(gyro, force, dt);
        const auto Q = oracles::quaternion_from_matrix(exact.R);
        record_rotation(r, rotation, 0, rotation_in(&x[0]),
                        oracles::Resolved<oracles::Quaternion<>>{Q.value, Q.resolved && exact.resolved});
        record_three(r, motion[0], three_in(&x[9]), exact.p, Real(size * t * t), exact.resolved);
        record_three(r, motion[1], three_in(&x[12]), exact.v, Real(size * t), exact.resolved);
      }
      if (!biases) return;
      const Mat<double, 15, 3> D = biases(gyro, force, dt);
      judged_value(r, {by_biases[0], by_biases[1], by_biases[2]}, 0, D, exact.resolved, [&] {
        const auto error = [&](int i, const oracles::Mat3<>& value, const Real& scale) {
          const Mat<double, 3> own = D.block<3, 3>(3 * i, 0);
          return oracles::vector_error(r.scalar(), oracles::exact_matrix<3, 3>(own), value, scale);
        };
        r.record(by_biases[0], 0, error(0, exact.R_g, Real(0)));
        r.record(by_biases[1], 0,
                 std::max(error(1, exact.p_g, Real(size * t * t * t)), error(2, exact.p_a, Real(t * t))));
        r.record(by_biases[2], 0, std::max(error(3, exact.v_g, Real(size * t * t)), error(4, exact.v_a, t)));
      });
    };
    judge(false, o[op::preintegrate_forster], o[op::forster_bias_jacobians], forster_rotation, forster_parts,
          forster_biases);
    judge(true, o[op::preintegrate_brossard], o[op::brossard_bias_jacobians], brossard_rotation,
          brossard_parts, brossard_biases);
  }

 private:
  static void record_three(Recorder& r, const Output& output, const Vec<double, 3>& computed,
                           const oracles::Vec3<>& exact, const Real& scale, bool resolved) {
    judged_value(r, {output}, 0, computed, resolved, [&] {
      r.record(output, 0,
               oracles::vector_error(r.scalar(), oracles::exact_vector<3>(computed), exact, scale));
    });
  }
};

const RegisteredProperty<ExtendedPoses> registered_extended_poses;
const RegisteredProperty<Preintegration> registered_preintegration;

}  // namespace
}  // namespace liecheck::properties

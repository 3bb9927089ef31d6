// The rate of a free-flyer configuration is the coefficient Jacobian times the body velocity. The subject
// computes only the Jacobian. Its product with v, and the rate of R that follows from Q_dot, are computed in
// the oracle's arithmetic.

#include <invariants/property.hpp>

#include <boost/multiprecision/eigen.hpp>
#include <generators/rotations.hpp>
#include <oracles/error.hpp>
#include <oracles/kinematics.hpp>

namespace liecheck::properties {
namespace {

using oracles::Real;

/// The rate of R(Q / ||Q||) when Q changes at the rate Q_dot.
template <class Real>
oracles::Mat3<Real> rotation_rate(const oracles::Quaternion<Real>& Q,
                                  const oracles::Quaternion<Real>& Q_dot) {
  const Real by_norm = Real(1) / norm(Q);
  const oracles::Quaternion<Real> n = by_norm * Q;
  Real along(0);
  for (int i = 0; i < 4; ++i) along += n[i] * Q_dot[i];
  const oracles::Quaternion<Real> n_dot = by_norm * (Q_dot - along * n);
  const oracles::Mat3<Real> v = hat(head3(n)), v_dot = hat(head3(n_dot));
  return Real(2) * (n_dot[3] * v + n[3] * v_dot + v_dot * v + v * v_dot);
}

class KinematicIdentities final : public Law<KinematicIdentities> {
 public:
  static constexpr const auto& measured = op::integrate_coefficient_jacobian;
  static constexpr Statement stated{
      .name = "kinematic_identities",
      .law = "the coefficient Jacobian maps a body velocity to the rate of the configuration",
      .equation =
          "p_dot = R u, Q_dot = Q (w, 0) / 2, R_dot = R [w]; J = [[R, 0], [0, (Qw I + [Qxyz]) / 2], [0, "
          "-Qxyz^T / 2]]",
      .source = "Sola 2017 (arXiv 1711.02508), section 4, eqs. 197-201",
      .outputs = {measured[block::translation], measured[block::rotation_rate], measured[block::R_dot],
                  measured[block::translation_matrix], measured[block::quaternion_matrix],
                  measured[block::zeros]},
      .fields = {{"p", Kind::vector, 3, "m", Reach::full},
                 {"Q", Kind::quaternion, 4, "1"},
                 {"u", Kind::vector, 3, "m/s", Reach::full},
                 {"omega", Kind::vector, 3, "rad/s", Reach::full}}};
  template <class S>
  std::vector<S> draw(Source& source) const {
    return Joined<S>{vector3<S>(source), unit_quaternion<S>(source), vector3<S>(source), vector3<S>(source)};
  }
  bool valid(const std::vector<double>& input) const override {
    if (!oracles::all_finite(input)) return false;
    Reader reader(input);
    reader.take<3>();
    const auto Q = oracles::exact_vector<4, Real>(reader.take<4>());
    return oracles::norm_distance(Q) <= 32 * scalar().epsilon;
  }

  template <class Real>
  void in(const Subject& subject, const std::vector<double>& input, Recorder& recorder) const {
    using namespace oracles;
    const auto operation = subject.operations[measured];
    if (!operation) return;
    Reader reader(input);
    const auto q = reader.take<7>();
    const auto v = reader.take<6>();
    const properties::Mat<double, 7, 6> computed = operation(q);
    const auto all = [&](int first, int last, Outcome outcome) {
      for (int i = first; i <= last; ++i) recorder.outcome(stated.outputs[i], 0, outcome);
    };
    const auto record = [&](const Output& output, double error) {
      recorder.record(output, 0, error, [] { return 1.0; });
    };
    if (!all_finite(computed)) return all(0, 5, Outcome::not_finite);

    const auto J = exact_matrix<7, 6, Real>(computed);
    const auto q_e = exact_vector<7, Real>(q);
    const auto v_e = exact_vector<6, Real>(v);
    const Quaternion<Real> Q = quaternion_of(q_e);
    // Q_dot and the lower block of J are linear in Q. The subject uses the stored Q and the oracle Q / ||Q||,
    // so the oracle's values are multiplied by ||Q|| before they are compared.
    const Real Q_norm = norm(Q);

    const RateValue<Real> rate = configuration_rate(q_e, v_e);
    if (rate.resolved) {
      const Vec7<Real> q_dot = J * v_e;
      const Quaternion<Real> Q_dot = quaternion_of(q_dot);
      record(measured[block::translation], vector_error(recorder.scalar(), head3(q_dot), rate.p_dot));
      record(measured[block::rotation_rate], vector_error(recorder.scalar(), Q_dot, Q_norm * rate.Q_dot));
      record(measured[block::R_dot], vector_error(recorder.scalar(), rotation_rate(Q, Q_dot), rate.R_dot));
    } else {
      all(0, 2, Outcome::unresolved);
    }

    const CoefficientJacobianValue<Real> exact = oracles::integrate_coefficient_jacobian(q_e);
    if (exact.resolved) {
      record(measured[block::translation_matrix],
             vector_error(recorder.scalar(), corner<3>(J, 0, 0), corner<3>(exact.value, 0, 0)));
      record(measured[block::quaternion_matrix],
             vector_error(recorder.scalar(), corner<4>(J, 3, 3), Q_norm * corner<4>(exact.value, 3, 3)));
    } else {
      all(3, 4, Outcome::unresolved);
    }
    const bool zero = computed.block<3, 3>(0, 3).isZero(0) && computed.block<4, 3>(3, 0).isZero(0);
    record(measured[block::zeros], zero ? 0.0 : std::numeric_limits<double>::infinity());
  }

 private:
  template <int Rows, class Real>
  static oracles::Mat<Rows, 3, Real> corner(const oracles::Mat<7, 6, Real>& J, int row, int column) {
    oracles::Mat<Rows, 3, Real> m;
    for (int i = 0; i < Rows; ++i)
      for (int j = 0; j < 3; ++j) m(i, j) = J(row + i, column + j);
    return m;
  }
};

const RegisteredProperty<KinematicIdentities> registered_kinematic_identities;

}  // namespace
}  // namespace liecheck::properties

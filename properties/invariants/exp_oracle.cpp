// exp compared with the exponential of the 4 x 4 matrix, from zero to huge angles.

#include <generators/rotations.hpp>
#include <invariants/common.hpp>
#include <oracles/closed_forms.hpp>
#include <oracles/exp.hpp>

namespace liecheck::properties {
namespace {

class ExpOracle final : public Law<ExpOracle> {
 public:
  static constexpr Statement stated{
      .name = "exp_oracle",
      .law = "exp of a twist is the exponential of its 4 x 4 matrix",
      .equation = "exp(rho, phi) = sum_k [[phi], rho; 0, 0]^k / k!",
      .source = "Higham 2008, section 10.3 (scaling and squaring)",
      .outputs = {op::exp3_quaternion[block::rotation], op::exp3_quaternion[block::norm_defect],
                  op::exp3_matrix[block::rotation], op::exp3_matrix[block::orthogonality_defect],
                  op::exp6[block::rotation], op::exp6[block::orthogonality_defect],
                  op::exp6[block::translation]},
      .fields = {{"rho", Kind::vector, 3, "m", Reach::full},
                 {"phi", Kind::rotation_vector, 3, "rad", Reach::full}}};
  template <class S>
  std::vector<S> draw(Source& source) const {
    return Joined<S>{vector3<S>(source), rotation_vector<S>(source, AngleRange::unbounded)};
  }
  template <class Real>
  void in(const Subject& subject, const std::vector<double>& input, Recorder& r) const {
    const auto& o = subject.operations;
    Vec<double, 6> xi = Reader(input).take<6>();
    const Vec<double, 3> phi = xi.tail<3>();
    const auto exact_xi = oracles::exact_vector<6, Real>(xi);
    const auto exact = oracles::exp_se3(exact_xi);
    const std::size_t band = band_of_angle(r.scalar(), tail3(exact_xi), exact.theta);

    const auto kappa = oracles::sensitivity<Real>(
        [](const std::vector<Real>& x) {
          const auto pose = oracles::closed_exp(from_list<6>(x));
          return to_list(pose.p, pose.Q);
        },
        [&] { return to_list(exact_xi); }, {{0, 3}, {3, 4}});
    const auto kappa_rotation = [&] { return kappa.kappa(1, Real(1) / Real(2)); };
    // Lower bounds of kappa: a relative change e of all numbers of xi changes Q by e theta / 2 and p by
    // e R rho, at most the sum of the changes by each number. So kappa is at least theta or |rho| / |p|; 0.99
    // covers rounding. There is no bound beyond theta = 2^40, where condition.hpp is inaccurate.
    const double theta = at_most(exact.theta), share = theta < 0x1p40 ? 0.99 : 0;
    const double least_rotation = share * theta;
    // R of a pose that is returned as (p, Q) is |Q|^2 times a rotation, whose defect is sqrt(3) (|Q|^4 - 1): to first order,
    // 2 sqrt(3) times that of Q.
    const double of_Q = subject.takes.quaternion_poses ? 1 / std::sqrt(12.0) : 1;
    const auto matrix = [&](const Output& rotation, const Output& defect, const Mat<double, 3>& R,
                            double share_of_defect) {
      judged_value(r, {rotation, defect}, band, R, exact.resolved, [&] {
        const auto stored = oracles::exact_matrix<3, 3, Real>(R);
        const auto errors = oracles::matrix_errors(r.scalar(), stored, exact.Q);
        r.record(rotation, band, errors.rotation, Kappa(kappa_rotation, least_rotation));
        r.record(defect, band, share_of_defect * errors.defect);
      });
    };
    if (o[op::exp3_quaternion]) {
      const Vec<double, 4> Q = o[op::exp3_quaternion](phi);
      constexpr Output rotation = op::exp3_quaternion[block::rotation],
                       defect = op::exp3_quaternion[block::norm_defect];
      judged_value(r, {rotation, defect}, band, Q, exact.resolved, [&] {
        const auto stored = oracles::exact_vector<4, Real>(Q);
        r.record(rotation, band, oracles::rotation_error(r.scalar(), stored, exact.Q),
                 Kappa(kappa_rotation, least_rotation));
        r.record(defect, band, oracles::norm_defect(r.scalar(), stored));
      });
    }
    if (o[op::exp3_matrix])
      matrix(op::exp3_matrix[block::rotation], op::exp3_matrix[block::orthogonality_defect],
             o[op::exp3_matrix](phi), 1);
    if (o[op::exp6]) {
      const Pose<double> T = o[op::exp6](xi);
      matrix(op::exp6[block::rotation], op::exp6[block::orthogonality_defect], T.R, of_Q);
      constexpr Output translation = op::exp6[block::translation];
      judged_value(r, {translation}, band, T.p, exact.resolved, [&] {
        const auto kappa_translation = [&] { return kappa.kappa(0, norm(exact.p)); };
        const double least = share * at_most(head3(exact_xi)) / at_most(exact.p);
        r.record(translation, band,
                 oracles::vector_error(r.scalar(), oracles::exact_vector<3, Real>(T.p), exact.p),
                 Kappa(kappa_translation, least));
      });
    }
  }
};

const RegisteredProperty<ExpOracle> registered_exp_oracle;

}  // namespace
}  // namespace liecheck::properties

// The matrices by which a pose and a motion act on motions and forces, a covariance that a pose transports, and the screw
// of a motion.

#include <generators/rotations.hpp>
#include <invariants/common.hpp>

namespace liecheck::properties {
namespace {

constexpr TwoOutputs screw_lengths{op::screw_parameters[block::pitch], op::screw_parameters[block::point]};

class Adjoints final : public Law<Adjoints> {
 public:
  static constexpr TwoOutputs of_pose = jacobian_outputs(op::adjoint), dual = jacobian_outputs(op::coadjoint),
                              small = jacobian_outputs(op::small_adjoint);
  static constexpr Output axis = op::screw_parameters[block::direction];
  static constexpr Statement stated{
      .name = "adjoints",
      .law = "adjoint matrices act as the transforms and products of motions and forces do",
      .equation =
          "Ad = [[R, [p] R], [0, R]], Ad^-T = [[R, 0], [[p] R, R]], ad = [[[omega], [u]], [0, [omega]]]",
      .source = "Featherstone 2008, eqs. 2.24-2.32; Murray, Li & Sastry 1994, section 2.3.3",
      .outputs = {of_pose[0], of_pose[1], dual[0], dual[1], small[0], small[1], axis, screw_lengths[0],
                  screw_lengths[1]},
      .fields = {{"R", Kind::rotation_matrix, 9, "1"},
                 {"p", Kind::vector, 3, "m", Reach::full},
                 {"u", Kind::vector, 3, "m/s"},
                 {"omega", Kind::vector, 3, "rad/s"}}};

  template <class S>
  std::vector<S> draw(Source& source) const {
    const auto Q = unit_quaternion<S>(source);
    std::vector<S> x = Joined<S>{rotation_matrix<S>(Q), vector3<S>(source)};
    for (int i = 0; i < 2; ++i) append(x, vector3<S>(source, std::numeric_limits<S>::max_exponent / 8));
    return x;
  }
  /// Squares and products of velocities neither overflow nor lose digits.
  bool valid(const std::vector<double>& input) const override {
    const double least = std::ldexp(1, scalar().min_exponent / 4), most = 1 / least;
    const auto length = [&](std::size_t at) {
      return std::max({std::fabs(input[at]), std::fabs(input[at + 1]), std::fabs(input[at + 2])});
    };
    const auto apt = [&](double x) { return x == 0 || (x >= least && x <= most); };
    return Property::valid(input) && apt(length(12)) && apt(length(15));
  }

  template <class Real>
  void in(const Subject& subject, const std::vector<double>& input, Recorder& r) const {
    using namespace oracles;
    const auto& o = subject.operations;
    Reader read(input);
    const properties::Pose<double> X = read.take_pose();
    const properties::Vec<double, 6> V = read.take<6>();
    const PoseOf<Real> x = exact_pose<Real>(X);
    const Vec3<Real> u = exact_vector<3, Real>(V), omega = exact_vector<3, Real>(V.tail<3>());
    const Jacobian6Value<Real> exact{x.R, hat(x.p) * x.R, true};
    if (o[op::adjoint]) record_jacobian6(r, of_pose, 0, o[op::adjoint](X), exact, Real(0), false);
    if (o[op::coadjoint])
      record_jacobian6(r, dual, 0, halves_exchanged(o[op::coadjoint](X)), exact, Real(0), false);
    if (o[op::small_adjoint])
      record_jacobian6(r, small, 0, o[op::small_adjoint](V), Jacobian6Value<Real>{hat(omega), hat(u), true},
                       Real(0), false);
    if (!o[op::screw_parameters]) return;
    if (V.tail<3>().isZero(0)) {  // a translation has no point, and its pitch is infinite
      for (const Output& out : {axis, screw_lengths[0], screw_lengths[1]})
        r.outcome(out, 0, Outcome::ill_posed);
      return;
    }
    const properties::Vec<double, 7> screw = o[op::screw_parameters](V);
    const Real length = norm(omega), square = squared_norm(omega), scale = norm(u) / length;
    judged_value(r, {axis, screw_lengths[0], screw_lengths[1]}, 0, screw, true, [&] {
      const auto of = [](const Vec3<Real>& v, const Real& by) {
        return Vec3<Real>{{v[0] / by, v[1] / by, v[2] / by}};
      };
      r.record(axis, 0, vector_error(r.scalar(), exact_vector<3, Real>(screw), of(omega, length)));
      r.record(screw_lengths[0], 0,
               scalar_error(r.scalar(), oracles::exact<Real>(screw[3]), Real(dot(u, omega) / square), scale));
      r.record(screw_lengths[1], 0,
               vector_error(r.scalar(), exact_vector<3, Real>(screw.tail<3>()), of(cross(omega, u), square),
                            scale));
    });
  }

 private:
  /// [[R, 0], [C, R]] as [[R, C], [0, R]].
  static Mat<double, 6> halves_exchanged(const Mat<double, 6>& M) {
    Mat<double, 6> exchanged;
    exchanged << M.bottomRightCorner<3, 3>(), M.bottomLeftCorner<3, 3>(), M.topRightCorner<3, 3>(),
        M.topLeftCorner<3, 3>();
    return exchanged;
  }
};

class Covariances final : public SlowLaw<Covariances> {
 public:
  static constexpr Output matrix = op::transport_covariance[block::matrix],
                          symmetry = op::transport_covariance[block::symmetry];
  static constexpr Statement stated{.name = "covariances",
                                    .law = "a covariance is transported by the adjoint on both sides",
                                    .equation = "Sigma_A = Ad Sigma Ad^T, symmetric",
                                    .source = "Barfoot & Furgale 2014, eq. 40",
                                    .outputs = {matrix, symmetry},
                                    .fields = {{"R", Kind::rotation_matrix, 9, "1"},
                                               {"p", Kind::vector, 3, "m"},
                                               {"Sigma", Kind::covariance, 36, "m^2, m rad, rad^2"}}};

  /// Sigma = L L^T in units of its own for lengths and angles; sometimes diagonal.
  template <class S>
  std::vector<S> draw(Source& source) const {
    const auto Q = unit_quaternion<S>(source);
    std::vector<S> x =
        Joined<S>{rotation_matrix<S>(Q), vector3<S>(source, std::numeric_limits<S>::max_exponent / 8)};
    const bool diagonal = source.chance(1, 4);
    Mat<S, 6> L = Mat<S, 6>::Zero();
    const S units[2] = {binade_uniform<S>(source, -20, 20), binade_uniform<S>(source, -20, 2)};
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j <= i; ++j)
        if (i == j || !diagonal)
          L(i, j) = units[i / 3] * (i == j ? S(1) + source.unit<S>() : source.symmetric<S>());
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) {
        S sum(0);
        for (int k = 0; k <= std::min(i, j); ++k) sum += L(i, k) * L(j, k);
        x.push_back(sum);
      }
    return x;
  }
  bool valid(const std::vector<double>& input) const override {
    if (!Property::valid(input)) return false;
    Mat<double, 6> Sigma = Mat<double, 6>::Map(input.data() + 12);
    if (Sigma != Sigma.transpose()) return false;
    const Vec<double, 6> scale = Sigma.diagonal().cwiseAbs().cwiseSqrt().cwiseInverse();
    Sigma = (scale.asDiagonal() * Sigma * scale.asDiagonal()).eval();
    return Sigma.allFinite() && Sigma.diagonal().minCoeff() > 0 && Sigma.llt().info() == Eigen::Success;
  }
  void in(const Subject& subject, const std::vector<double>& input, Recorder& r) const {
    if (!subject.operations[op::transport_covariance]) return;
    using namespace oracles;
    Reader read(input);
    const properties::Pose<double> X = read.take_pose();
    const properties::Mat<double, 6> Sigma = properties::Mat<double, 6>::Map(input.data() + 12),
                                     computed = subject.operations[op::transport_covariance](X, Sigma);
    const PoseOf<Real> x = exact_pose<Real>(X);
    const Mat3<> C = hat(x.p) * x.R;
    const Mat6<> Ad = assemble(x.R, C, zeros<3, 3, Real>(), x.R), S = exact_matrix<6, 6>(Sigma),
                 exact = Ad * S * transpose(Ad);
    const auto size = [&](int i, int j) { return Real(norm(oracles::block(S, i, j))); };
    const Real p = norm(x.p), scales[2] = {size(0, 0) + 2 * p * size(0, 1) + p * p * size(1, 1), size(1, 1)};
    judged_value(r, {matrix, symmetry}, 0, computed, true, [&] {
      const Mat6<> Y = exact_matrix<6, 6>(computed);
      Real error(0), skew(0);
      for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j) {
          const Real scale = scales[i / 3] * scales[j / 3], d = Y(i, j) - exact(i, j), s = Y(i, j) - Y(j, i);
          if (scale > 0) error += d * d / scale, skew += s * s / scale;
        }
      r.record(matrix, 0, in_eps(r.scalar(), Real(sqrt(error))));
      r.record(symmetry, 0, in_eps(r.scalar(), Real(sqrt(skew))));
    });
  }
};

const RegisteredProperty<Adjoints> registered_adjoints;
const RegisteredProperty<Covariances> registered_covariances;

}  // namespace
}  // namespace liecheck::properties

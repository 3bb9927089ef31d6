// The error does not jump where an implementation changes its formula: the errors at two adjacent angles
// differ by at most the block's budget. The angles are near cutoffs that authors of libraries choose, such as
// powers of ten and roots of eps.

#include <generators/rotations.hpp>
#include <invariants/common.hpp>
#include <optional>
#include <oracles/ball_oracles.hpp>
#include <oracles/closed_forms.hpp>
#include <oracles/exp.hpp>

namespace liecheck::properties {
namespace {

class SmallAngleBranches final : public Law<SmallAngleBranches> {
 public:
  static constexpr Statement stated{
      .name = "small_angle_branches",
      .law = "no jump of the error across a change of formula",
      .equation = "|(y+ - y+_exact) - (y- - y-_exact)| over adjacent inputs",
      .source = "docs/measuring.md, jump; cutoffs of Pinocchio, Sophus, manif, smooth and GTSAM",
      .outputs = {op::exp3_quaternion[block::jump], op::exp6[block::jump], op::left_jacobian3[block::jump],
                  op::left_jacobian3_inverse[block::jump], op::right_jacobian6[block::jump],
                  op::right_jacobian6_inverse[block::jump]},
      .fields = {{"rho", Kind::vector, 3, "m"},
                 {"direction", Kind::opaque, 3, "1"},
                 {"theta", Kind::opaque, 2, "rad"}}};
  template <class S>
  std::vector<S> draw(Source& source) const {
    std::vector<S> x = Joined<S>{vector3<S>(source, 8), direction<S>(source)};
    const auto& cutoffs = common_cutoffs<S>();
    const int steps = source.between(-4, 4);
    const S t = step_ulps(cutoffs[source.below(cutoffs.size() - 1)], steps);
    x.push_back(t);
    x.push_back(step_ulps(t, source.between(1, 3)));
    return x;
  }
  template <class Real>
  void in(const Subject& subject, const std::vector<double>& input, Recorder& r) const {
    using namespace oracles;
    const auto& o = subject.operations;
    Reader read(input);
    const Vec<double, 3> rho = read.take<3>(), axis = read.take<3>();
    const Vec<double, 2> theta = read.take<2>();
    Vec<double, 6> xi[2];
    oracles::Vec<6, Real> x[2];
    for (int k : {0, 1}) {
      xi[k] << rho, theta[k] * axis;
      for (double& number : xi[k]) number = r.scalar().rounded(number);
      x[k] = exact_vector<6, Real>(xi[k]);
    }
    const Bands& bands = Bands::of(r.scalar());
    const std::size_t band = band_of_angle(r.scalar(), tail3(x[0]));
    // Beyond pi, exp_oracle and jacobian_oracle measure these operations.
    const bool beyond = bands[band_of_angle(r.scalar(), tail3(x[1]))].region == Region::beyond_pi ||
                        bands[band].region == Region::beyond_pi;

    // The Jacobians of SO(3) are blocks of those of SE(3). In ball arithmetic one evaluation gives both.
    std::optional<Jacobian6Value<Real>> left[2], left_inverse[2];
    const auto direct = [&](int k) -> const Jacobian6Value<Real>& {
      if (!left[k]) left[k] = left_jacobian_se3(x[k]);
      return *left[k];
    };
    const auto inverted = [&](int k) -> const Jacobian6Value<Real>& {
      if (!left_inverse[k]) left_inverse[k] = left_jacobian_se3_inverse(x[k]);
      return *left_inverse[k];
    };
    const auto jump = [&](const auto& operation, const Output& output, const auto& computed,
                          const auto& exact) {
      if (!operation) return;
      if (beyond) return r.outcome(output, band, Outcome::ill_posed);
      const auto y0 = computed(0), y1 = computed(1);
      if (!oracles::all_finite(y0) || !oracles::all_finite(y1))
        return r.outcome(output, band, Outcome::not_finite);
      const auto e0 = exact(0), e1 = exact(1);
      record_jump<Real>(r, output, band, {y0.data(), y1.data()}, {e0.x.data(), e1.x.data()}, e0.x.size());
    };
    const auto rows = [](const Mat<double, 3>& m) { return Vec<double, 9>(m.transpose().reshaped()); };
    const auto phi = [&](int k) { return Vec<double, 3>(xi[k].tail<3>()); };
    const auto coupling = [&](const Mat<double, 6>& J) { return rows(J.topRightCorner<3, 3>()); };
    jump(
        o[op::exp3_quaternion], op::exp3_quaternion[block::jump],
        [&](int k) {  // up to theta = pi, the exact Q = (v, w) has v . phi + w > 0
          const Vec<double, 4> Q = o[op::exp3_quaternion](phi(k));
          return Q.head<3>().dot(phi(k)) + Q[3] < 0 ? Vec<double, 4>(-Q) : Q;
        },
        [&](int k) { return exp_so3(tail3(x[k])).Q; });
    jump(
        o[op::exp6], op::exp6[block::jump], [&](int k) { return Vec<double, 3>(o[op::exp6](xi[k]).p); },
        [&](int k) { return exp_se3(x[k]).p; });
    jump(
        o[op::left_jacobian3], op::left_jacobian3[block::jump],
        [&](int k) { return rows(o[op::left_jacobian3](phi(k))); },
        [&](int k) { return BallNumber<Real> ? direct(k).J : left_jacobian_so3(tail3(x[k])).J; });
    jump(
        o[op::left_jacobian3_inverse], op::left_jacobian3_inverse[block::jump],
        [&](int k) { return rows(o[op::left_jacobian3_inverse](phi(k))); },
        [&](int k) { return BallNumber<Real> ? inverted(k).J : left_jacobian_so3_inverse(tail3(x[k])).J; });
    jump(
        o[op::right_jacobian6], op::right_jacobian6[block::jump],
        [&](int k) { return coupling(o[op::right_jacobian6](xi[k])); },
        [&](int k) { return BallNumber<Real> ? transpose(direct(k).C) : right_jacobian_se3(x[k]).C; });
    jump(
        o[op::right_jacobian6_inverse], op::right_jacobian6_inverse[block::jump],
        [&](int k) { return coupling(o[op::right_jacobian6_inverse](xi[k])); },
        [&](int k) {
          return BallNumber<Real> ? transpose(inverted(k).C) : right_jacobian_se3_inverse(x[k]).C;
        });
  }

 private:
  /// Records the difference of the errors at both inputs, in eps of the norm of the block.
  template <class Real>
  static void record_jump(Recorder& r, const Output& output, std::size_t band,
                          const std::array<const double*, 2>& computed,
                          const std::array<const Real*, 2>& exact, std::size_t n) {
    const auto error = [&](std::size_t k, std::size_t i) -> Real {
      return oracles::exact<Real>(computed[k][i]) - exact[k][i];
    };
    Real squared(0), size(0);
    for (std::size_t i = 0; i < n; ++i) {
      const Real difference = error(1, i) - error(0, i);
      squared += difference * difference;
      size += exact[0][i] * exact[0][i];
    }
    size = oracles::larger(Real(sqrt(size)), Real(r.scalar().least_denominator()));
    r.record(output, band, oracles::in_eps(r.scalar(), Real(sqrt(squared) / size)));
  }
};

const RegisteredProperty<SmallAngleBranches> registered_small_angle_branches;

}  // namespace
}  // namespace liecheck::properties

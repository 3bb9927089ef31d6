// The derivatives of integrate and difference of a whole robot, compared with the oracles joint by joint.

#include <algorithm>
#include <invariants/robot_states.hpp>

namespace liecheck::properties {
namespace {

class RobotDerivatives final : public Law<RobotDerivatives, RobotStates> {
 public:
  static constexpr Statement stated{
      .name = "robot_derivatives",
      .law = "dIntegrate and dDifference of a whole robot are those of its joints, and zero between joints",
      .equation =
          "ARG0 = Ad(exp(-d)), ARG1 = J_r(d); dDifference ARG0 = -J_l^-1(d), ARG1 = J_r^-1(d); 1 or -1 of a "
          "joint with one coordinate",
      .source = "Sola, Deray & Atchuthan 2018, eqs. 79-85; central differences at 100 digits",
      .outputs = {op::robot_d_integrate_arg0[block::jacobian], op::robot_d_integrate_arg0[block::coupling],
                  op::robot_d_integrate_arg0[block::joint], op::robot_d_integrate_arg1[block::jacobian],
                  op::robot_d_integrate_arg1[block::coupling], op::robot_d_integrate_arg1[block::joint],
                  op::robot_d_difference_arg0[block::jacobian], op::robot_d_difference_arg0[block::coupling],
                  op::robot_d_difference_arg0[block::joint], op::robot_d_difference_arg1[block::jacobian],
                  op::robot_d_difference_arg1[block::coupling], op::robot_d_difference_arg1[block::joint]}};
  template <class S>
  std::vector<S> draw(Source& source) const {
    return this->template states<S>(source);
  }
  template <class Real>
  void in(const Subject& subject, const std::vector<double>& input, Recorder& r) const {
    using namespace oracles;
    const RobotOperations<double>& robot = this->bound(subject);
    Reader read(input);
    const VecX<double> q0 = read.take_dynamic(nq_), q1 = read.take_dynamic(nq_), d = read.take_dynamic(nv_);
    const MatX<double> J[] = {
        robot[op::robot_d_integrate_arg0](q0, d), robot[op::robot_d_integrate_arg1](q0, d),
        robot[op::robot_d_difference_arg0](q0, q1), robot[op::robot_d_difference_arg1](q0, q1)};
    record_joints<Real>(r, op::robot_d_integrate_arg0[block::joint], J[0], 1);
    record_joints<Real>(r, op::robot_d_integrate_arg1[block::joint], J[1], 1);
    record_joints<Real>(r, op::robot_d_difference_arg0[block::joint], J[2], -1);
    record_joints<Real>(r, op::robot_d_difference_arg1[block::joint], J[3], 1);
    for (const Segment& s : segments_) {
      if (s.nq != 7) continue;
      const auto x0 = exact_vector<7, Real>(q0.segment(s.q, 7)),
                 x1 = exact_vector<7, Real>(q1.segment(s.q, 7));
      const auto xd = exact_vector<6, Real>(d.segment(s.v, 6));
      const auto own = [&](int k) { return properties::Mat<double, 6>(J[k].block(s.v, s.v, 6, 6)); };
      record_d_integrate_arg0(r, jacobian_outputs(op::robot_d_integrate_arg0), x0, xd, own(0));
      record_d_integrate_arg1(r, jacobian_outputs(op::robot_d_integrate_arg1), x0, xd, own(1));
      const auto by0 = jacobian_outputs(op::robot_d_difference_arg0),
                 by1 = jacobian_outputs(op::robot_d_difference_arg1);
      const auto exact = oracles::difference(x0, x1);
      const std::size_t band = band_of_difference(r.scalar(), x0, x1, exact);
      if (at_either_side(r.scalar(),
                         exact)) {  // the derivative has two values: the law d_integrate measures both
        for (const Output& o : {by0[0], by0[1], by1[0], by1[1]}) r.outcome(o, band, Outcome::ill_posed);
        continue;
      }
      Jacobian6Value<Real> left = left_jacobian_se3_inverse(stack(exact.rho, exact.phi));
      left.resolved = left.resolved && exact.resolved;
      const Jacobian6Value<Real> right{transpose(left.J), transpose(left.C), left.resolved},
          minus{Real(-1) * left.J, Real(-1) * left.C, left.resolved};
      record_by_difference(r, by0, band, own(2), minus, x0, x1);
      record_by_difference(r, by1, band, own(3), right, x0, x1);
    }
  }

 private:
  using RobotStates::nq_;
  using RobotStates::nv_;
  using RobotStates::segments_;
  bool exists(const Output& o) const override {
    return o.block == block::joint.text ? this->has_joint(1) || this->has_joint(2) : this->has_joint(7);
  }
  /// Records the diagonal entries of the joints with one coordinate, which are `value`.
  template <class Real>
  void record_joints(Recorder& r, const Output& output, const MatX<double>& J, double value) const {
    if (!this->exists(output)) return;
    if (!oracles::all_finite(J)) return r.outcome(output, 0, Outcome::not_finite);
    MatX<double> rest = J;
    double error = 0;
    for (const Segment& s : segments_) {
      const int n = s.nq == 7 ? 6 : 1;
      if (n == 1)
        error = std::max(error,
                         oracles::scalar_error(r.scalar(), oracles::exact<Real>(J(s.v, s.v)), Real(value)));
      rest.block(s.v, s.v, n, n).setZero();
    }
    const bool zero = std::all_of(rest.data(), rest.data() + rest.size(), [](double x) { return x == 0; });
    r.record(output, 0, zero ? error : std::numeric_limits<double>::infinity());
  }
};

const RegisteredProperty<RobotDerivatives> registered_robot_derivatives;

}  // namespace
}  // namespace liecheck::properties

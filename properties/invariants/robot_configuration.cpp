// integrate, difference and their derivatives on the whole configuration vector of a robot, compared with the
// oracles joint by joint. A subject must treat Q and -Q as the same configuration, and no other two.

#include <fmt/format.h>

#include <generators/rotations.hpp>
#include <invariants/branch.hpp>
#include <liecheck/urdf/urdf.hpp>
#include <map>
#include <mutex>
#include <optional>
#include <oracles/ball_oracles.hpp>
#include <oracles/closed_forms.hpp>
#include <oracles/integrate.hpp>

namespace liecheck::properties {
namespace {

/// The offsets of a joint in q and v, and nq: 7 for a free-flyer, 2 for a continuous joint, otherwise 1.
struct Segment {
  int q, nq, v;
};

/// What the laws on the configuration vector of a robot share.
template <class S>
class RobotStates : public Property<S> {
 public:
  std::vector<Field> fields() const override {
    std::vector<Field> all;
    const auto configuration = [&](const char* name, Reach reach) {
      for (const Segment& s : segments_) {
        const std::string at = fmt::format("{}_{}", name, s.q);
        if (s.nq == 7) {
          all.push_back({at + "_p", Kind::vector, 3, "m", reach});
          all.push_back({at + "_Q", Kind::quaternion, 4, "1", reach});
        } else {
          all.push_back({at, Kind::opaque, s.nq, s.nq == 2 ? "1" : "m or rad"});
        }
      }
    };
    configuration("q0", Reach::limited);
    configuration("q1", Reach::beside);
    for (const Segment& s : segments_) {
      const std::string at = fmt::format("delta_{}", s.v);
      if (s.nq == 7) {
        all.push_back({at + "_rho", Kind::vector, 3, "m"});
        all.push_back({at + "_phi", Kind::rotation_vector, 3, "rad", Reach::full});
      } else {
        all.push_back({at, Kind::opaque, 1, "m or rad"});
      }
    }
    for (const Field& f : more_fields()) all.push_back(f);
    return all;
  }
  bool needs_robot() const override { return true; }
  void prepare(const Robot& robot) override {
    const auto model =
        buildModelFromUrdfText(robot.urdf, robot.fixed ? RootJoint::Fixed : RootJoint::FreeFlyer, robot.name);
    nq_ = model.nq, nv_ = model.nv;
    for (std::size_t j = 1; j < static_cast<std::size_t>(model.njoints); ++j)
      segments_.push_back({static_cast<int>(model.idx_qs[j]), static_cast<int>(model.nqs[j]),
                           static_cast<int>(model.idx_vs[j])});
    urdf_ = robot.urdf, fixed_ = robot.fixed;
  }

 protected:
  /// What a law adds to the numbers of q0, q1 and delta.
  virtual std::vector<Field> more_fields() const { return {}; }
  /// q0, q1 and delta. Positions and increments are sometimes as large as 1e7.
  std::vector<S> states(Source& source) const {
    VecX<S> q0(nq_), q1(nq_), d(nv_);
    const auto reach = [&] { return source.chance(1, 4) ? 24 : 8; };
    for (const Segment& s : segments_) {
      if (s.nq == 7) {
        const auto p = vector3<S>(source, reach());
        const auto Q = unit_quaternion<S>(source);
        q0.segment(s.q, 7) << p, Q;
        q1.segment(s.q, 7) << point_near<S>(source, p), quaternion_near<S>(source, Q);
        const auto rho = vector3<S>(source, reach());
        d.segment(s.v, 6) << rho, rotation_vector<S>(source, AngleRange::unbounded);
      } else if (s.nq == 2) {
        q0.template segment<2>(s.q) = circle(source);
        q1.template segment<2>(s.q) = circle(source);
        d[s.v] = angle<S>(source, AngleRange::unbounded) * (source.chance(1, 2) ? S(1) : S(-1));
      } else {
        for (S* x : {&q0[s.q], &q1[s.q], &d[s.v]}) *x = magnitude<S>(source, reach());
      }
    }
    return Joined<S>{q0, q1, d};
  }
  /// Whether the numbers are finite, and quaternions and (cos, sin) are unit within the contract.
  bool valid_states(const std::vector<S>& x) const {
    if (!Property<S>::valid(x)) return false;
    for (const Segment& s : segments_)
      for (int at : {s.q, nq_ + s.q}) {
        const auto i = static_cast<std::size_t>(at);
        if (s.nq == 7 && norm_defect_at<S>(x, i + 3) > 8) return false;
        if (s.nq == 2 &&
            oracles::norm_defect<S>(oracles::Quaternion<>{
                {oracles::exact<Real>(x[i]), oracles::exact<Real>(x[i + 1]), Real(0), Real(0)}}) > 8)
          return false;
      }
    return true;
  }
  bool has(const Subject<S>& s, const Operation&) const override { return s.operations.robot; }
  bool has_joint(int nq) const {
    return std::any_of(segments_.begin(), segments_.end(), [nq](const Segment& s) { return s.nq == nq; });
  }
  /// A random (cos, sin), often near an axis, with norm 1 up to rounding.
  static Vec<S, 2> circle(Source& source) {
    using std::sqrt;
    const S s = source.chance(1, 2) ? source.symmetric<S>()
                                    : binade_uniform<S>(source, -std::numeric_limits<S>::digits, 0);
    Vec<S, 2> u(S(sqrt((S(1) - s) * (S(1) + s))), s);
    if (source.chance(1, 2)) u = -u;
    if (source.chance(1, 2)) std::swap(u[0], u[1]);
    return u / S(sqrt(u.squaredNorm()));
  }

  /// The subject's operations on the robot. The first case reads the robot, so that no reader runs of a
  /// subject that is not measured. A reader that throws is not called again: every case throws its exception.
  const RobotOperations<S>& bound(const Subject<S>& subject) const {
    const std::lock_guard lock(mutex_);
    Bound& b = bound_[&subject];
    if (b.error) std::rethrow_exception(b.error);
    if (!b.operations) try {
        b.operations = subject.operations.robot(urdf_, fixed_);
      } catch (...) {
        b.error = std::current_exception();
        throw;
      }
    return *b.operations;
  }

  int nq_ = 0, nv_ = 0;
  std::vector<Segment> segments_;

 private:
  struct Bound {
    std::optional<RobotOperations<S>> operations;
    std::exception_ptr error;
  };
  std::string urdf_;
  bool fixed_ = false;
  mutable std::mutex mutex_;
  mutable std::map<const Subject<S>*, Bound> bound_;
};

template <class S>
class RobotConfiguration final : public Law<RobotConfiguration, S, RobotStates<S>> {
 public:
  static constexpr Statement stated{
      .name = "robot_configuration",
      .law =
          "integrate and difference act joint by joint on the whole vector, and -Q is the same "
          "configuration, but no other is",
      .equation =
          "q1 = integrate(q0, d) and difference(q0, q1) per joint; Q1 . Q0 >= 0; q ~ q' for Q' = -Q; not q ~ "
          "q' if a joint differs by more than sqrt(eps)",
      .source = "Pinocchio 3.8, joint-configuration",
      .outputs = {op::robot_integrate[block::rotation], op::robot_integrate[block::translation],
                  op::robot_integrate[block::norm_defect], op::robot_integrate[block::sign],
                  op::robot_integrate[block::continuous], op::robot_integrate[block::joint],
                  op::robot_difference[block::rotation_vector], op::robot_difference[block::linear],
                  op::robot_difference[block::continuous], op::robot_difference[block::joint],
                  op::robot_is_same[block::same]}};
  std::vector<Field> more_fields() const override {
    return {{"moved_coordinate", Kind::choice, 1, "1"}, {"moved_by", Kind::opaque, 1, "m or rad"}};
  }
  std::vector<S> generate(Source& source) const override {
    std::vector<S> x = this->states(source);
    x.push_back(S(source.between(0, nv_ - 1)));
    const S size = binade_uniform<S>(source, 2 - std::numeric_limits<S>::digits / 2, 1);
    x.push_back(source.chance(1, 2) ? size : S(-size));
    return x;
  }
  bool valid(const std::vector<S>& x) const override {
    using std::fabs;
    const S k = x[x.size() - 2], size = S(fabs(x.back()));
    return this->valid_states(x) && k >= S(0) && k < S(nv_) && k == S(static_cast<int>(k)) && size < S(3) &&
           size * size > S(4) * std::numeric_limits<S>::epsilon();
  }
  template <class Real>
  void in(const Subject<S>& subject, const std::vector<S>& input, Recorder& r) const {
    using namespace oracles;
    const RobotOperations<S>& robot = this->bound(subject);
    Reader<S> read(input);
    const VecX<S> q0 = read.take_dynamic(nq_), q1 = read.take_dynamic(nq_), d = read.take_dynamic(nv_);
    const VecX<S> q = robot[op::robot_integrate](q0, d);
    const VecX<S> v = robot[op::robot_difference](q0, q1);
    VecX<S> opposite = q0;
    for (const Segment& s : segments_) {
      if (s.nq == 7) {
        opposite.segment(s.q + 3, 4) *= S(-1);
        const auto x0 = exact_vector<7, Real>(q0.segment(s.q, 7)),
                   x1 = exact_vector<7, Real>(q1.segment(s.q, 7));
        const auto xd = exact_vector<6, Real>(d.segment(s.v, 6));
        const auto next = oracles::integrate(x0, xd);
        std::size_t band = band_of_angle<S>(tail3(xd));
        constexpr Output rotation = op::robot_integrate[block::rotation],
                         translation = op::robot_integrate[block::translation],
                         defect = op::robot_integrate[block::norm_defect],
                         sign = op::robot_integrate[block::sign];
        const Real scale = larger(norm(next.p), larger(norm(head3(x0)), next.increment_norm));
        const auto kappa = sensitivity<Real>(
            [](const std::vector<Real>& x) {
              const auto pose = closed_integrate(from_list<7>(x), from_list<6>(x, 7));
              return to_list(pose.p, pose.Q);
            },
            [&] { return to_list(x0, xd); }, {{0, 3}, {3, 4}});
        judged_value(r, {rotation, translation, defect, sign}, band, q.segment(s.q, 7), next.resolved, [&] {
          const auto got = exact_vector<7, Real>(q.segment(s.q, 7));
          const auto Q = quaternion_of(got), Q0 = quaternion_of(x0);
          r.record(rotation, band, rotation_error<S>(Q, next.Q),
                   [&] { return kappa.kappa(1, Real(1) / Real(2)); });
          r.record(translation, band, vector_error<S>(head3(got), next.p, scale),
                   [&] { return kappa.kappa(0, scale); });
          r.record(defect, band, norm_defect<S>(Q));
          Real product(0);
          for (int i = 0; i < 4; ++i) product += Q0[i] * Q[i];
          r.record(sign, band, in_eps<S>(larger(Real(-product), Real(0))));  // near 0, up to rounding
        });
        const auto delta = oracles::difference(x0, x1);
        band = band_of_difference<S>(x0, x1, delta);
        record_log<S>(r, {op::robot_difference[block::rotation_vector], op::robot_difference[block::linear]},
                      band, properties::Vec<S, 6>(v.segment(s.v, 6)), delta, Side::either, delta.separation,
                      false);
      } else if (s.nq == 2) {
        // The exact (cos, sin) after a rotation by d, and the exact angle between both configurations.
        const Real c0 = exact<Real>(q0[s.q]), s0 = exact<Real>(q0[s.q + 1]), a = exact<Real>(d[s.v]);
        const Real n0 = sqrt(Real(c0 * c0 + s0 * s0));
        Real sin_a, cos_a;
        sin_cos(a, sin_a, cos_a);
        const Real c = (c0 * cos_a - s0 * sin_a) / n0, sn = (s0 * cos_a + c0 * sin_a) / n0;
        judged_value(r, {op::robot_integrate[block::continuous]}, 0, q.segment(s.q, 2), true, [&] {
          r.record(op::robot_integrate[block::continuous], 0,
                   in_eps<S>(norm(oracles::Vec<2, Real>{
                       {Real(exact<Real>(q[s.q]) - c), Real(exact<Real>(q[s.q + 1]) - sn)}})));
        });
        const Real c1 = exact<Real>(q1[s.q]), s1 = exact<Real>(q1[s.q + 1]);
        const Real angle_between = atan2(Real(c0 * s1 - s0 * c1), Real(c0 * c1 + s0 * s1));
        judged_value(r, {op::robot_difference[block::continuous]}, 0, v.segment(s.v, 1), true, [&] {
          const double plus = scalar_error<S>(exact<Real>(v[s.v]), angle_between);
          const Real opposite_angle = -angle_between;
          const bool at_pi = c0 * s1 == s0 * c1 && angle_between != Real(0);
          r.record(op::robot_difference[block::continuous], 0,
                   at_pi ? std::min(plus, scalar_error<S>(exact<Real>(v[s.v]), opposite_angle)) : plus);
        });
      } else {
        const Real a = exact<Real>(q0[s.q]), b = exact<Real>(d[s.v]), e = exact<Real>(q1[s.q]);
        judged_value(r, {op::robot_integrate[block::joint], op::robot_difference[block::joint]}, 0,
                     q.segment(s.q, 1), true, [&] {
                       r.record(op::robot_integrate[block::joint], 0,
                                scalar_error<S>(exact<Real>(q[s.q]), Real(a + b)));
                       r.record(op::robot_difference[block::joint], 0,
                                scalar_error<S>(exact<Real>(v[s.v]), Real(e - a)));
                     });
      }
    }
    const Vec<S, 2> move = read.template take<2>();
    const VecX<S> other = moved(q0, static_cast<int>(move[0]), move[1]);
    const auto& same = robot[op::robot_is_same];
    for (const bool right : {same(q0, opposite), !same(q0, other), !same(other, opposite)})
      if (right)
        r.record(op::robot_is_same[block::same], 0, 0);
      else
        r.outcome(op::robot_is_same[block::same], 0, Outcome::wrong_branch);
  }

 private:
  using RobotStates<S>::nq_;
  using RobotStates<S>::nv_;
  using RobotStates<S>::segments_;
  /// Whether the robot has a joint of the kind that the block measures.
  bool exists(const Output& o) const override {
    return o.block == block::same.text || this->has_joint(o.block == block::continuous.text ? 2
                                                          : o.block == block::joint.text    ? 1
                                                                                            : 7);
  }
  /// q with one coordinate of the tangent space moved [rad; relative to max(1, |p|)], up to rounding.
  VecX<S> moved(VecX<S> q, int coordinate, const S& by) const {
    using std::cos, std::fabs, std::sin;
    for (const Segment& s : segments_) {
      const int k = coordinate - s.v;
      if (k < 0 || k >= (s.nq == 7 ? 6 : 1)) continue;
      if (s.nq == 7 && k < 3) {
        S scale(1);
        for (int i = 0; i < 3; ++i) scale = std::max(scale, S(S(2) * fabs(q[s.q + i])));
        q[s.q + k] += by * scale;
      } else if (s.nq == 7) {
        Vec<S, 4> turn = Vec<S, 4>::Zero();
        turn[k - 3] = S(sin(S(by / S(2)))), turn[3] = S(cos(S(by / S(2))));
        q.template segment<4>(s.q + 3) =
            quaternion_product<S>(Vec<S, 4>(q.template segment<4>(s.q + 3)), turn);
      } else if (s.nq == 2) {
        const S c = q[s.q], sn = q[s.q + 1], cb = S(cos(by)), sb = S(sin(by));
        q[s.q] = c * cb - sn * sb, q[s.q + 1] = sn * cb + c * sb;
      } else {
        q[s.q] += by * S(2) * std::max(S(1), S(fabs(q[s.q])));
      }
    }
    return q;
  }
};

template <class S>
class RobotDerivatives final : public Law<RobotDerivatives, S, RobotStates<S>> {
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
  std::vector<S> generate(Source& source) const override { return this->states(source); }
  bool valid(const std::vector<S>& x) const override { return this->valid_states(x); }
  template <class Real>
  void in(const Subject<S>& subject, const std::vector<S>& input, Recorder& r) const {
    using namespace oracles;
    const RobotOperations<S>& robot = this->bound(subject);
    Reader<S> read(input);
    const VecX<S> q0 = read.take_dynamic(nq_), q1 = read.take_dynamic(nq_), d = read.take_dynamic(nv_);
    const MatX<S> J[] = {robot[op::robot_d_integrate_arg0](q0, d), robot[op::robot_d_integrate_arg1](q0, d),
                         robot[op::robot_d_difference_arg0](q0, q1),
                         robot[op::robot_d_difference_arg1](q0, q1)};
    record_joints<Real>(r, op::robot_d_integrate_arg0[block::joint], J[0], S(1));
    record_joints<Real>(r, op::robot_d_integrate_arg1[block::joint], J[1], S(1));
    record_joints<Real>(r, op::robot_d_difference_arg0[block::joint], J[2], S(-1));
    record_joints<Real>(r, op::robot_d_difference_arg1[block::joint], J[3], S(1));
    for (const Segment& s : segments_) {
      if (s.nq != 7) continue;
      const auto x0 = exact_vector<7, Real>(q0.segment(s.q, 7)),
                 x1 = exact_vector<7, Real>(q1.segment(s.q, 7));
      const auto xd = exact_vector<6, Real>(d.segment(s.v, 6));
      const auto own = [&](int k) { return properties::Mat<S, 6>(J[k].block(s.v, s.v, 6, 6)); };
      record_by_delta(r, jacobian_outputs(op::robot_d_integrate_arg0), xd, own(0),
                      oracles::d_integrate_arg0(x0, xd), [](const std::vector<Real>& v) {
                        const auto step = closed_exp(from_list<6>(v));
                        const Mat3<Real> Rt = transpose(rotation_matrix(step.Q));
                        return to_list(Rt, times_hat(Rt, step.p));
                      });
      // The left Jacobian has the transposed blocks.
      record_by_delta(r, jacobian_outputs(op::robot_d_integrate_arg1), xd, own(1),
                      oracles::d_integrate_arg1(x0, xd), [](const std::vector<Real>& v) {
                        const auto left = closed_left_jacobian(from_list<6>(v));
                        return to_list(left.J, left.C);
                      });
      const auto by0 = jacobian_outputs(op::robot_d_difference_arg0),
                 by1 = jacobian_outputs(op::robot_d_difference_arg1);
      const auto exact = oracles::difference(x0, x1);
      const std::size_t band = band_of_difference<S>(x0, x1, exact);
      if (at_either_side<S>(exact)) {  // the derivative has two values: the law d_integrate measures both
        if constexpr (BallNumber<Real>) throw Undecided();
        for (const Output& o : {by0[0], by0[1], by1[0], by1[1]}) r.outcome(o, band, Outcome::ill_posed);
        continue;
      }
      Jacobian6Value<Real> left = left_jacobian_se3_inverse(stack(exact.rho, exact.phi));
      left.resolved = left.resolved && exact.resolved;
      const Jacobian6Value<Real> right{transpose(left.J), transpose(left.C), left.resolved},
          minus{Real(-1) * left.J, Real(-1) * left.C, left.resolved};
      record_jacobian6<S>(r, by0, band, own(2), minus, Real(0), false);
      record_jacobian6<S>(r, by1, band, own(3), right, Real(0), false);
    }
  }

 private:
  using RobotStates<S>::nq_;
  using RobotStates<S>::nv_;
  using RobotStates<S>::segments_;
  bool exists(const Output& o) const override {
    return o.block == block::joint.text ? this->has_joint(1) || this->has_joint(2) : this->has_joint(7);
  }
  /// Records the blocks of a free-flyer, whose kappa is that of `blocks` at the increment.
  template <class Real, class Blocks>
  static void record_by_delta(Recorder& r, const TwoOutputs& outputs, const oracles::Vec6<Real>& delta,
                              const Mat<S, 6>& J, const oracles::Jacobian6Value<Real>& exact,
                              const Blocks& blocks) {
    using namespace oracles;
    const std::size_t band = band_of_angle<S>(tail3(delta));
    const bool beyond = Bands::of<S>()[band].region == Region::beyond_pi;
    const auto sensitive = sensitivity<Real>(blocks, [&] { return to_list(delta); }, {{0, 9}, {9, 9}});
    const Real rho = norm(head3(delta)), n = norm(exact.J), least = rho * smaller(n, Real(1));
    record_jacobian6<S>(
        r, outputs, band, J, exact, rho, beyond, [&] { return sensitive.kappa(0, n); },
        [&] { return sensitive.kappa(1, larger(Real(norm(exact.C)), least)); });
  }
  /// Records the diagonal entries of the joints with one coordinate, which are `value`.
  template <class Real>
  void record_joints(Recorder& r, const Output& output, const MatX<S>& J, const S& value) const {
    if (!this->exists(output)) return;
    if (!oracles::all_finite(J)) return r.outcome(output, 0, Outcome::not_finite);
    MatX<S> rest = J;
    double error = 0;
    for (const Segment& s : segments_) {
      const int n = s.nq == 7 ? 6 : 1;
      if (n == 1)
        error = std::max(
            error, oracles::scalar_error<S>(oracles::exact<Real>(J(s.v, s.v)), oracles::exact<Real>(value)));
      rest.block(s.v, s.v, n, n).setZero();
    }
    r.record(output, 0, rest.isZero(0) ? error : std::numeric_limits<double>::infinity());
  }
};

const RegisteredProperty<RobotConfiguration> registered;
const RegisteredProperty<RobotDerivatives> registered_derivatives;

}  // namespace
}  // namespace liecheck::properties

// integrate and difference on the whole configuration vector of a robot, compared with the oracles joint by
// joint. A subject must treat Q and -Q as the same configuration, and no other two.

#include <invariants/robot_states.hpp>

namespace liecheck::properties {
namespace {

class RobotConfiguration final : public Law<RobotConfiguration, RobotStates> {
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
  template <class S>
  std::vector<S> draw(Source& source) const {
    std::vector<S> x = this->template states<S>(source);
    x.push_back(S(source.between(0, nv_ - 1)));
    const S size = binade_uniform<S>(source, 2 - std::numeric_limits<S>::digits / 2, 1);
    x.push_back(source.chance(1, 2) ? size : S(-size));
    return x;
  }
  bool valid(const std::vector<double>& x) const override {
    const double k = x[x.size() - 2], size = std::fabs(x.back());
    return RobotStates::valid(x) && k >= 0 && k < nv_ && k == static_cast<int>(k) && size < 3 &&
           scalar().rounded(size * size) > 4 * scalar().epsilon;
  }
  template <class Real>
  void in(const Subject& subject, const std::vector<double>& input, Recorder& r) const {
    using namespace oracles;
    const RobotOperations<double>& robot = this->bound(subject);
    Reader read(input);
    const VecX<double> q0 = read.take_dynamic(nq_), q1 = read.take_dynamic(nq_), d = read.take_dynamic(nv_);
    const VecX<double> q = robot[op::robot_integrate](q0, d);
    const VecX<double> v = robot[op::robot_difference](q0, q1);
    VecX<double> opposite = q0;
    for (const Segment& s : segments_) {
      if (s.nq == 7) {
        opposite.segment(s.q + 3, 4) *= -1;
        const auto x0 = exact_vector<7, Real>(q0.segment(s.q, 7)),
                   x1 = exact_vector<7, Real>(q1.segment(s.q, 7));
        const auto xd = exact_vector<6, Real>(d.segment(s.v, 6));
        std::size_t band = band_of_angle(r.scalar(), tail3(xd));
        record_integrate(r,
                         {op::robot_integrate[block::rotation], op::robot_integrate[block::translation],
                          op::robot_integrate[block::norm_defect]},
                         band, properties::Vec<double, 7>(q.segment(s.q, 7)), x0, xd);
        record_sign<Real>(r, op::robot_integrate[block::sign], band, q0.segment(s.q + 3, 4),
                          q.segment(s.q + 3, 4));
        const auto delta = oracles::difference(x0, x1);
        band = band_of_difference(r.scalar(), x0, x1, delta);
        record_difference(r,
                          {op::robot_difference[block::rotation_vector], op::robot_difference[block::linear]},
                          band, properties::Vec<double, 6>(v.segment(s.v, 6)), delta, x0, x1, false);
      } else if (s.nq == 2) {
        // The exact (cos, sin) after a rotation by d, and the exact angle between both configurations.
        const Real c0 = exact<Real>(q0[s.q]), s0 = exact<Real>(q0[s.q + 1]), a = exact<Real>(d[s.v]);
        const Real n0 = sqrt(Real(c0 * c0 + s0 * s0));
        Real sin_a, cos_a;
        sin_cos(a, sin_a, cos_a);
        const Real c = (c0 * cos_a - s0 * sin_a) / n0, sn = (s0 * cos_a + c0 * sin_a) / n0;
        judged_value(r, {op::robot_integrate[block::continuous]}, 0, q.segment(s.q, 2), true, [&] {
          r.record(op::robot_integrate[block::continuous], 0,
                   in_eps(r.scalar(), norm(oracles::Vec<2, Real>{{Real(exact<Real>(q[s.q]) - c),
                                                                  Real(exact<Real>(q[s.q + 1]) - sn)}})));
        });
        const Real c1 = exact<Real>(q1[s.q]), s1 = exact<Real>(q1[s.q + 1]);
        const Real angle_between = atan2(Real(c0 * s1 - s0 * c1), Real(c0 * c1 + s0 * s1));
        judged_value(r, {op::robot_difference[block::continuous]}, 0, v.segment(s.v, 1), true, [&] {
          const Real least(r.ordinary(op::robot_difference[block::continuous]) ? 1 : 0);  // as of Q0* Q1
          const double plus = scalar_error(r.scalar(), exact<Real>(v[s.v]), angle_between, least);
          const Real opposite_angle = -angle_between;
          const bool at_pi = c0 * s1 == s0 * c1 && angle_between != Real(0);
          r.record(op::robot_difference[block::continuous], 0,
                   at_pi
                       ? std::min(plus, scalar_error(r.scalar(), exact<Real>(v[s.v]), opposite_angle, least))
                       : plus);
        });
      } else {
        const Real a = exact<Real>(q0[s.q]), b = exact<Real>(d[s.v]), e = exact<Real>(q1[s.q]);
        judged_value(r, {op::robot_integrate[block::joint], op::robot_difference[block::joint]}, 0,
                     q.segment(s.q, 1), true, [&] {
                       r.record(op::robot_integrate[block::joint], 0,
                                scalar_error(r.scalar(), exact<Real>(q[s.q]), Real(a + b)));
                       r.record(op::robot_difference[block::joint], 0,
                                scalar_error(r.scalar(), exact<Real>(v[s.v]), Real(e - a)));
                     });
      }
    }
    const Vec<double, 2> move = read.take<2>();
    record_same(r, robot, q0, opposite, moved(q0, static_cast<int>(move[0]), move[1]));
  }

 private:
  using RobotStates::nq_;
  using RobotStates::nv_;
  using RobotStates::segments_;
  /// Whether the robot has a joint of the kind that the block measures.
  bool exists(const Output& o) const override {
    return o.block == block::same.text || this->has_joint(o.block == block::continuous.text ? 2
                                                          : o.block == block::joint.text    ? 1
                                                                                            : 7);
  }
  /// Asks whether q0 is the same configuration as its `opposite`, which is right, and as `other`, which is not.
  static void record_same(Recorder& r, const RobotOperations<double>& robot, const VecX<double>& q0,
                          const VecX<double>& opposite, const VecX<double>& other) {
    const auto& same = robot[op::robot_is_same];
    for (const bool right : {same(q0, opposite), !same(q0, other), !same(other, opposite)})
      if (right)
        r.record(op::robot_is_same[block::same], 0, 0);
      else
        r.outcome(op::robot_is_same[block::same], 0, Outcome::wrong_branch);
  }
  /// q with one coordinate of the tangent space moved [rad; relative to max(1, |p|)], up to rounding.
  VecX<double> moved(VecX<double> q, int coordinate, double by) const {
    for (const Segment& s : segments_) {
      const int k = coordinate - s.v;
      if (k < 0 || k >= (s.nq == 7 ? 6 : 1)) continue;
      if (s.nq == 7 && k < 3) {
        double scale = 1;
        for (int i = 0; i < 3; ++i) scale = std::max(scale, 2 * std::fabs(q[s.q + i]));
        q[s.q + k] += by * scale;
      } else if (s.nq == 7) {
        Vec<double, 4> turn = Vec<double, 4>::Zero();
        turn[k - 3] = std::sin(by / 2), turn[3] = std::cos(by / 2);
        q.segment<4>(s.q + 3) = quaternion_product<double>(Vec<double, 4>(q.segment<4>(s.q + 3)), turn);
      } else if (s.nq == 2) {
        const double c = q[s.q], sn = q[s.q + 1], cb = std::cos(by), sb = std::sin(by);
        q[s.q] = c * cb - sn * sb, q[s.q + 1] = sn * cb + c * sb;
      } else {
        q[s.q] += 2 * by * std::max(1.0, std::fabs(q[s.q]));
      }
    }
    return q;
  }
};

const RegisteredProperty<RobotConfiguration> registered_robot_configuration;

}  // namespace
}  // namespace liecheck::properties

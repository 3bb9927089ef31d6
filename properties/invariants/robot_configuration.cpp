// integrate and difference on the whole configuration vector of a robot, compared with the oracles joint by
// joint. A subject must treat Q and -Q as the same configuration.

#include <fmt/format.h>

#include <generators/rotations.hpp>
#include <invariants/branch.hpp>
#include <liecheck/urdf/urdf.hpp>
#include <map>
#include <mutex>
#include <optional>
#include <oracles/integrate.hpp>

namespace liecheck::properties {
namespace {

/// The offsets of a joint in q and v, and nq: 7 for a free-flyer, 2 for a continuous joint, otherwise 1.
struct Segment {
  int q, nq, v;
};

template <class S>
class RobotConfiguration final : public Law<RobotConfiguration, S> {
 public:
  static constexpr Statement stated{
      .name = "robot_configuration",
      .law =
          "integrate and difference act joint by joint on the whole vector, and -Q is the same "
          "configuration",
      .equation = "q1 = integrate(q0, d) and difference(q0, q1) per joint; q ~ q' for Q' = -Q",
      .source = "Pinocchio 3.8, joint-configuration",
      .outputs = {op::robot_integrate[block::rotation], op::robot_integrate[block::translation],
                  op::robot_integrate[block::continuous], op::robot_integrate[block::joint],
                  op::robot_difference[block::rotation_vector], op::robot_difference[block::linear],
                  op::robot_difference[block::continuous], op::robot_difference[block::joint],
                  op::robot_is_same[block::same]}};
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
        all.push_back({at + "_phi", Kind::rotation_vector, 3, "rad"});
      } else {
        all.push_back({at, Kind::opaque, 1, "m or rad"});
      }
    }
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
  std::vector<S> generate(Source& source) const override {
    VecX<S> q0(nq_), q1(nq_), d(nv_);
    for (const Segment& s : segments_) {
      if (s.nq == 7) {
        const auto p = vector3<S>(source, 8);
        const auto Q = unit_quaternion<S>(source);
        q0.segment(s.q, 7) << p, Q;
        q1.segment(s.q, 7) << point_near<S>(source, p), quaternion_near<S>(source, Q);
        d.segment(s.v, 6) << vector3<S>(source, 8), rotation_vector<S>(source, AngleRange::to_pi);
      } else if (s.nq == 2) {
        q0.template segment<2>(s.q) = circle(source);
        q1.template segment<2>(s.q) = circle(source);
        d[s.v] = angle<S>(source, AngleRange::to_pi) * (source.chance(1, 2) ? S(1) : S(-1));
      } else {
        q0[s.q] = magnitude<S>(source, 8);
        q1[s.q] = magnitude<S>(source, 8);
        d[s.v] = magnitude<S>(source, 8);
      }
    }
    return Joined<S>{q0, q1, d};
  }
  bool valid(const std::vector<S>& x) const override {
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
  template <class Real>
  void in(const Subject<S>& subject, const std::vector<S>& input, Recorder& r) const {
    using namespace oracles;
    const RobotOperations<S>& robot = bound(subject);
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
                         translation = op::robot_integrate[block::translation];
        judged_value(r, {rotation, translation}, band, q.segment(s.q, 7), next.resolved, [&] {
          const auto got = exact_vector<7, Real>(q.segment(s.q, 7));
          r.record(rotation, band, rotation_error<S>(quaternion_of(got), next.Q));
          r.record(translation, band,
                   vector_error<S>(head3(got), next.p, larger(norm(head3(x0)), next.increment_norm)));
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
    if (robot[op::robot_is_same](q0, opposite))
      r.record(op::robot_is_same[block::same], 0, 0);
    else
      r.outcome(op::robot_is_same[block::same], 0, Outcome::wrong_branch);
  }

 private:
  bool has(const Subject<S>& s, const Operation&) const override { return s.operations.robot; }
  /// Whether the robot has a joint of the kind that the block measures.
  bool exists(const Output& o) const override {
    const int nq = o.block == block::continuous.text ? 2 : o.block == block::joint.text ? 1 : 7;
    return o.block == block::same.text ||
           std::any_of(segments_.begin(), segments_.end(), [nq](const Segment& s) { return s.nq == nq; });
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

  struct Bound {
    std::optional<RobotOperations<S>> operations;
    std::exception_ptr error;
  };
  int nq_ = 0, nv_ = 0;
  std::vector<Segment> segments_;
  std::string urdf_;
  bool fixed_ = false;
  mutable std::mutex mutex_;
  mutable std::map<const Subject<S>*, Bound> bound_;
};

const RegisteredProperty<RobotConfiguration> registered;

}  // namespace
}  // namespace liecheck::properties

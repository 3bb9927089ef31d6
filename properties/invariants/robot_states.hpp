#pragma once
// The base class of laws on the configuration vector of a whole robot.

#include <fmt/format.h>

#include <generators/rotations.hpp>
#include <invariants/increments.hpp>
#include <map>
#include <mutex>
#include <optional>
#include <subjects/urdf_options.hpp>

namespace liecheck::properties {

/// The offsets of a joint in q and v, and nq: 7 for a free-flyer, 2 for a continuous joint, otherwise 1.
struct Segment {
  int q, nq, v;
};

/// What the laws on the configuration vector of a robot share.
class RobotStates : public Property {
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
    urdf_ = robot.urdf, fixed_ = robot.fixed, name_ = robot.name, mimics_ = robot.mimics;
    read(false);
  }
  std::string draw_for(const Subject& subject) override {
    if (mimics_ && subject.takes.mimics) read(true);
    return "";
  }

 protected:
  /// What a law adds to the numbers of q0, q1 and delta.
  virtual std::vector<Field> more_fields() const { return {}; }
  /// q0, q1 and delta. Positions and increments are sometimes as large as 1e7.
  template <class S>
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
        q0.template segment<2>(s.q) = circle<S>(source);
        q1.template segment<2>(s.q) = circle<S>(source);
        d[s.v] = angle<S>(source, AngleRange::unbounded) * (source.chance(1, 2) ? S(1) : S(-1));
      } else {
        for (S* x : {&q0[s.q], &q1[s.q], &d[s.v]}) *x = magnitude<S>(source, reach());
      }
    }
    return Joined<S>{q0, q1, d};
  }
  bool valid(const std::vector<double>& x) const override {
    if (!Property::valid(x)) return false;
    for (const Segment& s : segments_)  // (cos, sin) are unit within the contract
      for (int at : {s.q, nq_ + s.q}) {
        const auto i = static_cast<std::size_t>(at);
        if (s.nq == 2 && oracles::norm_defect(scalar(), oracles::Quaternion<>{{oracles::exact<Real>(x[i]),
                                                                               oracles::exact<Real>(x[i + 1]),
                                                                               Real(0), Real(0)}}) > 8)
          return false;
      }
    return true;
  }
  bool has(const Subject& s, const Operation&) const override { return s.operations.robot != nullptr; }
  bool has_joint(int nq) const {
    return std::any_of(segments_.begin(), segments_.end(), [nq](const Segment& s) { return s.nq == nq; });
  }
  /// A random (cos, sin), often near an axis, with norm 1 up to rounding.
  template <class S>
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
  const RobotOperations<double>& bound(const Subject& subject) const {
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
  /// `coupled`: mimics have no coordinates.
  void read(bool coupled) {
    const auto model = loadUrdfText(urdf_, urdf_options(fixed_, coupled), name_).model;
    nq_ = model.nq, nv_ = model.nv;
    segments_.clear();
    for (std::size_t j = 1; j < static_cast<std::size_t>(model.njoints); ++j)
      if (model.nqs[j] > 0)
        segments_.push_back({static_cast<int>(model.idx_qs[j]), static_cast<int>(model.nqs[j]),
                             static_cast<int>(model.idx_vs[j])});
  }

  struct Bound {
    std::optional<RobotOperations<double>> operations;
    std::exception_ptr error;
  };
  std::string urdf_, name_;
  bool fixed_ = false, mimics_ = false;
  mutable std::mutex mutex_;
  mutable std::map<const Subject*, Bound> bound_;
};

}  // namespace liecheck::properties

#pragma once
// The bodies of a robot and the forces on them, as a peer gets them. This file is C++17, because some peers'
// headers are not C++20.

#include <Eigen/Geometry>
#include <vector>

namespace liecheck::properties {

/// A body and its parent (-1: the world). The root may be free; other bodies rotate about, or move along,
/// `axis` (unit, in the body's frame).
struct PeerBody {
  enum class Joint { free, revolute, prismatic };
  int parent = -1;
  Joint joint = Joint::revolute;
  bool continuous = false;  ///< a rotation that q stores as (cos, sin)
  int q = 0, v = 0;         ///< indices of the joint's first numbers in q and v
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  Eigen::Isometry3d X_PB = Eigen::Isometry3d::Identity();  ///< of the body in its parent, at the angle 0
  double mass = 1;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();           ///< of mass, in B
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Identity();      ///< about the centre, in B's axes
  Eigen::Isometry3d X_BC = Eigen::Isometry3d::Identity();     ///< C: principal axes at the centre
  Eigen::Vector3d moments = Eigen::Vector3d::Ones();          ///< principal moments
  double armature = 0, damping = 0, stiffness = 0, rest = 0;  ///< of the joint, if it is not free

  bool free() const { return joint == Joint::free; }
  /// The angle [rad] or the displacement [m] in a configuration.
  double position(const Eigen::VectorXd& from) const {
    return continuous ? std::atan2(from[q + 1], from[q]) : from[q];
  }
  void set_position(Eigen::VectorXd& to, double x) const {
    if (continuous)
      to[q] = std::cos(x), to[q + 1] = std::sin(x);
    else
      to[q] = x;
  }
  /// The pose X_WB and the velocities of the origin and of the frame, in the world's axes, of a free body.
  Eigen::Isometry3d pose(const Eigen::VectorXd& from) const {
    const Eigen::Quaterniond Q(from[q + 6], from[q + 3], from[q + 4], from[q + 5]);
    return Eigen::Translation3d(from.segment<3>(q)) * Q;
  }
  void set_free(Eigen::VectorXd& to_q, Eigen::VectorXd& to_v, const Eigen::Vector3d& p,
                const Eigen::Quaterniond& Q, const Eigen::Vector3d& u_W, const Eigen::Vector3d& w_W) const {
    to_q.segment<7>(q) << p, Q.x(), Q.y(), Q.z(), Q.w();
    to_v.segment<6>(v) << Q.conjugate() * u_W, Q.conjugate() * w_W;
  }
};

/// The forces of the effects that a peer does not have itself, by liecheck's formulas. The peer sets t, q and
/// v, calls see() for each body if `poses`, then evaluate(), and applies tau and the wrenches on the bodies.
class PeerLoad {
 public:
  virtual ~PeerLoad() = default;
  bool poses = false;  ///< whether an effect reads the bodies' poses or velocities
  double t = 0;
  Eigen::VectorXd q, v, tau;  ///< tau of a free root is 0: its part is in the wrench
  struct Wrench {
    bool acts = false;
    Eigen::Vector3d force, moment;  ///< in the world's axes; the moment is about the centre of mass
  };
  std::vector<Wrench> wrenches;  ///< on each body

  /// Pose of a body and velocities of its origin and of its frame, in the world's axes.
  virtual void see(std::size_t body, const Eigen::Matrix3d& R, const Eigen::Vector3d& p,
                   const Eigen::Vector3d& u_W, const Eigen::Vector3d& w_W) = 0;
  virtual void evaluate() = 0;
};

}  // namespace liecheck::properties

#pragma once
// Other people's simulators on our scenes. One file each; what is not found at build time is absent.
//
// A peer is set up as its manual says, contact and damping off, and stepped through its own public interface. It may
// run scenes of one free body, or of a chain of revolute joints that hangs on the world.

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <scenes/runner.hpp>

namespace liecheck::properties {

/// A body on its parent (-1: the world): free, or turning about `axis` (unit, in its own frame) at p_PB.
struct PeerBody {
  int parent = -1;
  bool free = false;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ(), at = Eigen::Vector3d::Zero();
  double mass = 1;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(), moments = Eigen::Vector3d::Ones();  ///< about the centre
};
/// The bodies of a scene that peers can run; empty for any other.
std::vector<PeerBody> peer_bodies(const Benchmark& scene);

/// A way to step: adaptive ones take a tolerance.
struct PeerMethod {
  std::string name;
  int order = 0;
  bool adaptive = false;
};

struct Peer {
  std::string name, version;
  /// Those that run the scene.
  std::function<std::vector<PeerMethod>(const Benchmark&)> methods;
  std::function<std::unique_ptr<Runner>(const Benchmark&, const std::string& method)> make;
};

/// Those of this build, by name, and the names of the others.
const std::vector<Peer>& peers();
std::vector<std::string> absent_peers();

struct PeerRegistration {
  explicit PeerRegistration(Peer peer);
};

/// Fixed steps: what a peer fills in.
class PeerRunner : public Runner {
 public:
  explicit PeerRunner(const Benchmark& scene) : scene_(scene), bodies_(peer_bodies(scene)) {}
  long run(const Effort& effort, long samples,
           const std::function<void(double, const Moment&)>& watch) override;
  void pass(const Effort& effort) override;

 protected:
  virtual void reset(double h) = 0;
  virtual void step() = 0;
  virtual void read(Eigen::VectorXd& q, Eigen::VectorXd& v) const = 0;
  Moment moment() const;

  const Benchmark scene_;
  const std::vector<PeerBody> bodies_;
};

/// Of a free body's configuration: R_WB, and of its velocity the parts.
inline Eigen::Quaterniond attitude_of(const Eigen::VectorXd& q) {
  return Eigen::Quaterniond(q[6], q[3], q[4], q[5]);
}
/// q and v of a free body from its frame's position, attitude and world velocities.
inline void set_free(Eigen::VectorXd& q, Eigen::VectorXd& v, const Eigen::Vector3d& p,
                     const Eigen::Quaterniond& Q, const Eigen::Vector3d& velocity_W,
                     const Eigen::Vector3d& omega_W) {
  q.resize(7), v.resize(6);
  q << p, Q.x(), Q.y(), Q.z(), Q.w();
  v << Q.conjugate() * velocity_W, Q.conjugate() * omega_W;
}

}  // namespace liecheck::properties

#pragma once
// Other people's simulators on our scenes. One file each; what is not found at build time is absent.
//
// A peer is set up as its manual says, contact and damping off, and stepped through its own public interface. It may
// run scenes of one free body, or of a chain of revolute joints that hangs on the world.

#include <Eigen/Geometry>
#include <memory>
#include <scenes/peers/peer_body.hpp>
#include <scenes/runner.hpp>

namespace liecheck::properties {

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

/// Each is a module beside the program (folder scene_peers), loaded when it is asked for, so that no other command pays
/// for it: those found, by name, and the names of the others. Throws std::runtime_error for a module of another build.
const std::vector<Peer>& peers();
std::vector<std::string> absent_peers();

/// What a module exports: a peer, and the size of what it shares with the program.
struct PeerModule {
  std::size_t layout = sizeof(Benchmark) + 1000 * sizeof(Peer);
  Peer peer;
};
#define LIECHECK_SCENE_PEER(...)                                                                            \
  extern "C" [[gnu::visibility("default")]] const liecheck::properties::PeerModule* liecheck_scene_peer() { \
    static const liecheck::properties::PeerModule module{.peer = __VA_ARGS__};                              \
    return &module;                                                                                         \
  }

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

#pragma once
// Peers are other simulators that run our scenes. A peer that CMake does not find is absent.
//
// A peer is set up as its manual says, without contact and damping, and stepped through its public interface.
// It can run scenes with one free body, or with a chain of revolute joints on the world.

#include <Eigen/Geometry>
#include <memory>
#include <scenes/peers/peer_body.hpp>
#include <scenes/runner.hpp>

namespace liecheck::properties {

/// The bodies of a scene that peers can run; empty for any other.
std::vector<PeerBody> peer_bodies(const Benchmark& scene);

/// An integrator of a peer. An adaptive one takes a tolerance.
struct PeerMethod {
  std::string name;
  int order = 0;
  bool adaptive = false;
};

struct Peer {
  std::string name, version;
  /// Returns the methods that can run the scene.
  std::function<std::vector<PeerMethod>(const Benchmark&)> methods;
  std::function<std::unique_ptr<Runner>(const Benchmark&, const std::string& method)> make;
};

/// The peers that CMake found, and the names of the others. Each peer is a shared library in the folder
/// scene_peers of the build; it is loaded by the first call, so that other commands start fast. Throws
/// std::runtime_error for a library of another build.
const std::vector<Peer>& peers();
std::vector<std::string> absent_peers();

/// A peer's library exports this: the peer, and a number that depends on the sizes of the shared types.
struct PeerModule {
  std::size_t layout = sizeof(Benchmark) + 1000 * sizeof(Peer);
  Peer peer;
};
#define LIECHECK_SCENE_PEER(...)                                                                            \
  extern "C" [[gnu::visibility("default")]] const liecheck::properties::PeerModule* liecheck_scene_peer() { \
    static const liecheck::properties::PeerModule module{.peer = __VA_ARGS__};                              \
    return &module;                                                                                         \
  }

/// A runner with fixed steps. A peer implements reset, step and read.
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
  void advance(long steps);

  const Benchmark scene_;
  const std::vector<PeerBody> bodies_;
};

/// The attitude R_WB in the configuration of a free body.
inline Eigen::Quaterniond attitude_of(const Eigen::VectorXd& q) {
  return Eigen::Quaterniond(q[6], q[3], q[4], q[5]);
}
/// Sets q and v of a free body from the position, attitude and world velocities of its frame.
inline void set_free(Eigen::VectorXd& q, Eigen::VectorXd& v, const Eigen::Vector3d& p,
                     const Eigen::Quaterniond& Q, const Eigen::Vector3d& velocity_W,
                     const Eigen::Vector3d& omega_W) {
  q.resize(7), v.resize(6);
  q << p, Q.x(), Q.y(), Q.z(), Q.w();
  v << Q.conjugate() * velocity_W, Q.conjugate() * omega_W;
}

}  // namespace liecheck::properties

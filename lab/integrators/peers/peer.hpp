#pragma once
// Peers are other simulators that run our scenes. A peer that CMake does not find is absent.
//
// A peer is set up as its manual says, and stepped through its public interface. It gets the same robot: any
// tree of revolute, continuous and prismatic joints on the world or on a free root. Effects that it has
// itself, by the same formula, are its own. It gets the forces of all others, such as contact, from
// liecheck's formulas (PeerLoad), at each evaluation of its equations or, if it does not let them in there,
// once a step. So every simulator integrates the same physics, and a peer's own contact is never measured.

#include <Eigen/Geometry>
#include <memory>
#include <integrators/peers/peer_body.hpp>
#include <scenes/runner.hpp>

namespace liecheck::properties {

/// Why no peer can run the scene; "" if peers can.
std::string why_no_peer(const Benchmark& scene);
/// The bodies of a scene that peers can run.
std::vector<PeerBody> peer_bodies(const Benchmark& scene);
/// The forces of the scene's effects on joints and bodies, except those of the names in `own`; null if there
/// are none.
std::unique_ptr<PeerLoad> peer_load(const Benchmark& scene, const std::vector<std::string>& own);

/// An integrator of a peer. An adaptive one takes a tolerance.
struct PeerMethod {
  std::string name;
  int order = 0;
  bool adaptive = false;
};

struct Peer {
  std::string name, version;
  /// Returns why the peer cannot run the scene, or "".
  std::function<std::string(const Benchmark&)> why_not;
  std::function<std::vector<PeerMethod>(const Benchmark&)> methods;  ///< for a scene that it can run
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

/// A runner with fixed steps. A peer implements reset, step and read. `own` are the effects that it has
/// itself.
class PeerRunner : public Runner {
 public:
  explicit PeerRunner(const Benchmark& scene, const std::vector<std::string>& own = {})
      : scene_(scene), bodies_(peer_bodies(scene)), load_(peer_load(scene, own)) {}
  long run(const Effort& effort, long samples,
           const std::function<void(double, const Moment&)>& watch) override;
  void pass(const Effort& effort) override;

 protected:
  virtual void reset(double h) = 0;
  virtual void step() = 0;
  /// Sets q and v, which have their sizes.
  virtual void read(Eigen::VectorXd& q, Eigen::VectorXd& v) const = 0;
  Moment moment() const;
  void advance(long steps);

  const Benchmark scene_;
  const std::vector<PeerBody> bodies_;
  const std::unique_ptr<PeerLoad> load_;  ///< null if there are no such forces
};

}  // namespace liecheck::properties

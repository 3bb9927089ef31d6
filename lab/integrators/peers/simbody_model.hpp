#pragma once
// An interface to Simbody without Simbody's headers. This file is C++17.

#include <memory>
#include <integrators/peers/peer_body.hpp>
#include <string>
#include <vector>

namespace liecheck::properties {

struct SimbodyScene {
  std::vector<PeerBody> bodies;
  Eigen::Vector3d gravity;
  Eigen::VectorXd q0, v0;
  double duration;
  PeerLoad* load;  ///< may be null; must outlive the model
};

class SimbodyModel {
 public:
  virtual ~SimbodyModel() = default;
  virtual void start(double accuracy) = 0;
  /// Runs up to time t. Returns why it could not, or "".
  virtual std::string to(double t) = 0;
  /// Sets q and v to the present state, in the coordinates of q0 and v0.
  virtual void read(Eigen::VectorXd& q, Eigen::VectorXd& v) const = 0;
  virtual long steps() const = 0;
};
/// method: RKMerson, RKFehlberg or Verlet.
std::unique_ptr<SimbodyModel> make_simbody_model(const SimbodyScene& scene, const std::string& method);
std::string simbody_version();

}  // namespace liecheck::properties

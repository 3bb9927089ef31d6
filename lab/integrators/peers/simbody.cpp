// Simbody (Apache-2.0): generalized coordinates; Runge-Kutta pairs and Verlet, each with a given accuracy.
// Gravity is its own; the other forces enter at each evaluation of its equations. simbody_model.cpp is C++17,
// because in C++20 the operator== of Simbody's headers is ambiguous.

#include <integrators/peers/make_peer.hpp>
#include <integrators/peers/simbody_model.hpp>

namespace liecheck::properties {
namespace {

class SimbodyRunner final : public PeerRunner {
 public:
  SimbodyRunner(const Benchmark& scene, const std::string& method)
      : PeerRunner(scene),
        model_(make_simbody_model({bodies_, scene.gravity, scene.q0, scene.v0, scene.duration, load_.get()},
                                  method)) {}

  long run(const Effort& effort, long samples,
           const std::function<void(double, const Moment&)>& watch) override {
    model_->start(effort.tolerance);
    watch(0, moment());
    for (long k = 1; k <= samples; ++k) {
      const double t = double(k) * scene_.duration / double(samples);
      to(t);
      watch(t, moment());
    }
    return model_->steps();
  }
  void pass(const Effort& effort) override {
    model_->start(effort.tolerance);
    to(scene_.duration);
  }

 protected:
  void reset(double) override {}
  void step() override {}
  void read(Eigen::VectorXd& q, Eigen::VectorXd& v) const override { model_->read(q, v); }

 private:
  void to(double t) {
    const std::string why = model_->to(t);
    if (!why.empty()) throw Diverged(why);
  }
  std::unique_ptr<SimbodyModel> model_;
};

const Peer peer = make_peer<SimbodyRunner>(
    "Simbody", simbody_version(), {{"RKMerson", 4, true}, {"RKFehlberg", 5, true}, {"Verlet", 2, true}});

}  // namespace
}  // namespace liecheck::properties

LIECHECK_SCENE_PEER(liecheck::properties::peer)

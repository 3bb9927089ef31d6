#pragma once
// Position and velocity of the robot's centre of mass, in the world's axes.

#include <liecheck/scene/observers/momentum.hpp>

namespace liecheck::scene {

inline const PartInfo centre_of_mass_info{
    "centre_of_mass", "c = sum m c_i / sum m,  c_dot = P / sum m", "", "poses and velocities at samples", {}};

class CentreOfMassObserver final : public Observer {
 public:
  CentreOfMassObserver(const Parameters&, const Watched& watched) : model_(*watched.model) {
    for (const Inertia<double>& I : model_.inertias) mass_ += I.mass();
    mass_ -= model_.inertias[0].mass();
    if (!(mass_ > 0)) throw std::invalid_argument("the robot has no mass, and so no centre of mass");
  }
  Kinematics needs() const override { return Kinematics::Velocities; }
  std::vector<Column> columns() const override {
    return {{"com.x", "m"},    {"com.y", "m"},    {"com.z", "m"},
            {"com.vx", "m/s"}, {"com.vy", "m/s"}, {"com.vz", "m/s"}};
  }
  void sample(const Now<double>& now, std::span<double> row) override {
    const Vector3<double> c = centreOfMass(model_, now), P = centroidalMomentum(model_, now).linear();
    for (std::size_t i = 0; i < 3; ++i) row[i] = c[int(i)], row[3 + i] = P[int(i)] / mass_;
  }

 private:
  const Model<double>& model_;
  double mass_ = 0;
};

}  // namespace liecheck::scene

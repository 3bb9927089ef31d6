#pragma once
// Pose and velocity of a frame.

#include <liecheck/scene/effects/coordinates.hpp>
#include <liecheck/scene/observers/observer.hpp>

namespace liecheck::scene {

inline const PartInfo frame_info{"frame",
                                 "X_WF = X_WJ X_JF,  p_dot = R u",
                                 "",
                                 "poses and velocities at samples",
                                 {{"frame", Kind::Frame, "", nullptr, "the frame to record"}}};

class FrameObserver final : public Observer {
 public:
  FrameObserver(const Parameters& p, const Watched& watched)
      : name_(p.word("frame")), spot_(*watched.model, name_) {}
  Kinematics needs() const override { return Kinematics::Velocities; }
  std::vector<Column> columns() const override {
    std::vector<Column> all;
    for (const char* part : {"x", "y", "z"}) all.push_back({name_ + "." + part, "m"});
    for (const char* part : {"qx", "qy", "qz", "qw"}) all.push_back({name_ + "." + part, "1"});
    for (const char* part : {"vx", "vy", "vz"}) all.push_back({name_ + "." + part, "m/s"});
    return all;
  }
  void sample(const Now<double>& now, std::span<double> row) override {
    const SE3<double> X = spot_.pose(now);
    const Vector3<double> u = X.rotation() * spot_.velocity(now).linear();
    const Vector4<double> Q = SO3<double>::fromMatrix(X.rotation()).normalized().to_vector();
    for (std::size_t i = 0; i < 3; ++i) row[i] = X.translation()[int(i)], row[7 + i] = u[int(i)];
    for (std::size_t i = 0; i < 4; ++i) row[3 + i] = Q[int(i)];
  }

 private:
  std::string name_;
  Spot<double> spot_;
};

}  // namespace liecheck::scene

#pragma once
// An inertial measurement unit with noise and bias, mounted at a frame.
//
//   gyroscope      omega + b_g + n_g                 b_dot: white noise of density `*_walk`
//   accelerometer  R^T (p_ddot - g) + b_a + n_a      n: white noise of density d; sigma = d/sqrt(T)
//
// El-Sheimy, Hou & Niu (2008). T is the time between samples, p_ddot the acceleration of the frame's origin.

#include <cstdint>
#include <liecheck/scene/effects/coordinates.hpp>
#include <liecheck/scene/observers/observer.hpp>
#include <random>

namespace liecheck::scene {

inline const PartInfo imu_info{
    "imu",
    "omega + b_g + n_g,  R^T (p_ddot - g) + b_a + n_a",
    "",
    "accelerations, poses and velocities at samples",
    {{"frame", Kind::Frame, "", nullptr, "where it is mounted"},
     {"gyro_bias", Kind::Vector, "rad/s", "[0, 0, 0]", "b_g at the start"},
     {"accel_bias", Kind::Vector, "m/s^2", "[0, 0, 0]", "b_a at the start"},
     {"gyro_noise", Kind::NotNegative, "rad/s/sqrt(Hz)", "0", "density of n_g"},
     {"accel_noise", Kind::NotNegative, "m/s^2/sqrt(Hz)", "0", "density of n_a"},
     {"gyro_walk", Kind::NotNegative, "rad/s^2/sqrt(Hz)", "0", "density of b_g's rate"},
     {"accel_walk", Kind::NotNegative, "m/s^3/sqrt(Hz)", "0", "density of b_a's rate"},
     {"seed", Kind::NotNegative, "1", "42", "a whole number that selects the noise"}}};

/// Normally distributed numbers by Box & Muller (1958), the same on every machine with the same libm.
class NormalNumbers {
 public:
  explicit NormalNumbers(std::uint64_t seed) : bits_(seed) {}
  double operator()() {
    const double u = (double(bits_() >> 11) + 0.5) * 0x1p-53, w = double(bits_() >> 11) * 0x1p-53;
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * pi<double>() * w);
  }
  Vector3<double> vector(double sigma) {
    if (sigma == 0) return Vector3<double>::Zero();
    const double x = (*this)(), y = (*this)(), z = (*this)();
    return {sigma * x, sigma * y, sigma * z};
  }

 private:
  std::mt19937_64 bits_;
};

class ImuObserver final : public Observer {
 public:
  ImuObserver(const Parameters& p, const Watched& watched)
      : watched_(watched),
        name_(p.word("frame")),
        spot_(*watched.model, name_),
        gyro_bias_(vectorOf<double>(p.numbers("gyro_bias"))),
        accel_bias_(vectorOf<double>(p.numbers("accel_bias"))),
        gyro_noise_(p.number("gyro_noise")),
        accel_noise_(p.number("accel_noise")),
        gyro_walk_(p.number("gyro_walk")),
        accel_walk_(p.number("accel_walk")),
        normal_(std::uint64_t(p.number("seed"))) {}
  Kinematics needs() const override { return Kinematics::Accelerations; }
  std::vector<Column> columns() const override {
    std::vector<Column> all;
    for (const char* part : {"gyro_x", "gyro_y", "gyro_z"}) all.push_back({name_ + "." + part, "rad/s"});
    for (const char* part : {"accel_x", "accel_y", "accel_z"}) all.push_back({name_ + "." + part, "m/s^2"});
    return all;
  }
  void sample(const Now<double>& now, std::span<double> row) override {
    const double root = std::sqrt(watched_.interval);
    const Motion<double> V = spot_.velocity(now), A = spot_.X_JF.actInv(now.A[spot_.joint]);
    const Vector3<double> p_ddot = A.linear() + cross<double>(V.angular(), V.linear());
    const Vector3<double> g = spot_.pose(now).rotation().transpose() * watched_.model->gravity;
    if (!first_) {
      gyro_bias_ += normal_.vector(gyro_walk_ * root);
      accel_bias_ += normal_.vector(accel_walk_ * root);
    }
    first_ = false;
    const Vector3<double> gyro = V.angular() + gyro_bias_ + normal_.vector(gyro_noise_ / root);
    const Vector3<double> accel = p_ddot - g + accel_bias_ + normal_.vector(accel_noise_ / root);
    for (std::size_t i = 0; i < 3; ++i) row[i] = gyro[int(i)], row[3 + i] = accel[int(i)];
  }

 private:
  Watched watched_;
  std::string name_;
  Spot<double> spot_;
  Vector3<double> gyro_bias_, accel_bias_;
  double gyro_noise_, accel_noise_, gyro_walk_, accel_walk_;
  NormalNumbers normal_;
  bool first_ = true;
};

}  // namespace liecheck::scene

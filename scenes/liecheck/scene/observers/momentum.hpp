#pragma once
// Linear and angular momentum in the world's axes. The angular momentum is about the centre of mass.

#include <liecheck/scene/observers/observer.hpp>

namespace liecheck::scene {

inline const PartInfo momentum_info{"momentum",
                                    "P = sum m c_dot,  L = sum of R (I V) about the centre of mass",
                                    "",
                                    "poses and velocities at samples",
                                    {}};

/// The centre of mass in the world [m].
inline Vector3<double> centreOfMass(const Model<double>& model, const Now<double>& now) {
  double mass = 0;
  Vector3<double> c = Vector3<double>::Zero();
  for (std::size_t i = 1; i < model.inertias.size(); ++i) {
    mass += model.inertias[i].mass();
    c += model.inertias[i].mass() * now.X_WJ[i].act(model.inertias[i].lever());
  }
  if (mass > 0) c /= mass;
  return c;
}

/// (P, L about the centre of mass) [kg m/s, kg m^2/s].
inline Force<double> centroidalMomentum(const Model<double>& model, const Now<double>& now) {
  const Vector3<double> c = centreOfMass(model, now);
  Vector3<double> P = Vector3<double>::Zero(), L = P;
  for (std::size_t i = 1; i < model.inertias.size(); ++i) {
    // computed about the centre of mass of each body, to avoid cancellation
    const Inertia<double>& I = model.inertias[i];
    const Matrix3<double>& R = now.X_WJ[i].rotation();
    const Vector3<double> u = now.V[i].linear() + cross<double>(now.V[i].angular(), I.lever());
    const Vector3<double> p = I.mass() * product<double>(R, u);
    const Vector3<double> own = product<double>(R, Vector3<double>(I.inertia() * now.V[i].angular()));
    P += p;
    L += own + (model.inertias.size() == 2
                    ? Vector3<double>(Vector3<double>::Zero())
                    : cross<double>(Vector3<double>(now.X_WJ[i].act(I.lever()) - c), p));
  }
  return {P, L};
}

class MomentumObserver final : public Observer {
 public:
  MomentumObserver(const Parameters&, const Watched& watched) : watched_(watched) {}
  Kinematics needs() const override { return Kinematics::Velocities; }
  std::vector<Column> columns() const override {
    return {{"P_x", "kg m/s"},   {"P_y", "kg m/s"},   {"P_z", "kg m/s"},
            {"L_x", "kg m^2/s"}, {"L_y", "kg m^2/s"}, {"L_z", "kg m^2/s"}};
  }
  void sample(const Now<double>& now, std::span<double> row) override {
    const Force<double> h = centroidalMomentum(*watched_.model, now);
    for (std::size_t i = 0; i < 3; ++i) row[i] = h.linear()[int(i)], row[3 + i] = h.angular()[int(i)];
    if (!first_) first_ = h;
    linear_ = std::max(linear_, (h.linear() - first_->linear()).stableNorm());
    angular_ = std::max(angular_, (h.angular() - first_->angular()).stableNorm());
  }
  std::vector<Figure> figures() const override {
    return {{"largest change of linear momentum", "kg m/s", linear_},
            {"largest change of angular momentum", "kg m^2/s", angular_}};
  }

 private:
  Watched watched_;
  std::optional<Force<double>> first_;
  double linear_ = 0, angular_ = 0;
};

}  // namespace liecheck::scene

#pragma once
#include <liecheck/scene/effects/effect.hpp>

namespace liecheck::scene {

/// An index in v, and the index in q of the number with this rate. q is -1 if there is no such number
/// (spherical, planar and continuous joints).
struct Coordinate {
  int v, q;
};

/// The coordinates of the named joints; "all" is every joint except free-flyers and mimics. Throws
/// std::invalid_argument if there are none.
template <Scalar S>
std::vector<Coordinate> coordinates(const Model<S>& model, const std::vector<std::string>& names) {
  std::vector<Coordinate> all;
  const bool every = names.size() == 1 && names[0] == "all";
  for (std::size_t i = 1; i < model.joints.size(); ++i) {
    const bool named = std::find(names.begin(), names.end(), model.names[i]) != names.end();
    if (every ? std::holds_alternative<FreeFlyer<S>>(model.joints[i]) : !named) continue;
    for (int k = 0; k < model.nvs[i]; ++k)
      all.push_back({model.idx_vs[i] + k, model.nqs[i] == model.nvs[i] ? model.idx_qs[i] + k : -1});
  }
  if (all.empty())
    throw std::invalid_argument(
        every ? "the robot has no joint that this can act on, except a free-flyer, which must be named"
              : "none of the joints named has a coordinate");
  return all;
}
/// The coordinates with a scalar position in q. Throws std::invalid_argument if a named joint lacks one.
template <Scalar S>
std::vector<Coordinate> positions(const Model<S>& model, const std::vector<std::string>& names) {
  std::vector<Coordinate> with;
  for (const Coordinate& c : coordinates(model, names)) {
    if (c.q >= 0) {
      with.push_back(c);
    } else if (names[0] != "all") {
      const int joint = model.column_to_joint[std::size_t(c.v)];
      throw std::invalid_argument(
          "joint '" + model.names[std::size_t(joint)] +
          "' has no scalar position: name revolute, prismatic, helical or translation joints");
    }
  }
  if (with.empty()) throw std::invalid_argument("no joint of the robot has a scalar position");
  return with;
}

/// A frame of the robot, stored as the index of its joint and its pose X_JF in the joint's frame.
template <Scalar S>
struct Spot {
  std::size_t joint;
  SE3<S> X_JF;
  Spot(const Model<S>& model, const std::string& frame)
      : Spot(model.frames[std::size_t(model.requireFrameId(frame))]) {}

  SE3<S> pose(const Now<S>& now) const { return now.X_WJ[joint] * X_JF; }
  /// The frame's velocity, in its axes at its origin.
  Motion<S> velocity(const Now<S>& now) const { return X_JF.actInv(now.V[joint]); }
  /// The frame's origin, from the joint's origin, in the world's axes.
  Vector3<S> arm(const Now<S>& now) const { return product<S>(now.X_WJ[joint].rotation(), X_JF.translation()); }
  /// Adds a force given in the frame's axes at its origin.
  void add(const Now<S>& now, const Load<S>& load, const Force<S>& F_F) const {
    const Matrix3<S>& R = now.X_WJ[joint].rotation();
    const Force<S> F = X_JF.act(F_F);
    const Force<S> F_W(product<S>(R, F.linear()), product<S>(R, F.angular()));
    load.f[joint] = load.f[joint] + F_W;
  }
  /// Adds a force given in the world's axes at the frame's origin.
  void addWorld(const Now<S>& now, const Load<S>& load, const Vector3<S>& f, const Vector3<S>& n) const {
    load.f[joint] = load.f[joint] + Force<S>(f, Vector3<S>(n + cross<S>(arm(now), f)));
  }
  /// Adds a force that is constant in the frame's axes to the terms of a lone body. Returns true.
  bool addConstant(const Vector3<S>& centre, const Force<S>& F_F, BodyTerms<S>& terms) const {
    const Force<S> F = X_JF.act(F_F);
    terms.force_B += F.linear();
    terms.moment_B += F.angular() - cross<S>(centre, F.linear());
    return true;
  }

 private:
  explicit Spot(const Frame<S>& frame) : joint(std::size_t(frame.parentJoint)), X_JF(frame.placement) {}
};

/// The forces on the bodies in their joints' axes, as the algorithms of the library take them.
template <Scalar S, class Forces>
void toJointAxes(const Now<S>& now, Forces& f) {
  for (std::size_t i = 1; i < f.size(); ++i) {
    const Matrix3<S>& R = now.X_WJ[i].rotation();
    f[i] = Force<S>(transposed_product<S>(R, f[i].linear()), transposed_product<S>(R, f[i].angular()));
  }
}

template <Scalar S>
Vector3<S> vectorOf(const std::vector<double>& x) {
  return Vector3<S>(S(x.at(0)), S(x.at(1)), S(x.at(2)));
}

}  // namespace liecheck::scene

#pragma once
// System of any robot, by the articulated-body algorithm. It computes only the kinematics that effects read.

#include <liecheck/algorithms/aba.hpp>
#include <liecheck/multibody/configuration.hpp>
#include <liecheck/scene/accumulate.hpp>
#include <liecheck/scene/effects/effect.hpp>
#include <liecheck/scene/pieces.hpp>
#include <liecheck/scene/system.hpp>
#include <liecheck/scene/tangent_rate.hpp>

namespace liecheck::scene {

/// The functions of a step are not inlined, so that methods compile in seconds. This costs 0.2 % of a step.
template <Scalar S>
class Tree {
 public:
  using Scalar = S;
  using Configuration = VectorX<S>;
  using Tangent = VectorX<S>;
  struct Path {};

  explicit Tree(const Model<S>& robot, Effects<S> effects = {});

  int nq() const { return model_.nq; }
  int nv() const { return model_.nv; }
  const Model<S>& model() const { return model_; }
  const Effects<S>& effects() const { return effects_; }  ///< without the effects that act on the model
  Kinematics needs() const { return needs_; }
  Pieces<S>& pieces() { return pieces_; }
  Switches<S>& switches() { return switches_; }

  bool readsConfiguration() const { return true; }

  void acceleration(const S& t, const Configuration& q, const Tangent& v, Tangent& a) {
    if (!effects_.empty() && !kept_.take(t, q, v)) load(t, q, v);
    equations(q, v, a);
  }
  void keep(const S& t, const Configuration& q, const Tangent& v) { kept_.keep(t, q, v); }
  /// Sums the forces of all effects. They share the kinematics with the equations.
  [[gnu::noinline]] void load(const S& t, const Configuration& q, const Tangent& v);
  /// Computes the poses and twists that effects and equations share.
  void move(const Configuration& q, const Tangent& v) {
    algorithms_detail::bodiesInWorldAxes<S>(model_, data_, q, v);
    moved_ = true;
  }
  /// Computes v_dot with the forces of the last load(), and with its poses and twists, if it had any.
  [[gnu::noinline]] void equations(const Configuration& q, const Tangent& v, Tangent& a);

  void integrate(const Configuration& q, const Tangent& delta, Configuration& result) const {
    for (const Straight& r : straight_)
      for (int k = 0; k < r.count; ++k) result[r.q + k] = q[r.q + k] + delta[r.v + k];
    forEachCurved([&](const auto& place) {
      place.configuration(result) = place.joint.integrate(place.configuration(q), place.tangent(delta));
    });
  }
  [[gnu::noinline]] void accumulate(Configuration& q, Tangent& low, const Tangent& delta) const;
  [[gnu::noinline]] void tangentRate(const Tangent& delta, const Tangent& v, Tangent& rate) const;
  void coefficientRate(const Configuration& q, const Tangent& v, Configuration& rate) const {
    multibody_detail::forEachJoint(model_, [&](const auto& place) {
      place.configuration(rate) =
          place.joint.integrateCoeffWiseJacobian(place.configuration(q)) * place.tangent(v);
    });
  }
  void normalize(Configuration& q) const {
    multibody_detail::forEachJoint(model_, [&](const auto& place) {
      const auto segment = std::as_const(place).configuration(std::as_const(q));
      place.configuration(q) = place.joint.normalized(segment);
    });
  }

  Tangent difference(const Configuration& q0, const Configuration& q1) const {
    return liecheck::difference(model_, q0, q1);
  }
  /// The state of the model is that of the system.
  void fromModel(const VectorX<S>& q, const VectorX<S>& v, State<Tree>& state) const { state.q = q, state.v = v; }
  std::pair<Configuration, Tangent> toModel(const State<Tree>& s) const { return {s.q, s.v}; }

  /// The state that effects and observers read, valid until the next call. Give a = v_dot for accelerations.
  Now<S> here(const State<Tree>& s, Kinematics kinematics, const Tangent* a = nullptr) {
    return here(s.t, s.q, s.v, kinematics, a);
  }
  Now<S> here(const S& t, const Configuration& q, const Tangent& v, Kinematics kinematics,
              const Tangent* a = nullptr) {
    moved_ = false, kept_.drop();
    if (a)
      forwardKinematics(model_, data_, q, v, *a);
    else if (kinematics == Kinematics::Poses)
      forwardKinematics(model_, data_, q);
    else if (kinematics == Kinematics::Velocities)
      forwardKinematics(model_, data_, q, v);
    const auto size = [](const auto& x) { return std::size_t(x.size()); };
    Now<S> now{t, pieces_.at(t), {q.data(), size(q)}, {v.data(), size(v)}, {}, {}, {}, &switches_};
    if (kinematics != Kinematics::None) now.X_WJ = data_.oMi();
    if (kinematics >= Kinematics::Velocities) now.V = {data_.v(), now.X_WJ, false};
    if (a) now.A = data_.a(), now.a = {a->data(), size(*a)};
    return now;
  }
  Data<S>& data() { return data_; }

 private:
  /// The equations of a robot with mimic joints, of which aba takes forces in the joints' axes.
  void dense(const Configuration& q, const Tangent& v, Tangent& a);
  /// A range of q and v in which integrate is a plain sum.
  struct Straight {
    int q, v, count;
  };
  template <class F>
  void forEachCurved(F f) const {
    for (const std::size_t i : curved_) multibody_detail::visitJoint(model_, i, f);
  }

  Model<S> model_;
  Data<S> data_;
  Effects<S> effects_;
  Kinematics needs_ = Kinematics::None;
  Pieces<S> pieces_;
  Switches<S> switches_;
  bool bodies_ = false;  ///< a force acts on a body
  Kept<S, Configuration, Tangent> kept_;
  bool moved_ = false;   ///< data_ has the poses and twists of the state of the last load()
  std::vector<Straight> straight_;
  std::vector<std::size_t> curved_;  ///< the joints that are not in such a range
  VectorX<S> tau_;
  std::vector<Force<S>> f_;
};

template <Scalar S>
Tree<S>::Tree(const Model<S>& robot, Effects<S> effects)
    : model_(robot), data_(robot, robot.has_mimics ? Dense::Mass : Dense::None) {
  model_.gravity.setZero(), model_.armature.setZero();
  for (const auto& e : effects) {
    e->prepare(model_);
    if (e->acts() == Acts::OnModel) continue;
    if (e->needs() > needs_) needs_ = e->needs();
    if (e->acts() == Acts::OnBodies) bodies_ = true;
    pieces_.add(e->events());
    effects_.push_back(e);
  }
  for (std::size_t i = 1; i < model_.joints.size(); ++i) {
    const int q = model_.idx_qs[i], v = model_.idx_vs[i], n = model_.nvs[i];
    if (model_.nqs[i] != n)
      curved_.push_back(i);
    else if (!straight_.empty() && straight_.back().q + straight_.back().count == q)
      straight_.back().count += n;
    else if (n > 0)
      straight_.push_back({q, v, n});
  }
  tau_ = VectorX<S>::Zero(model_.nv);
  f_.assign(std::size_t(model_.njoints), Force<S>::Zero());
}

template <Scalar S>
void Tree<S>::load(const S& t, const Configuration& q, const Tangent& v) {
  const auto size = [](const auto& x) { return std::size_t(x.size()); };
  Now<S> now{t, pieces_.at(t), {q.data(), size(q)}, {v.data(), size(v)}, {}, {}, {}, &switches_};
  if (needs_ != Kinematics::None) {
    move(q, v);
    now.X_WJ = data_.oMi(), now.V = {data_.work.velocity, now.X_WJ, true};
  }
  kept_.drop();
  switches_.restart();
  tau_.setZero();
  if (bodies_) std::fill(f_.begin(), f_.end(), Force<S>::Zero());
  for (const auto& e : effects_) e->add(now, {{tau_.data(), size(tau_)}, f_});
}

template <Scalar S>
void Tree<S>::equations(const Configuration& q, const Tangent& v, Tangent& a) {
  if (model_.has_mimics) return dense(q, v, a);
  if (!moved_) move(q, v);
  moved_ = false;
  algorithms_detail::articulatedBodies<S>(model_, data_, tau_, bodies_ ? External<S>(f_) : External<S>(), true);
  a = data_.ddq.write(Level::Velocity);
}

template <Scalar S>
void Tree<S>::accumulate(Configuration& q, Tangent& low, const Tangent& delta) const {
  for (const Straight& r : straight_)
    for (int k = 0; k < r.count; ++k) scene::accumulate<S>(q[r.q + k], low[r.v + k], delta[r.v + k]);
  forEachCurved([&](const auto& place) {
    auto x = place.configuration(std::as_const(q));
    auto rest = place.tangent(std::as_const(low));
    accumulateOf<S>(place.joint, x, rest, place.tangent(delta));
    place.configuration(q) = x, place.tangent(low) = rest;
  });
}

template <Scalar S>
void Tree<S>::tangentRate(const Tangent& delta, const Tangent& v, Tangent& rate) const {
  rate = v;
  forEachCurved([&](const auto& place) {
    place.tangent(rate) = tangentRateOf<S>(place.joint, place.tangent(delta), place.tangent(v));
  });
}

template <Scalar S>
void Tree<S>::dense(const Configuration& q, const Tangent& v, Tangent& a) {
  moved_ = false;
  if (!bodies_) return void(a = aba(model_, data_, q, v, tau_));
  forwardKinematics(model_, data_, q);
  for (std::size_t i = 1; i < f_.size(); ++i)
    f_[i] = SE3<S>(data_.oMi()[i].rotation(), Vector3<S>::Zero()).actInv(f_[i]);
  a = aba(model_, data_, q, v, tau_, External<S>(f_));
}

// In instantiations_tree_system.cpp.
extern template Tree<double>::Tree(const Model<double>&, Effects<double>);
extern template void Tree<double>::load(const double&, const VectorX<double>&, const VectorX<double>&);
extern template void Tree<double>::equations(const VectorX<double>&, const VectorX<double>&, VectorX<double>&);
extern template void Tree<double>::accumulate(VectorX<double>&, VectorX<double>&, const VectorX<double>&) const;
extern template void Tree<double>::tangentRate(const VectorX<double>&, const VectorX<double>&, VectorX<double>&) const;

}  // namespace liecheck::scene

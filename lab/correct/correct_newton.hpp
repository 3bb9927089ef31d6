#pragma once
// The subject correct:newton: the recursive equations of Newton and Euler with 3-vectors at the centres of
// mass, in the axes of each body. From the root to the tips, with o'' the acceleration of a joint's origin:
//
//   w = R^T w_p + S_w v,   w' = R^T w_p' + S_w a + w x S_w v
//   o'' = R^T (o_p'' + w_p' x p + w_p x (w_p x p)) + S_u a + (R^T w_p + w) x S_u v
//
// and back, with f = m (o'' + w' x c + w x (w x c)), n = I w' + w x I w + c x f and those of the children:
// tau = S_u^T f + S_w^T n + A a. Column k of M is tau at rest, without gravity, for a = e_k. Derivatives
// follow from dual numbers. Source: Luh, Walker & Paul 1980.

#include <correct/correct_tree_parts.hpp>

namespace liecheck::properties::correct {

template <class S>
class NewtonTree : TreeParts<S> {
 public:
  static constexpr const char *name = "correct:newton", *version = "recursion in the axes of each body";
  using B = TreeParts<S>;
  using typename B::D, typename B::M, typename B::M3, typename B::V3, typename B::V6, typename B::X;

  explicit NewtonTree(const Tree<S>& tree) : B(tree), bodies_(B::bodies()) {}

  X rnea(const X& q, const X& v, const X& a, int joint, const V6& F) const {
    return torque<S>(q, v, a, -gravity_, joint, F);
  }
  M mass(const X& q) const {
    M A(tree_.nv, tree_.nv);
    for (int k = 0; k < tree_.nv; ++k)
      A.col(k) = torque<S>(q, X::Zero(tree_.nv), X::Unit(tree_.nv, k), V3::Zero(), -1, V6::Zero());
    A.template triangularView<Eigen::StrictlyUpper>() = A.transpose().eval();
    return A;
  }
  std::pair<M, M> rnea_derivatives(const X& q, const X& v, const X& a, int joint, const V6& F) const {
    return B::derivatives(v, [&](const VecX<D>& moving, const X& moved) {
      return torque<D>(q, moving, a, -gravity_, joint, F, moved);
    });
  }

  /// Of the momenta of all bodies, or of their rates, at the common centre of mass.
  std::pair<M, M> momentum_derivatives(const X& q, const X& v, const X& a, bool of_rate) const {
    return B::derivatives(v, [&](const VecX<D>& moving, const X& moved) {
      const std::vector<Link<D>> links = this->template links<D>(q, moving, a, V3::Zero(), moved);
      S mass(0);
      V centre = V::Zero();
      for (const auto& b : bodies_) mass += b.mass, centre += D(b.mass) * at(links[b.joint], b);
      centre = (D(1 / mass) * centre).eval();
      Vec<D, 6> sum = Vec<D, 6>::Zero();
      for (const auto& b : bodies_) {
        const Link<D>& i = links[b.joint];
        const V c = b.c.template cast<D>(), moves = i.o1 + i.w.cross(c),
                pushed = i.o2 + i.w1.cross(c) + i.w.cross(i.w.cross(c));
        const Mat<D, 3> I = b.I.template cast<D>();
        const V h = I * i.w, turn = of_rate ? V(I * i.w1 + i.w.cross(h)) : h,
                f = i.world.R * V(D(b.mass) * (of_rate ? pushed : moves)), lever = at(i, b) - centre;
        sum += joined<D>(f, i.world.R * turn + lever.cross(f));
      }
      return VecX<D>(sum);
    });
  }
  std::pair<M, M> frame_derivatives(const X& q, const X& v, const X& a, Seen seen, bool acceleration) const {
    return B::derivatives(v, [&](const VecX<D>& moving, const X& moved) {
      const Link<D> i = this->template links<D>(q, moving, a, V3::Zero(), moved)[B::joint()];
      const V r = B::vector(tree_.frame_p).template cast<D>(), u = i.o1 + i.w.cross(r),
              o2 = i.o2 + i.w1.cross(r) + i.w.cross(i.w.cross(r));
      V top = u, low = i.w;
      if (acceleration) top = o2 - i.w.cross(u), low = i.w1;
      Mat<D, 3> R = i.world.R;
      if (seen == Seen::local) R = B::rotation(tree_.frame_Q).template cast<D>().transpose();
      const V linear = R * top, angular = R * low, p = i.world.p + i.world.R * r;
      return VecX<D>(joined<D>(seen == Seen::world ? V(linear + p.cross(angular)) : linear, angular));
    });
  }

 private:
  template <class T>
  struct Link {
    Pose<T> X;                ///< in the parent's axes
    Vec<T, 3> w, w1, o1, o2;  ///< angular velocity and acceleration, velocity and acceleration of the origin
    Pose<T> world;
    Vec<T, 3> f = Vec<T, 3>::Zero(), n = f;
  };

  using V = Vec<D, 3>;
  static V at(const Link<D>& link, const typename B::Centred& b) {
    return link.world.p + link.world.R * b.c.template cast<D>();
  }
  /// `up` is the acceleration of the world, -g.
  template <class T>
  std::vector<Link<T>> links(const X& q, const VecX<T>& v, const X& a, const V3& up, const X& moved) const {
    using V = Vec<T, 3>;
    std::vector<Link<T>> links;
    const Link<T> world{
        {}, V::Zero(), V::Zero(), V::Zero(), up.template cast<T>(), {Mat<T, 3>::Identity(), V::Zero()}};
    links.reserve(tree_.joints.size());
    for (std::size_t i = 0; i < tree_.joints.size(); ++i) {
      const int parent = tree_.joints[i].parent;
      const Link<T>& from = parent < 0 ? world : links[static_cast<std::size_t>(parent)];
      const auto [R, p] = this->template displaced<T>(i, q, moved);
      const int first = tree_.idx_v[i], n = static_cast<int>(columns_[i].cols());
      const Columns<T> own = columns_[i].template cast<T>();
      const Vec<T, 6> rate = own * v.segment(first, n), change = own * a.segment(first, n).template cast<T>();
      const V u = rate.template head<3>(), turn = rate.template tail<3>(), w_p = R.transpose() * from.w,
              w = w_p + turn, pull = from.o2 + from.w1.cross(p) + from.w.cross(from.w.cross(p)),
              carried = from.o1 + from.w.cross(p), both = w_p + w;
      const V w1 = R.transpose() * from.w1 + change.template tail<3>() + w.cross(turn),
              o1 = R.transpose() * carried + u,
              o2 = R.transpose() * pull + change.template head<3>() + both.cross(u);
      links.push_back({{R, p}, w, w1, o1, o2, {from.world.R * R, from.world.R * p + from.world.p}});
    }
    return links;
  }
  template <class T>
  VecX<T> torque(const X& q, const VecX<T>& v, const X& a, const V3& up, int joint, const V6& F,
                 const X& moved = {}) const {
    using V = Vec<T, 3>;
    std::vector<Link<T>> links = this->template links<T>(q, v, a, up, moved);
    for (const auto& b : bodies_) {
      Link<T>& i = links[b.joint];
      const V c = b.c.template cast<T>(), f = T(b.mass) * V(i.o2 + i.w1.cross(c) + i.w.cross(i.w.cross(c)));
      const Mat<T, 3> I = b.I.template cast<T>();
      const V h = I * i.w;
      i.f += f, i.n += I * i.w1 + i.w.cross(h) + c.cross(f);
    }
    VecX<T> tau = armature_.cwiseProduct(a).template cast<T>();
    for (std::size_t i = links.size(); i-- > 0;) {
      Link<T>& own = links[i];
      if (static_cast<int>(i) == joint)
        own.f -= F.template head<3>().template cast<T>(), own.n -= F.template tail<3>().template cast<T>();
      tau.segment(tree_.idx_v[i], columns_[i].cols()) +=
          columns_[i].template cast<T>().transpose() * joined<T>(own.f, own.n);
      if (const int at = tree_.joints[i].parent; at >= 0) {
        Link<T>& onto = links[static_cast<std::size_t>(at)];
        const V f = own.X.R * own.f;
        onto.f += f, onto.n += own.X.R * own.n + own.X.p.cross(f);
      }
    }
    return tau;
  }

  using B::armature_, B::columns_, B::gravity_, B::tree_;
  std::vector<typename B::Centred> bodies_;
};

}  // namespace liecheck::properties::correct

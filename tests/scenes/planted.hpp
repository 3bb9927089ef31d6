#pragma once
// Wrong terms of effects, one planted in the laws of the maximal coordinates at a time.

#include <oracles/motions/contact_laws.hpp>
#include <oracles/motions/force_laws.hpp>

namespace liecheck::test::planted {

namespace laws = oracles::laws;
using T = long double;
using V = oracles::Column3<T>;
using Now = oracles::Snapshot<T>;
using Tree = oracles::MaximalTree<T>;

/// A wrong term in the law of an effect.
struct Planted {
  const char *effect, *what;
  std::function<void(Tree&)> plant;
};

/// Changes the numbers of a law.
template <class Law>
std::function<void(Tree&)> changed(void (*change)(Law&)) {
  return [change](Tree& tree) { change(*tree.laws.at(0).add.target<Law>()); };
}
/// Replaces the equation of a law.
template <class Law>
std::function<void(Tree&)> instead(void (*add)(const Law&, Now&)) {
  return [add](Tree& tree) {
    const Law law = *tree.laws.at(0).add.target<Law>();
    tree.laws[0].add = [law, add](Now& s) { add(law, s); };
  };
}
/// The tree with other links.
inline void relink(Tree& tree, const std::function<void(std::vector<oracles::MaximalLink<T>>&)>& change) {
  auto links = tree.links();
  change(links);
  Tree other(links);
  other.laws = tree.laws, other.armature = tree.armature;
  tree = other;
}

using Gravity = laws::Gravity<T>;
using Wrench = laws::Wrench<T>;
using Damping = laws::JointDamping<T>;
using Friction = laws::JointFriction<T>;
using Spring = laws::JointSpring<T>;
using Limits = laws::JointLimits<T>;
using Drag = laws::Drag<T>;
using Buoyancy = laws::Buoyancy<T>;
using Thruster = laws::Thruster<T>;
using Contact = laws::Contact<T>;
using Constant = laws::ConstantForce<T>;
using Pd = laws::PdControl<T>;
using Table = laws::ForceTable<T>;
using Motor = laws::Motor<T>;
using AddedMass = laws::AddedMass<T>;
using Collisions = laws::Collisions<T>;

/// Contact with the terms that an argument changes.
struct WrongContact {
  bool at_centre = false, slides_at_centre = false, rolls_fully = false, depth_of_centre = false;
  void operator()(const Contact& c, Now& s) const {
    for (const auto& [at, r] : c.balls) {
      const auto& l = c.law;
      const V centre = s.point(at), lowest = centre - r * c.n, w = s.omega(at.link),
              u = s.velocity(at.link, slides_at_centre ? centre : lowest);
      const T x = c.height * c.n[2] + (depth_of_centre ? 0 : r) - c.n.dot(centre),
              factor = 1 - l.c * c.n.dot(u);
      const bool deep = s.on(x), pushes = s.on(factor);
      if (!deep || !pushes) continue;
      const T f_n = l.stiffness * l.power(x) * factor, w_n = c.n.dot(w);
      const V u_t = u - c.n.dot(u) * c.n, w_t = rolls_fully ? w : V(w - w_n * c.n);
      s.push(at.link, V(f_n * c.n - l.mu * f_n / std::sqrt(u_t.squaredNorm() + l.v_s * l.v_s) * u_t),
             at_centre ? centre : lowest);
      s.turn(at.link, V(-l.rho * f_n / std::sqrt(w_t.squaredNorm() + l.w_s * l.w_s) * w_t -
                        l.tau * f_n * w_n / std::sqrt(w_n * w_n + l.w_s * l.w_s) * c.n));
    }
  }
};
inline std::function<void(Tree&)> wrong(const WrongContact& equation) {
  return [equation](Tree& tree) {
    const Contact law = *tree.laws.at(0).add.target<Contact>();
    tree.laws[0].add = [law, equation](Now& s) { equation(law, s); };
  };
}

inline const std::vector<Planted>& all() {
  static const std::vector<Planted> terms = {
      {"gravity", "at the joint's origin", instead<Gravity>([](const Gravity& l, Now& s) {
         for (std::size_t i = 1; i < l.masses.size(); ++i)
           s.push(int(i), V(l.masses[i] * l.g), s.bodies[i].o);
       })},
      {"gravity", "on the root alone", changed<Gravity>([](Gravity& l) {
         for (std::size_t i = 2; i < l.masses.size(); ++i) l.masses[i] = 0;
         if (l.masses.size() == 2) l.g = -l.g;
       })},
      {"wrench", "at the joint's origin", changed<Wrench>([](Wrench& l) { l.at.p.setZero(); })},
      {"wrench", "in the joint's axes",
       changed<Wrench>([](Wrench& l) { l.at.R.setIdentity(), l.world = false; })},
      {"wrench", "at the centre of mass", instead<Wrench>([](const Wrench& l, Now& s) {
         if (!s.within(l.from, l.until)) return;
         const auto R = l.world ? oracles::Square3<T>(oracles::Square3<T>::Identity()) : s.axes(l.at);
         s.push(l.at.link, V(R * l.f), s.bodies[std::size_t(l.at.link)].c), s.turn(l.at.link, V(R * l.n));
       })},
      {"wrench", "without the moment", changed<Wrench>([](Wrench& l) { l.n.setZero(); })},
      {"wrench", "from and until confused with always",
       changed<Wrench>([](Wrench& l) { l.from = l.from < 0 ? T(0.1) : T(-1), l.until = 9; })},
      {"joint_damping", "with the other sign", changed<Damping>([](Damping& l) {
         for (T& d : l.d) d = -d;
       })},
      {"joint_damping", "d v |v|", instead<Damping>([](const Damping& l, Now& s) {
         for (std::size_t i = 0; i < l.k.size(); ++i)
           s.drives[l.k[i]] -= l.d[i] * s.rates[l.k[i]] * std::abs(s.rates[l.k[i]]);
       })},
      {"joint_friction", "with v_s for its square",
       changed<Friction>([](Friction& l) { l.slip = std::sqrt(l.slip); })},
      {"joint_friction", "f v/(|v| + v_s)", instead<Friction>([](const Friction& l, Now& s) {
         for (std::size_t i = 0; i < l.k.size(); ++i)
           s.drives[l.k[i]] -= l.f[i] * s.rates[l.k[i]] / (std::abs(s.rates[l.k[i]]) + l.slip);
       })},
      {"joint_spring", "without rest", changed<Spring>([](Spring& l) { l.rest = 0; })},
      {"joint_spring", "half as stiff", changed<Spring>([](Spring& l) { l.stiffness /= 2; })},
      {"joint_limits", "c with the other sign", changed<Limits>([](Limits& l) { l.c = -l.c; })},
      {"joint_limits", "that pull", instead<Limits>([](const Limits& l, Now& s) {
         for (std::size_t i = 0; i < l.k.size(); ++i)
           for (const int in : {1, -1}) {
             const T x = T(in) * ((in > 0 ? l.low[i] : l.high[i]) - s.positions[l.k[i]]);
             if (s.on(x)) s.drives[l.k[i]] += T(in) * l.stiffness * x * (1 - l.c * T(in) * s.rates[l.k[i]]);
           }
       })},
      {"joint_limits", "at the lower limit alone", changed<Limits>([](Limits& l) {
         for (T& x : l.high) x = std::numeric_limits<T>::infinity();
       })},
      {"armature", "missing",
       [](Tree& tree) { std::fill(tree.armature.begin(), tree.armature.end(), T(0)); }},
      {"armature", "as a rotor that turns with the child",
       [](Tree& tree) {
         auto I_m = tree.armature;
         std::fill(tree.armature.begin(), tree.armature.end(), T(0));
         relink(tree, [&](auto& links) {
           std::size_t at = 0;
           for (auto& l : links) {
             if (&l == links.data()) continue;
             if (l.kind == oracles::JointKind::revolute || l.kind == oracles::JointKind::continuous)
               l.inertia += I_m[at] * l.axis * l.axis.transpose();
             at += std::size_t(oracles::velocity_size(l.kind));
           }
         });
       }},
      {"drag", "c1 with the other sign", changed<Drag>([](Drag& l) { l.c1 = -l.c1; })},
      {"drag", "k1 with the other sign", changed<Drag>([](Drag& l) { l.k1 = -l.k1; })},
      {"drag", "at the joint's origin", changed<Drag>([](Drag& l) { l.at.p.setZero(); })},
      {"drag", "quadratic in each component", instead<Drag>([](const Drag& l, Now& s) {
         const V p = s.point(l.at), u = s.velocity(l.at.link, p), w = s.omega(l.at.link);
         s.push(l.at.link, V(-l.c1 * u - l.c2 * V(u.cwiseAbs().cwiseProduct(u))), p);
         s.turn(l.at.link, V(-(l.k1 + l.k2 * w.norm()) * w));
       })},
      {"drag", "k2 |omega|^2 without direction", instead<Drag>([](const Drag& l, Now& s) {
         const V p = s.point(l.at), u = s.velocity(l.at.link, p), w = s.omega(l.at.link);
         s.push(l.at.link, V(-(l.c1 + l.c2 * u.norm()) * u), p);
         s.turn(l.at.link, V(-l.k1 * w - l.k2 * V(w.cwiseProduct(w))));
       })},
      {"buoyancy", "at the joint's origin", changed<Buoyancy>([](Buoyancy& l) { l.at.p.setZero(); })},
      {"buoyancy", "downwards", changed<Buoyancy>([](Buoyancy& l) { l.g = -l.g; })},
      {"buoyancy", "at the centre of mass", instead<Buoyancy>([](const Buoyancy& l, Now& s) {
         s.push(l.at.link, V(-l.density * l.volume * l.g), s.bodies[std::size_t(l.at.link)].c);
       })},
      {"thruster", "k with the other sign", changed<Thruster>([](Thruster& l) { l.k = -l.k; })},
      {"thruster", "e in the joint's axes", changed<Thruster>([](Thruster& l) { l.at.R.setIdentity(); })},
      {"thruster", "a direction of any length", instead<Thruster>([](const Thruster& l, Now& s) {
         if (!s.within(l.from, l.until)) return;
         const V e = s.axes(l.at) * l.direction;
         s.push(l.at.link, V(l.thrust * e), s.point(l.at)), s.turn(l.at.link, V(l.k * l.thrust * e));
       })},
      {"contact", "c with the other sign", changed<Contact>([](Contact& l) { l.law.c = -l.law.c; })},
      {"contact", "v_s for its square", changed<Contact>([](Contact& l) { l.law.v_s = std::sqrt(l.law.v_s); })},
      {"contact", "rolling resistance along the rotation",
       changed<Contact>([](Contact& l) { l.law.rho = l.law.rho > 0 ? -l.law.rho : T(0.01); })},
      {"contact", "w_s for its square", changed<Contact>([](Contact& l) { l.law.w_s = std::sqrt(l.law.w_s); })},
      {"contact", "torsion with the coefficient of rolling",
       changed<Contact>([](Contact& l) { l.law.tau = l.law.rho; })},
      {"contact", "rolling resistance against all of the rotation", wrong({.rolls_fully = true})},
      {"contact", "a force at the centre", wrong({.at_centre = true})},
      {"contact", "slip of the centre", wrong({.slides_at_centre = true})},
      {"contact", "depth of the centre", wrong({.depth_of_centre = true})},
      {"constant", "without the reaction on the parent",
       [](Tree& tree) {
         tree.laws[0].add = [law = *tree.laws.at(0).add.target<Constant>(), links = tree.links()](Now& s) {
           law(s);
           for (std::size_t i = 1; i < links.size(); ++i)
             if (links[i].kind == oracles::JointKind::revolute)
               s.turn(links[i].parent, V(law.force * V(s.bodies[i].R * links[i].axis)));
         };
       }},
      {"pd", "without clamp", changed<Pd>([](Pd& l) {
         for (T& x : l.limits) x = std::numeric_limits<T>::infinity();
       })},
      {"pd", "d with the other sign", changed<Pd>([](Pd& l) { l.pursuit.d = -l.pursuit.d; })},
      {"pd", "without the rate of a cubic target", instead<Pd>([](const Pd& l, Now& s) {
         for (std::size_t i = 0; i < l.k.size(); ++i) {
           const T tau = l.pursuit(s, i, l.k[i]);
           const auto& table = l.pursuit.targets;
           s.drives[l.k[i]] += tau - (table.cubic ? l.pursuit.d * table.at(s, i).rate : T(0));
         }
       })},
      {"pd", "that clamps k (q_target - q) alone", instead<Pd>([](const Pd& l, Now& s) {
         for (std::size_t i = 0; i < l.k.size(); ++i)
           s.drives[l.k[i]] +=
               std::clamp(l.pursuit.stiffness * (l.pursuit.targets.at(s, i).x - s.positions[l.k[i]]), -l.limits[i],
                          l.limits[i]) -
               l.pursuit.d * s.rates[l.k[i]];
       })},
      {"table", "of steps", instead<Table>([](const Table& l, Now& s) {
         std::size_t row = 0;
         for (std::size_t i = 0; i < l.force.times.size(); ++i)
           if (l.force.times[i] <= s.inside) row = i;
         for (std::size_t i = 0; i < l.k.size(); ++i)
           s.drives[l.k[i]] += l.force.rows[row][l.force.width() == 1 ? 0 : i];
       })},
      {"table", "that ends with its last time", instead<Table>([](const Table& l, Now& s) {
         if (s.inside < l.force.times.back()) l(s);
       })},
      {"table", "of lines for cubics", changed<Table>([](Table& l) { l.force.cubic = !l.force.cubic; })},
      {"wrench", "with the first row of its table", changed<Wrench>([](Wrench& l) {
         if (l.table.width()) l.table.rows.resize(1), l.table.times.resize(1);
       })},
      {"wrench", "with the moment of its table missing", changed<Wrench>([](Wrench& l) {
         for (auto& row : l.table.rows) row.resize(3);
       })},
      {"drag", "against the current", changed<Drag>([](Drag& l) { l.current = -l.current; })},
      {"drag", "with a current in the joint's axes", instead<Drag>([](const Drag& l, Now& s) {
         Drag other = l;
         other.current = s.bodies[std::size_t(l.at.link)].R * l.current;
         other(s);
       })},
      {"contact", "with the exponent 1", changed<Contact>([](Contact& l) { l.law.exponent = 1; })},
      {"contact", "of centres for shapes", changed<Contact>([](Contact& l) {
         for (auto& ball : l.balls) ball.at.p = l.balls[0].at.p;
       })},
      {"collisions", "c with the other sign", changed<Collisions>([](Collisions& l) { l.law.c = -l.law.c; })},
      {"collisions", "with the exponent 1", changed<Collisions>([](Collisions& l) { l.law.exponent = 1; })},
      {"collisions", "torsion with the coefficient of rolling",
       changed<Collisions>([](Collisions& l) { l.law.tau = l.law.rho; })},
      {"collisions", "without the reaction", instead<Collisions>([](const Collisions& l, Now& s) {
         const auto before = s.bodies.back();
         l(s);
         s.bodies.back().f = before.f, s.bodies.back().n = before.n;
       })},
      {"collisions", "with the contact point on the surface of A",
       instead<Collisions>([](const Collisions& l, Now& s) {
         for (const auto& pair : l.pairs) {
           const auto& [A, B] = pair;
           const V a = s.point(A.at), n = (a - s.point(B.at)).normalized();
           const T x = A.r + B.r - (a - s.point(B.at)).norm();
           if (A.half > 0 || B.box)
             Collisions{{pair}, l.law}(s);
           else
             l.law(s, A.at.link, B.at.link, x, n, V(a - A.r * n));
         }
       })},
      {"collisions", "of the middles of capsules", changed<Collisions>([](Collisions& l) {
         for (auto& [A, B] : l.pairs) A.half = B.half = 0;
       })},
      {"collisions", "of a smaller box", changed<Collisions>([](Collisions& l) {
         for (auto& [A, B] : l.pairs) B.sides *= T(0.99);
       })},
      {"added_mass", "missing", [](Tree& tree) {
         tree.laws.clear(), std::fill(tree.armature.begin(), tree.armature.end(), T(0));
       }},
      {"added_mass", "without omega x P and u x P", [](Tree& tree) { tree.laws.clear(); }},
      {"added_mass", "without the moment u x P", instead<AddedMass>([](const AddedMass& l, Now& s) {
         const auto& b = s.bodies[std::size_t(l.link)];
         const V u = s.velocity(l.link, b.o), P = b.R * l.m.cwiseProduct(V(b.R.transpose() * u));
         l(s), s.turn(l.link, V(u.cross(P)));
       })},
      {"added_mass", "at the centre of mass", instead<AddedMass>([](const AddedMass& l, Now& s) {
         auto& b = s.bodies[std::size_t(l.link)];
         const V o = b.o;
         b.o = b.c, l(s), b.o = o;
       })},
      {"closed_loops", "missing", [](Tree& tree) { tree.loops.clear(); }},
      {"closed_loops", "at the joint's origin", [](Tree& tree) { tree.loops.at(0).a.p.setZero(); }},
      {"closed_loops", "in the joint's axes", [](Tree& tree) { tree.loops.at(0).a.R.setIdentity(); }},
      {"closed_loops", "that close at half the rate", [](Tree& tree) { tree.loops.at(0).alpha /= 2; }},
      {"motor", "without its rotor",
       [](Tree& tree) { std::fill(tree.armature.begin(), tree.armature.end(), T(0)); }},
      {"motor", "with the rotor N J",
       [](Tree& tree) {
         for (T& x : tree.armature) x /= 2;
       }},
      {"motor", "with the no-load speed at the motor", changed<Motor>([](Motor& l) { l.no_load *= 2; })},
      {"motor", "with the stall torque at the motor", changed<Motor>([](Motor& l) { l.stall /= 2; })},
      {"motor", "whose gearbox drives", changed<Motor>([](Motor& l) { l.efficiency = 2 - l.efficiency; })},
      {"motor", "v_s for its square", changed<Motor>([](Motor& l) { l.v_s = std::sqrt(l.v_s); })},
      {"motor", "d with the other sign", changed<Motor>([](Motor& l) { l.pursuit.d = -l.pursuit.d; })},
      {"motor", "with linear tables", changed<Motor>([](Motor& l) { l.pursuit.targets.cubic = false; })}};
  return terms;
}

}  // namespace liecheck::test::planted

#include <oracles/pause.hpp>
#include <oracles/tree_sizes.hpp>

namespace liecheck::oracles {
namespace {

/// A bound of the oracle's rounding error relative to its terms, which are summed at the world's origin. This
/// share of the distance from that origin is added to lever arms, so that an exact zero also has a scale.
constexpr double oracle_rounding = 1e-20;

double size(const Vec3<double>& v) {
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

double size_of(const Mat3<double>& m) {
  double square = 0;
  for (double x : m.x) square += x * x;
  return std::sqrt(square);
}

/// Norms of the linear and of the angular part of a twist.
struct TwistSize {
  double u = 0, w = 0;
};
/// The norms of column k of a joint's motion subspace S.
TwistSize column_size(const JointOf<double>& j, int k) {
  const double factor = j.primary >= 0 ? std::fabs(j.multiplier) : 1;
  switch (j.kind) {
    case JointKind::revolute:
    case JointKind::continuous:
    case JointKind::spherical:
      return {0, factor};
    case JointKind::helical:
      return {factor * std::fabs(j.pitch), factor};
    case JointKind::prismatic:
    case JointKind::translation:
      return {factor, 0};
    case JointKind::planar:
      return k < 2 ? TwistSize{1, 0} : TwistSize{0, 1};
    default:
      return k < 3 ? TwistSize{1, 0} : TwistSize{0, 1};
  }
}
/// The norms of the linear and of the angular part of S x.
TwistSize motion_size(const JointOf<double>& j, const double* x) {
  double u = 0, w = 0;
  for (int k = 0; k < velocity_size(j.kind); ++k) {
    const TwistSize p = column_size(j, k);
    u += p.u * p.u * x[k] * x[k], w += p.w * p.w * x[k] * x[k];
  }
  return {std::sqrt(u), std::sqrt(w)};
}
/// |m q| + |o| of a mimic, |q| of another joint with one coordinate.
double coordinate(const TreeOf<double>& tree, const JointOf<double>& j, const double* x) {
  const bool circle =
      j.primary >= 0 && tree.joints[static_cast<std::size_t>(j.primary)].kind == JointKind::continuous;
  const double y = circle ? std::fabs(std::atan2(x[1], x[0])) : std::fabs(x[0]);
  return j.primary >= 0 ? std::fabs(j.multiplier) * y + std::fabs(j.offset) : y;
}
/// The norm |p_E(q)| of the joint's translation.
double translation_size(const TreeOf<double>& tree, std::size_t i, const std::vector<double>& q) {
  const JointOf<double>& j = tree.joints[i];
  const double* x = &q[static_cast<std::size_t>(tree.idx_q[i])];
  if (j.kind == JointKind::prismatic || j.kind == JointKind::helical)
    return coordinate(tree, j, x) * (j.kind == JointKind::helical ? std::fabs(j.pitch) : 1);
  if (j.kind == JointKind::planar) return size({{x[0], x[1], 0}});
  if (j.kind == JointKind::translation || j.kind == JointKind::free_flyer) return size({{x[0], x[1], x[2]}});
  return 0;
}
}  // namespace

double mimic_factor(const TreeOf<double>& tree, const std::vector<double>& q) {
  double angles = 0;
  for (std::size_t i = 0; i < tree.joints.size(); ++i) {
    const JointOf<double>& j = tree.joints[i];
    if (j.primary >= 0 && j.kind != JointKind::prismatic)
      angles += coordinate(tree, j, &q[static_cast<std::size_t>(tree.idx_q[i])]);
  }
  return 1 + 2 * angles;
}

namespace {
double value(double x) {
  return x;
}
double value(const Tangent& x) {
  return x.x;
}

}  // namespace

/// Forces and moments on the bodies, and the lever arms from the first joint (`about_root`).
template <class N>
struct TreeSizes<N>::Loads {
  std::vector<N> force, moment, from_root;
  explicit Loads(std::size_t n) : force(n, N(0)), moment(n, N(0)), from_root(n, N(0)) {}
};

template <class N>
TreeSizes<N>::TreeSizes(const TreeOf<double>& tree, const Numbers& q, const Numbers& v, const Numbers& a,
                        const std::vector<WrenchOf<double>>& fext, const Numbers& dq, const Numbers& dv,
                        bool about_root) {
  const std::size_t n = tree.joints.size(), nv = static_cast<std::size_t>(tree.nv);
  Loads loads(n);
  joints.resize(n);
  tau.assign(nv, N(0));
  mass.assign(nv * nv, 0);
  outward(tree, q, v, a, fext, dq, dv, about_root, loads);
  inward(tree, loads);
  add_armatures(tree, v, a);
  add_mass_matrix(tree);
  multiply(mimic_factor(tree, q));
}

template <class N>
void TreeSizes<N>::outward(const TreeOf<double>& tree, const Numbers& q, const Numbers& v, const Numbers& a,
                           const std::vector<WrenchOf<double>>& fext, const Numbers& dq, const Numbers& dv,
                           bool about_root, Loads& loads) {
  auto& [force, moment, from_root] = loads;
  const auto with = [](double x, double d) {
    if constexpr (std::is_same_v<N, Tangent>)
      return Tangent(x, d);
    else
      return (void)d, x;
  };
  const double g = size(tree.gravity);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const JointOf<double>& j = tree.joints[i];
    const auto at = static_cast<std::size_t>(tree.idx_v[i]);
    Joint world, &own = joints[i];
    world.ac = N(g);
    const Joint& p = j.parent < 0 ? world : joints[static_cast<std::size_t>(j.parent)];
    const TwistSize V = motion_size(j, &v[at]), A = motion_size(j, &a[at]);
    const TwistSize D = dq.empty() ? TwistSize{} : motion_size(j, &dq[at]),
                    dV = dv.empty() ? TwistSize{} : motion_size(j, &dv[at]);
    const N w = with(V.w, dV.w), u = with(V.u, dV.u);
    own.r = with(size(j.p) + translation_size(tree, i, q), D.u);
    own.rotation = with(1, D.w);
    own.w = own.rotation * p.w + w;
    own.u = own.rotation * (p.u + p.w * own.r) + u;
    own.al = own.rotation * p.al + N(A.w) + own.w * w;
    own.ac = own.rotation * (p.ac + p.al * own.r) + N(A.u) + own.u * w + own.w * u;
    own.position = p.position + own.r;
    from_root[i] = !about_root || i == 0 ? N(0)
                   : j.parent < 0        ? joints[0].position + own.position
                                         : from_root[static_cast<std::size_t>(j.parent)] + own.r;
    const double m = j.body.mass, I = size_of(j.body.I_C);
    const N c = N(size(j.body.c)) + from_root[i], at_root = own.u + own.w * from_root[i];
    const N momentum = N(m) * (at_root + own.w * c);
    force[i] = N(m) * (own.ac + own.al * (from_root[i] + c)) + own.w * momentum;
    moment[i] = N(I) * (own.al + own.w * own.w) + (c + N(oracle_rounding) * own.position) * force[i] +
                at_root * momentum;
    for (const auto& F : fext)
      if (F.joint == static_cast<int>(i)) {
        force[i] += N(size(head3(F.F)));
        moment[i] += N(size(tail3(F.F)));
      }
    const double lever = size(j.body.c), speed = value(own.u) + value(own.w) * lever;
    own.mass = N(m), own.first_moment = N(m * lever), own.second_moment = N(I + m * lever * lever);
    linear += m * speed;
    angular += I * value(own.w) + m * (lever + 2 * value(own.position)) * speed;
    kinetic += (m * speed * speed + I * value(own.w) * value(own.w)) / 2;
    potential += m * g * (value(own.position) + lever);
  }
}

template <class N>
void TreeSizes<N>::inward(const TreeOf<double>& tree, Loads& loads) {
  auto& [force, moment, from_root] = loads;
  for (std::size_t i = joints.size(); i-- > 0;) {
    const JointOf<double>& j = tree.joints[i];
    for (int k = 0; k < velocity_size(j.kind); ++k) {
      const TwistSize s = column_size(j, k);
      tau[static_cast<std::size_t>(tree.idx_v[i] + k)] +=
          N(s.u) * force[i] + N(s.w) * (moment[i] + from_root[i] * force[i]);
    }
    if (j.parent < 0) continue;
    const auto p = static_cast<std::size_t>(j.parent);
    Joint &parent = joints[p], &own = joints[i];
    force[p] += own.rotation * force[i];
    moment[p] += own.rotation * moment[i] + own.r * own.rotation * force[i];
    parent.second_moment += own.second_moment + N(2) * own.r * own.first_moment + own.r * own.r * own.mass;
    parent.first_moment += own.first_moment + own.r * own.mass;
    parent.mass += own.mass;
  }
}

template <class N>
void TreeSizes<N>::add_armatures(const TreeOf<double>& tree, const Numbers& v, const Numbers& a) {
  for_each_armature(tree, [&](std::size_t k, double armature) {
    tau[k] += N(std::fabs(armature * a[k]));
    kinetic += armature * v[k] * v[k] / 2;
    mass[k * static_cast<std::size_t>(tree.nv) + k] += armature;
  });
}

/// M_kl = s_k . f, where the wrench f accelerates the subtree of l by s_l (composite rigid body algorithm).
template <class N>
void TreeSizes<N>::add_mass_matrix(const TreeOf<double>& tree) {
  const auto nv = static_cast<std::size_t>(tree.nv);
  for (std::size_t l = 0; l < joints.size(); ++l)
    for (int kl = 0; kl < velocity_size(tree.joints[l].kind); ++kl) {
      Pauses::look();
      const TwistSize s = column_size(tree.joints[l], kl);
      const Joint& own = joints[l];
      double f = value(own.mass) * s.u + value(own.first_moment) * s.w,
             m = value(own.first_moment) * s.u + value(own.second_moment) * s.w;
      for (int i = static_cast<int>(l); i >= 0;) {
        const JointOf<double>& j = tree.joints[static_cast<std::size_t>(i)];
        for (int k = 0; k < velocity_size(j.kind); ++k) {
          const TwistSize t = column_size(j, k);
          const auto row = static_cast<std::size_t>(tree.idx_v[static_cast<std::size_t>(i)] + k);
          const auto column = static_cast<std::size_t>(tree.idx_v[l] + kl);
          mass[row * nv + column] += t.u * f + t.w * m;
          if (static_cast<std::size_t>(i) != l) mass[column * nv + row] += t.u * f + t.w * m;
        }
        m += value(joints[static_cast<std::size_t>(i)].r) * f;
        i = j.parent;
      }
    }
}

template <class N>
void TreeSizes<N>::multiply(double factor) {
  for (N& x : tau) x = N(factor) * x;
  for (double& x : mass) x *= factor;
  for (Joint& j : joints)
    for (N* x : {&j.w, &j.u, &j.al, &j.ac, &j.position}) *x = N(factor) * *x;
  for (double* x : {&linear, &angular, &kinetic, &potential}) *x *= factor;
}

template struct TreeSizes<double>;
template struct TreeSizes<Tangent>;

}  // namespace liecheck::oracles

#include <oracles/tree_sizes.hpp>

namespace liecheck::oracles {
namespace {

/// The oracle's own terms, at the world's origin, lose less than this: what is exactly zero, it finds to be that.
constexpr double oracle_noise = 1e-20;

double size(const Vec3<double>& v) {
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

double size_of(const Mat3<double>& m) {
  double square = 0;
  for (double x : m.x) square += x * x;
  return std::sqrt(square);
}

/// The linear and the angular part of a joint's motion by each of its numbers, in size.
struct Parts {
  double u = 0, w = 0;
};
/// Which of a joint's numbers slide and which turn.
Parts part(const JointOf<double>& j, int k) {
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
      return k < 2 ? Parts{1, 0} : Parts{0, 1};
    default:
      return k < 3 ? Parts{1, 0} : Parts{0, 1};
  }
}
/// Norms of the two parts of S x.
Parts moved(const JointOf<double>& j, const double* x) {
  double u = 0, w = 0;
  for (int k = 0; k < velocity_size(j.kind); ++k) {
    const Parts p = part(j, k);
    u += p.u * p.u * x[k] * x[k], w += p.w * p.w * x[k] * x[k];
  }
  return {std::sqrt(u), std::sqrt(w)};
}
/// Of a mimic, its |m q| + |o|; of another joint of one number, |q|.
double coordinate(const TreeOf<double>& tree, const JointOf<double>& j, const double* x) {
  const bool circle =
      j.primary >= 0 && tree.joints[static_cast<std::size_t>(j.primary)].kind == JointKind::continuous;
  const double y = circle ? std::fabs(std::atan2(x[1], x[0])) : std::fabs(x[0]);
  return j.primary >= 0 ? std::fabs(j.multiplier) * y + std::fabs(j.offset) : y;
}
/// |p_E(q)|.
double slide(const TreeOf<double>& tree, std::size_t i, const std::vector<double>& q) {
  const JointOf<double>& j = tree.joints[i];
  const double* x = &q[static_cast<std::size_t>(tree.idx_q[i])];
  if (j.kind == JointKind::prismatic || j.kind == JointKind::helical)
    return coordinate(tree, j, x) * (j.kind == JointKind::helical ? std::fabs(j.pitch) : 1);
  if (j.kind == JointKind::planar) return size({{x[0], x[1], 0}});
  if (j.kind == JointKind::translation || j.kind == JointKind::free_flyer) return size({{x[0], x[1], x[2]}});
  return 0;
}
/// 1 + twice the angles of all mimics: what the roundings of those turn, on the way out and on the way back.
double of_mimics(const TreeOf<double>& tree, const std::vector<double>& q) {
  double angles = 0;
  for (std::size_t i = 0; i < tree.joints.size(); ++i) {
    const JointOf<double>& j = tree.joints[i];
    if (j.primary >= 0 && j.kind != JointKind::prismatic)
      angles += coordinate(tree, j, &q[static_cast<std::size_t>(tree.idx_q[i])]);
  }
  return 1 + 2 * angles;
}
double value(double x) {
  return x;
}
double value(const Tangent& x) {
  return x.x;
}

}  // namespace

template <class N>
TreeSizes<N>::TreeSizes(const TreeOf<double>& tree, const Numbers& q, const Numbers& v, const Numbers& a,
                        const std::vector<WrenchOf<double>>& fext, const Numbers& dq, const Numbers& dv,
                        bool about_root) {
  const std::size_t n = tree.joints.size(), nv = static_cast<std::size_t>(tree.nv);
  const auto with = [](double x, double d) {
    if constexpr (std::is_same_v<N, Tangent>)
      return Tangent(x, d);
    else
      return (void)d, x;
  };
  const double g = size(tree.gravity);
  std::vector<N> force(n, N(0)), moment(n, N(0)), away(n, N(0));
  joints.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const JointOf<double>& j = tree.joints[i];
    const auto at = static_cast<std::size_t>(tree.idx_v[i]);
    Joint world, &own = joints[i];
    world.ac = N(g);
    const Joint& p = j.parent < 0 ? world : joints[static_cast<std::size_t>(j.parent)];
    const Parts V = moved(j, &v[at]), A = moved(j, &a[at]);
    const Parts D = dq.empty() ? Parts{} : moved(j, &dq[at]), dV = dv.empty() ? Parts{} : moved(j, &dv[at]);
    const N w = with(V.w, dV.w), u = with(V.u, dV.u);
    own.r = with(size(j.p) + slide(tree, i, q), D.u);
    own.turn = with(1, D.w);
    own.w = own.turn * p.w + w;
    own.u = own.turn * (p.u + p.w * own.r) + u;
    own.al = own.turn * p.al + N(A.w) + own.w * w;
    own.ac = own.turn * (p.ac + p.al * own.r) + N(A.u) + own.u * w + own.w * u;
    own.position = p.position + own.r;
    away[i] = !about_root || i == 0 ? N(0)
              : j.parent < 0        ? joints[0].position + own.position
                                    : away[static_cast<std::size_t>(j.parent)] + own.r;
    const double m = j.body.mass, I = size_of(j.body.I_C);
    const N c = N(size(j.body.c)) + away[i], at_root = own.u + own.w * away[i];
    const N momentum = N(m) * (at_root + own.w * c);
    force[i] = N(m) * (own.ac + own.al * (away[i] + c)) + own.w * momentum;
    moment[i] = N(I) * (own.al + own.w * own.w) + (c + N(oracle_noise) * own.position) * force[i] +
                at_root * momentum;
    for (const auto& F : fext)
      if (F.joint == static_cast<int>(i)) {
        force[i] += N(size(head3(F.F)));
        moment[i] += N(size(tail3(F.F)));
      }
    const double lever = size(j.body.c), speed = value(own.u) + value(own.w) * lever;
    own.mass = N(m), own.first = N(m * lever), own.second = N(I + m * lever * lever);
    linear += m * speed;
    angular += I * value(own.w) + m * (lever + 2 * value(own.position)) * speed;
    kinetic += (m * speed * speed + I * value(own.w) * value(own.w)) / 2;
    potential += m * g * (value(own.position) + lever);
  }
  tau.assign(nv, N(0));
  mass.assign(nv * nv, 0);
  for (std::size_t i = n; i-- > 0;) {
    const JointOf<double>& j = tree.joints[i];
    for (int k = 0; k < velocity_size(j.kind); ++k) {
      const Parts p = part(j, k);
      tau[static_cast<std::size_t>(tree.idx_v[i] + k)] +=
          N(p.u) * force[i] + N(p.w) * (moment[i] + away[i] * force[i]);
    }
    if (j.parent < 0) continue;
    const auto p = static_cast<std::size_t>(j.parent);
    Joint &parent = joints[p], &own = joints[i];
    force[p] += own.turn * force[i];
    moment[p] += own.turn * moment[i] + own.r * own.turn * force[i];
    parent.second += own.second + N(2) * own.r * own.first + own.r * own.r * own.mass;
    parent.first += own.first + own.r * own.mass;
    parent.mass += own.mass;
  }
  for (std::size_t i = 0; i < n; ++i)
    if (const JointOf<double>& j = tree.joints[i]; j.primary < 0)
      for (int k = tree.idx_v[i]; k < tree.idx_v[i] + velocity_size(j.kind); ++k) {
        const auto at = static_cast<std::size_t>(k);
        tau[at] += N(std::fabs(j.armature * a[at]));
        mass[at * nv + at] += j.armature;
      }
  for (std::size_t l = 0; l < n; ++l)
    for (int kl = 0; kl < velocity_size(tree.joints[l].kind); ++kl) {
      const Parts s = part(tree.joints[l], kl);
      const Joint& own = joints[l];
      double f = value(own.mass) * s.u + value(own.first) * s.w,
             m = value(own.first) * s.u + value(own.second) * s.w;
      for (int i = static_cast<int>(l); i >= 0;) {
        const JointOf<double>& j = tree.joints[static_cast<std::size_t>(i)];
        for (int k = 0; k < velocity_size(j.kind); ++k) {
          const Parts t = part(j, k);
          const auto row = static_cast<std::size_t>(tree.idx_v[static_cast<std::size_t>(i)] + k);
          const auto column = static_cast<std::size_t>(tree.idx_v[l] + kl);
          mass[row * nv + column] += t.u * f + t.w * m;
          if (static_cast<std::size_t>(i) != l) mass[column * nv + row] += t.u * f + t.w * m;
        }
        m += value(joints[static_cast<std::size_t>(i)].r) * f;
        i = j.parent;
      }
    }
  const double factor = of_mimics(tree, q);
  for (N& x : tau) x = N(factor) * x;
  for (double& x : mass) x *= factor;
  for (Joint& j : joints)
    for (N* x : {&j.w, &j.u, &j.al, &j.ac, &j.position}) *x = N(factor) * *x;
  for (double* x : {&linear, &angular, &kinetic, &potential}) *x *= factor;
}

template struct TreeSizes<double>;
template struct TreeSizes<Tangent>;

}  // namespace liecheck::oracles

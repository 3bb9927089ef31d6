// Confirms the product rule of tree.cpp by differences of poses.

#include <oracles/agreement.hpp>
#include <oracles/pause.hpp>
#include <oracles/tree_sizes.hpp>

namespace liecheck::oracles {

using namespace homogeneous;

namespace {

template <class T>
TreeOf<T> converted(const TreeOf<Real>& tree) {
  TreeOf<T> to;
  to.gravity = cast<T>(tree.gravity);
  for (const JointOf<Real>& j : tree.joints)
    to.joints.push_back({j.kind,
                         j.parent,
                         j.primary,
                         cast<T>(j.Q),
                         cast<T>(j.p),
                         cast<T>(j.axis),
                         T(j.pitch),
                         T(j.multiplier),
                         T(j.offset),
                         T(j.armature),
                         {T(j.body.mass), cast<T>(j.body.c), cast<T>(j.body.I_C)}});
  to.index();
  return to;
}

}  // namespace

bool confirmed(const TreeOf<Real>& tree, const std::vector<Real>& q, const std::vector<Real>& v,
               const std::vector<Real>& a, const std::vector<Real>& dq) {
  using H = Real100;
  using Numbers = std::vector<H>;
  constexpr double bound = 1e-30;
  const auto wide = [](const std::vector<Real>& x) { return Numbers(x.begin(), x.end()); };
  const TreeOf<H> tree_h = converted<H>(tree);
  const Numbers qh = wide(q), vh = wide(v), ah = wide(a), none(v.size(), H(0));
  const TreeDynamics<Real> exact(tree, q, v, a);
  const std::size_t n = tree.joints.size();
  H fastest(1);
  for (std::size_t k = 0; k < vh.size(); ++k) {
    fastest = larger<H>(fastest, H(abs(vh[k])));
    fastest = larger<H>(fastest, H(sqrt(abs(ah[k]))));
  }
  const auto poses = [&](const Numbers& displaced) {
    return TreeDynamics<H>(tree_h, qh, none, none, {}, {}, {}, displaced).motion().X;
  };
  const auto near = [&](const Mat34<H>& x, const Mat34<Real>& y, const H& scale) {
    return norm(x - cast<H>(y)) <= H(bound) * larger<H>(H(norm(x)), scale);
  };
  const H h = ldexp(H(1), -80) / fastest;
  const auto along = [&](const H& t) {
    Numbers x;
    for (std::size_t k = 0; k < vh.size(); ++k) x.push_back(t * vh[k] + t * t / 2 * ah[k]);
    return poses(x);
  };
  const auto middle = poses({}), ahead = along(h), behind = along(-h);
  for (std::size_t i = 0; i < n; ++i) {
    const H size = norm(middle[i]) * fastest;
    if (!near(H(1 / (2 * h)) * (ahead[i] - behind[i]), exact.motion().X1[i], size)) return false;
    if (!near(H(1 / (h * h)) * (ahead[i] - H(2) * middle[i] + behind[i]), exact.motion().X2[i],
              size * fastest))
      return false;
  }
  for (std::size_t k = 0; k < vh.size(); ++k) {
    Numbers step = none;
    const H t = ldexp(H(1), -110);
    step[k] = t;
    const auto plus = poses(step);
    step[k] = -t;
    const auto minus = poses(step);
    for (std::size_t i = 0; i < n; ++i) {
      Pauses::look();
      Mat34<H> U = zeros<3, 4, H>();
      for (const ColumnOf<Real>& c : exact.columns()) {
        int j = static_cast<int>(i);
        while (j > c.joint) j = tree.joints[static_cast<std::size_t>(j)].parent;
        if (c.v == static_cast<int>(k) && j == c.joint)
          U = U + product(generator(cast<H>(stack(c.u, c.w))), middle[i], 1);
      }
      const H size = norm(middle[i]);
      if (!near(H(1 / (2 * t)) * (plus[i] - minus[i]), cast<Real>(U), size * size)) return false;
    }
  }
  if (dq.empty()) return true;
  const std::vector<Real> still(v.size(), Real(0));
  const auto derivative = TreeDynamics<Real>(tree, q, v, a, dq, still, still).torque_derivative();
  const H t = ldexp(H(1), -110) / fastest;
  const auto torque = [&](const H& t) {
    Numbers step;
    for (const Real& x : dq) step.push_back(t * H(x));
    return TreeDynamics<H>(tree_h, qh, vh, ah, {}, {}, {}, step).torque();
  };
  const Numbers plus = torque(t), minus = torque(-t);
  const auto rough = [](const std::vector<Real>& x) { return std::vector<double>(x.begin(), x.end()); };
  // The error is relative to the terms, because the result may be zero.
  const TreeSizes<Tangent> terms(converted<double>(tree), rough(q), rough(v), rough(a), {}, rough(dq));
  H off(0), size(0);
  for (std::size_t k = 0; k < derivative.size(); ++k) {
    const H d = (plus[k] - minus[k]) / (2 * t) - H(derivative[k]), term(terms.tau[k].x + terms.tau[k].d);
    off += d * d, size += term * term;
  }
  return off <= size * H(bound) * H(bound);
}

}  // namespace liecheck::oracles

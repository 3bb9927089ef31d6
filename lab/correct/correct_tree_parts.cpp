#include <cmath>
#include <correct/correct_tree_parts.hpp>
#include <stdexcept>

namespace liecheck::properties::correct {

template <class S>
TreeParts<S>::TreeParts(const Tree<S>& tree) : tree_(tree), gravity_(vector(tree.gravity)) {
  for (const auto& j : tree.joints) columns_.push_back((j.primary < 0 ? S(1) : j.multiplier) * subspace(j));
  armature_ = X::Zero(tree.nv);
  oracles::for_each_armature(tree, [&](std::size_t k, const S& a) { armature_[static_cast<int>(k)] = a; });
}

template <class S>
auto TreeParts<S>::rotation(const oracles::Quaternion<S>& Q) -> M3 {
  return Eigen::Quaternion<S>(Q[3], Q[0], Q[1], Q[2]).normalized().toRotationMatrix();
}

template <class S>
Columns<S> TreeParts<S>::subspace(const oracles::JointOf<S>& j) {
  using oracles::JointKind;
  const M6 I = M6::Identity();
  const V3 axis = vector(j.axis).normalized(), none = V3::Zero();
  switch (j.kind) {
    case JointKind::revolute:
    case JointKind::continuous:
      return joined<S>(none, axis);
    case JointKind::prismatic:
      return joined<S>(axis, none);
    case JointKind::helical:
      return joined<S>(j.pitch * axis, axis);
    case JointKind::spherical:
      return I.template rightCols<3>();
    case JointKind::translation:
      return I.template leftCols<3>();
    case JointKind::planar:
      return (Columns<S>(6, 3) << I.col(0), I.col(1), I.col(5)).finished();
    default:
      return I;
  }
}

template <class S>
Pose<S> TreeParts<S>::local(std::size_t i, const X& q) const {
  using oracles::JointKind;
  const auto& j = tree_.joints[i];
  const int k = tree_.idx_q[i];
  const V3 axis = vector(j.axis).normalized();
  S y = q[k];
  if (j.primary >= 0) {
    if (tree_.joints[static_cast<std::size_t>(j.primary)].kind == JointKind::continuous)
      y = std::atan2(q[k + 1], q[k]);
    y = j.multiplier * y + j.offset;
  }
  M3 R = M3::Identity();
  V3 p = V3::Zero();
  const auto turned = [](S c, S s, const V3& n) -> M3 {
    return Eigen::Quaternion<S>(Eigen::AngleAxis<S>(std::atan2(s, c), n)).toRotationMatrix();
  };
  const auto quaternion = [&](int first) -> M3 {
    return Eigen::Quaternion<S>(Vec<S, 4>(q.template segment<4>(first))).normalized().toRotationMatrix();
  };
  switch (j.kind) {
    case JointKind::helical:
      p = j.pitch * y * axis;
      [[fallthrough]];
    case JointKind::revolute:
      R = Eigen::AngleAxis<S>(y, axis).toRotationMatrix();
      break;
    case JointKind::continuous:
      R = turned(q[k], q[k + 1], axis);
      break;
    case JointKind::prismatic:
      p = y * axis;
      break;
    case JointKind::spherical:
      R = quaternion(k);
      break;
    case JointKind::planar:
      p << q[k], q[k + 1], S(0);
      R = turned(q[k + 2], q[k + 3], V3::UnitZ());
      break;
    case JointKind::translation:
      p = q.template segment<3>(k);
      break;
    default:
      p = q.template segment<3>(k), R = quaternion(k + 3);
  }
  const M3 placed = rotation(j.Q);
  return {placed * R, vector(j.p) + placed * p};
}

template <class S>
auto TreeParts<S>::bodies() const -> std::vector<Centred> {
  std::vector<Centred> all;
  for (std::size_t i = 0; i < tree_.joints.size(); ++i)
    all.push_back(
        {i, tree_.joints[i].body.mass, vector(tree_.joints[i].body.c), inertia(tree_.joints[i].body)});
  for (const auto& b : tree_.fixed) {
    const M3 R = rotation(b.Q);
    all.push_back({static_cast<std::size_t>(b.joint), b.body.mass, R * vector(b.body.c) + vector(b.p),
                   R * inertia(b.body) * R.transpose()});
  }
  return all;
}

template <class S>
Factor<S>::Factor(const MatX<S>& M) : ldlt_(M) {
  if (!(ldlt_.vectorD().minCoeff() > S(0))) throw std::domain_error("the mass matrix is singular");
}

template <class S>
VecX<S> Factor<S>::solve(const VecX<S>& b) const {
  return ldlt_.solve(b);
}

template <class S>
MatX<S> Factor<S>::solve(const MatX<S>& b) const {
  return ldlt_.solve(b);
}

template class TreeParts<float>;
template class TreeParts<double>;
template class Factor<float>;
template class Factor<double>;

}  // namespace liecheck::properties::correct

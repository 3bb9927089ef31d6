#pragma once
// A tree of bodies as plain numbers, for the algorithms of operations/trees.hpp. The vectors q, v, a and tau
// list the joints in order and skip mimic joints. A wrench acts on the body of a joint, in the axes and at
// the origin of that joint's frame.

#include <oracles/tree.hpp>
#include <subjects/typed.hpp>
#include <subjects/urdf_model.hpp>

namespace liecheck::properties {

/// A body that is fixed to a joint with the pose (Q, p).
template <class S>
struct FixedBody {
  int joint;
  oracles::BodyOf<S> body;
  oracles::Quaternion<S> Q;
  oracles::Vec3<S> p;
};

/// The oracle's tree of moving joints, with additional fixed bodies and one frame.
template <class S>
struct Tree : oracles::TreeOf<S> {
  std::vector<FixedBody<S>> fixed;
  int frame_joint = 0;
  oracles::Quaternion<S> frame_Q;
  oracles::Vec3<S> frame_p;
  std::shared_ptr<const UrdfModel> urdf;  ///< the same tree as a URDF, or null
};

}  // namespace liecheck::properties

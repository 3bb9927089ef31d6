#pragma once
// A tree of bodies in plain numbers, for the algorithms of operations/trees.hpp: q, v, a, tau joint by joint, nothing for
// a mimic; a wrench acts on the body of a joint, in its axes at its origin.

#include <oracles/tree.hpp>
#include <subjects/subject.hpp>

namespace liecheck::properties {

/// A body fixed to a joint at (Q, p).
template <class S>
struct FixedBody {
  int joint;
  oracles::BodyOf<S> body;
  oracles::Quaternion<S> Q;
  oracles::Vec3<S> p;
};

/// Joints that move, as the oracle has them; one frame; and bodies beside those of the joints.
template <class S>
struct Tree : oracles::TreeOf<S> {
  std::vector<FixedBody<S>> fixed;
  int frame_joint = 0;
  oracles::Quaternion<S> frame_Q;
  oracles::Vec3<S> frame_p;
};

}  // namespace liecheck::properties

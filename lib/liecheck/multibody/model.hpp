#pragma once
// Model: what a robot is. Constants only; the results of a computation are Data's, so one constant Model
// serves any number of threads.
//
// Joint 0 is the universe. Joint i > 0 hangs on parents[i] < i at jointPlacements[i] and owns nqs[i] numbers
// of q from idx_qs[i], nvs[i] of v from idx_vs[i]. Names and conventions are Pinocchio's; the fields are read
// freely and changed through the functions only.

#include <liecheck/multibody/frame.hpp>
#include <liecheck/multibody/joint.hpp>
#include <liecheck/spatial/inertia.hpp>
#include <stdexcept>
#include <vector>

namespace liecheck {

template <Scalar S>
class Model {
 public:
  std::string name;
  int nq = 0, nv = 0, njoints = 0, nframes = 0;

  std::vector<std::string> names;       ///< of joints
  std::vector<int> parents;             ///< joint i hangs on joint parents[i]
  std::vector<SE3<S>> jointPlacements;  ///< X_PJ at q = neutral
  std::vector<Inertia<S>> inertias;     ///< of all that joint i carries, in its frame
  std::vector<Joint<S>> joints;
  std::vector<int> idx_qs, idx_vs, nqs, nvs;
  std::vector<Frame<S>> frames;

  /// Counts the joints and frames ever added: Data made at another revision is refused.
  int revision = 0;

  Model() {
    addJointUnchecked(0, Universe<S>(), SE3<S>::Identity(), "universe");
    addFrameUnchecked({"universe", 0, 0, SE3<S>::Identity(), FrameType::FIXED_JOINT});
  }

  /// Hangs a joint on joint parent at X_PJ; returns its index. No body, no frame yet.
  int addJoint(int parent, const Joint<S>& joint, const SE3<S>& X_PJ, const std::string& joint_name) {
    checkJoint(parent, "the parent of joint '" + joint_name + "'");
    if (existJointName(joint_name))
      throw std::invalid_argument("the model already has a joint named '" + joint_name + "'");
    if (std::holds_alternative<Universe<S>>(joint))
      throw std::invalid_argument("joint '" + joint_name + "' is a second universe");
    return addJointUnchecked(parent, joint, X_PJ, joint_name);
  }

  /// Adds a frame; returns its index. Two frames may share a name if their types differ (a joint and a link).
  int addFrame(const Frame<S>& frame) {
    checkJoint(frame.parentJoint, "the parent of frame '" + frame.name + "'");
    if (frame.parentFrame < 0 || frame.parentFrame >= nframes)
      throw std::invalid_argument("the parent of frame '" + frame.name + "' is frame " +
                                  std::to_string(frame.parentFrame) + ": there are " +
                                  std::to_string(nframes));
    if (existFrame(frame.name, frame.type))
      throw std::invalid_argument("the model already has a frame of that type named '" + frame.name + "'");
    return addFrameUnchecked(frame);
  }

  /// The frame of a joint, named as it is. parent_frame defaults to the frame of its parent joint.
  int addJointFrame(int joint, int parent_frame = -1) {
    checkJoint(joint, "a joint frame's joint");
    if (parent_frame < 0) {
      const int parent = parents[std::size_t(joint)];
      parent_frame = frameOfJoint(parent);
    }
    return addFrame({names[std::size_t(joint)], joint, parent_frame, SE3<S>::Identity(), FrameType::JOINT});
  }

  /// The frame of a link fixed to a joint at X_JB. parent_frame defaults to the frame of that joint.
  int addBodyFrame(const std::string& body, int joint, const SE3<S>& X_JB = SE3<S>::Identity(),
                   int parent_frame = -1) {
    checkJoint(joint, "the parent of body '" + body + "'");
    if (parent_frame < 0) parent_frame = frameOfJoint(joint);
    return addFrame({body, joint, parent_frame, X_JB, FrameType::BODY});
  }

  /// Fixes a body to a joint: I_B is in the body's frame, X_JB the body's pose in the joint's frame. The
  /// inertia is transformed here, once.
  void appendBodyToJoint(int joint, const Inertia<S>& I_B, const SE3<S>& X_JB = SE3<S>::Identity()) {
    checkJoint(joint, "a body's parent");
    Inertia<S>& I_J = inertias[std::size_t(joint)];
    I_J = I_J + X_JB.act(I_B);
  }

  /// The joint's index; njoints if there is none of that name.
  int getJointId(const std::string& joint_name) const {
    for (int i = 0; i < njoints; ++i)
      if (names[std::size_t(i)] == joint_name) return i;
    return njoints;
  }
  bool existJointName(const std::string& joint_name) const { return getJointId(joint_name) < njoints; }

  /// The frame's index; nframes if there is none of that name. Precondition: one frame has that name.
  int getFrameId(const std::string& frame_name) const {
    const int found = findFrame([&](const Frame<S>& f) { return f.name == frame_name; }, 0);
    if (findFrame([&](const Frame<S>& f) { return f.name == frame_name; }, found + 1) < nframes)
      throw std::invalid_argument("several frames are named '" + frame_name + "': say of which type");
    return found;
  }
  /// The index of the frame of that name and type; nframes if there is none.
  int getFrameId(const std::string& frame_name, FrameType type) const {
    return findFrame([&](const Frame<S>& f) { return f.name == frame_name && f.type == type; }, 0);
  }
  bool existFrame(const std::string& frame_name) const {
    return findFrame([&](const Frame<S>& f) { return f.name == frame_name; }, 0) < nframes;
  }
  bool existFrame(const std::string& frame_name, FrameType type) const {
    return getFrameId(frame_name, type) < nframes;
  }

  /// The same robot with its constants as T: each number converted, none recomputed.
  template <Scalar T>
  Model<T> cast() const {
    Model<T> m;
    m.name = name;
    m.nq = nq, m.nv = nv, m.njoints = njoints, m.nframes = nframes, m.revision = revision;
    m.names = names, m.parents = parents;
    m.idx_qs = idx_qs, m.idx_vs = idx_vs, m.nqs = nqs, m.nvs = nvs;
    m.jointPlacements.clear(), m.inertias.clear(), m.joints.clear(), m.frames.clear();
    for (const SE3<S>& X : jointPlacements) m.jointPlacements.push_back(X.template cast<T>());
    for (const Inertia<S>& I : inertias)
      m.inertias.emplace_back(T(I.mass()), Vector3<T>(I.lever().template cast<T>()),
                              Matrix3<T>(I.inertia().template cast<T>()));
    for (const Joint<S>& j : joints) m.joints.push_back(liecheck::cast<T, S>(j));
    for (const Frame<S>& f : frames) m.frames.push_back(f.template cast<T>());
    return m;
  }

 private:
  int addJointUnchecked(int parent, const Joint<S>& joint, const SE3<S>& X_PJ,
                        const std::string& joint_name) {
    names.push_back(joint_name);
    parents.push_back(parent);
    jointPlacements.push_back(X_PJ);
    inertias.push_back(Inertia<S>::Zero());
    joints.push_back(joint);
    idx_qs.push_back(nq);
    idx_vs.push_back(nv);
    nqs.push_back(liecheck::nq<S>(joint));
    nvs.push_back(liecheck::nv<S>(joint));
    nq += nqs.back();
    nv += nvs.back();
    ++revision;
    return njoints++;
  }
  int addFrameUnchecked(const Frame<S>& frame) {
    frames.push_back(frame);
    ++revision;
    return nframes++;
  }
  void checkJoint(int joint, const std::string& what) const {
    if (joint < 0 || joint >= njoints)
      throw std::invalid_argument(what + " is joint " + std::to_string(joint) + ": there are " +
                                  std::to_string(njoints));
  }
  int frameOfJoint(int joint) const {
    const std::string& joint_name = names[std::size_t(joint)];
    const int frame = joint == 0 ? 0 : getFrameId(joint_name, FrameType::JOINT);
    if (frame == nframes)
      throw std::invalid_argument("joint '" + joint_name + "' has no frame yet: addJointFrame");
    return frame;
  }
  template <class Predicate>
  int findFrame(Predicate is_it, int from) const {
    for (int i = from; i < nframes; ++i)
      if (is_it(frames[std::size_t(i)])) return i;
    return nframes;
  }
};

extern template class Model<float>;
extern template class Model<double>;

}  // namespace liecheck
